//! [`stipple`]: a picture as dots, for another face than the command line, in its words.

use anyhow::Context as _;
use clap::{Args, CommandFactory as _, FromArgMatches as _, Parser};
use evenly::{Density, Method, PointSet, Rectangle, RunContext, Space};
use evenly_io::Photograph;

use crate::method::{ByDensity, MethodArgs, OptimizersByDensity, parser};
use crate::stipple::{DotsParams, Ink, dots, shares};
use crate::stipple_args::{DrawOrder, Layers, Sizes, ToneArgs};

/// The dots of one pen.
pub struct Layer {
    /// Its ink.
    pub name: &'static str,
    /// The ink's colour, as `#rrggbb`.
    pub colour: &'static str,
    /// Where the dots are, in the picture's pixels, y upwards from its lower left corner.
    pub points: PointSet,
    /// The dots' areas, relative to the largest.
    pub areas: Vec<f64>,
    /// The diameter of the largest dot that neither touches others nor darkens the picture too much, in pixels.
    pub widest: f64,
}

#[derive(Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Flags {
    #[arg(long, default_value = "push-pull", value_parser = parser::<ByDensity>())]
    method: Method,
    #[command(flatten)]
    method_args: MethodArgs<OptimizersByDensity>,
    #[arg(long, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    tone: ToneArgs,
    #[command(flatten)]
    drawing: DrawingArgs,
}

#[derive(Args)]
struct DrawingArgs {
    #[arg(long, value_enum, default_value = "black")]
    layers: Layers,
    #[arg(long, value_enum, default_value = "constant")]
    sizes: Sizes,
    #[arg(long, value_enum, default_value = "tour")]
    order: DrawOrder,
}

/// Makes dots of a picture, as many as are asked for, as `evenly stipple` would.
///
/// # Errors
/// What the command line says of the flags; a picture without any tone.
pub fn stipple(photograph: &Photograph, n_points: usize, words: &[String], run: &mut RunContext) -> anyhow::Result<Vec<Layer>> {
    let matches = Flags::command().try_get_matches_from(words).map_err(|error| crate::usage::plain(&error))?;
    let Flags { method, method_args, seed, tone, drawing } =
        Flags::from_arg_matches(&matches).map_err(|error| crate::usage::plain(&error))?;
    let tone = tone.tone()?;
    let space: Space = Rectangle::new([0.0, 0.0], photograph.size().map(|n| n as f64)).context("the picture")?.into();
    method_args.refuse_others(&[method])?;
    let params = DotsParams { method, settings: method_args.of(method), sizes: drawing.sizes, order: drawing.order };
    let inks = Ink::of(photograph, &tone, drawing.layers);
    let mut layers = Vec::new();
    // Of each layer another seed, so that no two put their dots in the same places.
    for ((ink, n), seed) in inks.iter().zip(shares(&inks, n_points)).zip(seed..).filter(|((_, n), _)| *n > 0) {
        let tones = ink.tones(photograph, &tone, drawing.sizes)?;
        let made = dots(&params, space.clone(), ink, &tones, n, seed, run)?;
        let points = made.points.with_density(&Density::uniform());
        layers.push(Layer { name: ink.name(), colour: ink.colour(), points, areas: made.areas, widest: made.widest_px });
    }
    Ok(layers)
}
