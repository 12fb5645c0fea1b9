//! What each pen draws: the picture in one ink or in four.

use evenly::Density;
use evenly_io::{Photograph, Tone, luma};

use crate::stipple_args::{Layers, Sizes};

/// One pen's share of the picture.
pub struct Ink {
    pub name: &'static str,
    pub colour: &'static str,
    /// How dark the picture is to be, from 0 to 1: its mean, and 1 on average.
    pub mean_darkness: f64,
    pub darkness: Density,
    /// How many dots are wanted where: the same, if all are of one size.
    pub density: Density,
}

/// The area of the smallest dots, relative to the largest.
const SMALLEST: f64 = 0.25;

/// The area of a dot where the picture is so dark, relative to the largest.
pub fn dot_area(darkness: f64) -> f64 {
    SMALLEST + (1.0 - SMALLEST) * darkness.clamp(0.0, 1.0)
}

/// A pen's colour, and what of a colour is its.
type Separation = (&'static str, &'static str, fn([f32; 3]) -> f32);

/// Cyan, magenta and yellow hold what black does not: inks beside each other multiply, so each is relative to what black leaves.
fn chromatic([red, green, blue]: [f32; 3], channel: usize) -> f32 {
    let light = red.max(green).max(blue);
    if light > 0.0 { 1.0 - [red, green, blue][channel] / light } else { 0.0 }
}

const CMYK: [Separation; 4] = [
    ("cyan", "#00a0e0", |colour| chromatic(colour, 0)),
    ("magenta", "#e0007a", |colour| chromatic(colour, 1)),
    ("yellow", "#f0d000", |colour| chromatic(colour, 2)),
    ("black", "#000000", |[red, green, blue]| 1.0 - red.max(green).max(blue)),
];
const BLACK: [Separation; 1] = [("black", "#000000", |colour| 1.0 - luma(colour))];

/// The inks of a picture that have anything to draw.
///
/// # Errors
/// None of them has.
pub fn inks(photograph: &Photograph, tone: &Tone, layers: Layers, sizes: Sizes) -> anyhow::Result<Vec<Ink>> {
    let separations: &[Separation] = if layers == Layers::Cmyk { &CMYK } else { &BLACK };
    // Separations are dark already.
    let of_dark = Tone { is_inverted: !tone.is_inverted, ..*tone };
    let mut inks = Vec::new();
    let mut blank = None;
    for &(name, colour, separate) in separations {
        let mut values = photograph.values(|colour| of_dark.density(separate(colour)));
        let mean_darkness = values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64;
        match photograph.density_of(&values) {
            Ok(darkness) => {
                let density = match sizes {
                    Sizes::Constant => darkness.clone(),
                    Sizes::Tone => {
                        values.iter_mut().for_each(|value| *value /= dot_area(f64::from(*value)) as f32);
                        photograph.density_of(&values)?
                    }
                };
                inks.push(Ink { name, colour, mean_darkness, darkness, density });
            }
            Err(error) => blank = Some(error),
        }
    }
    match blank {
        Some(error) if inks.is_empty() => Err(error.into()),
        _ => Ok(inks),
    }
}

/// So many dots divided among inks as their darkness wants it, exactly; an ink may get none.
pub fn shares(inks: &[Ink], n_points: usize) -> Vec<usize> {
    let total: f64 = inks.iter().map(|ink| ink.mean_darkness).sum();
    let mut below = 0.0;
    let upto = |darkness: f64| (darkness / total * n_points as f64).round() as usize;
    inks.iter()
        .map(|ink| {
            let first = upto(below);
            below += ink.mean_darkness;
            upto(below).min(n_points) - first
        })
        .collect()
}
