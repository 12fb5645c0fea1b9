//! [`StippleRequest`]: a picture as dots, of one pen or of four.

mod dots;
mod ink;
mod pen;
mod spread;
mod tone;

use evenly::{Density, Method, PointSet, Rectangle, Settings, Space, measure};
use evenly_io::{Photograph, Tone};
use serde::{Deserialize, Serialize};

use self::dots::{DotsParams, dots};
use self::ink::{Ink, shares};
pub use self::tone::{ToneReport, Wanted};
use crate::context::{Context, Stage};
use crate::error::Error;
use crate::memory;
use crate::method::Job;
use crate::points::Ending;
use crate::resource::{Colours, Resource, Resources};

/// A picture as dots.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct StippleRequest {
    /// The picture; what is transparent gets no dots.
    pub picture: Resource<Colours>,
    /// How many dots, exactly, of all layers together.
    pub n_points: usize,
    /// How they are spread.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::MethodName"))]
    pub method: Method,
    /// What the method is told; passes are 60 where it would go on until targets are met.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
    /// The same seed makes the same dots.
    #[serde(default)]
    pub seed: u64,
    /// How dark tones are to be.
    #[serde(flatten)]
    pub tone: InkTone,
    /// One black layer, or a layer a colour.
    #[serde(default)]
    pub layers: Layers,
    /// Dots of one size, or larger where it is darker.
    #[serde(default)]
    pub sizes: DotSizes,
    /// In which order dots are drawn.
    #[serde(default)]
    pub order: DrawOrder,
    /// Whether the tone is measured.
    #[serde(default)]
    pub is_measured: bool,
}

/// How dark a picture's tones are to be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default)]
pub struct InkTone {
    /// Light counts instead of dark.
    pub invert: bool,
    /// Tones are spread from middle grey by this factor.
    pub contrast: f64,
    /// Darkness, from 0 to 1, is raised to this power.
    pub gamma: f64,
    /// The least darkness, from 0 to 1.
    pub floor: f64,
    /// Where the picture is lighter than this, from 0 to 1, the paper stays empty.
    pub white: f64,
}

impl Default for InkTone {
    fn default() -> Self {
        Self { invert: false, contrast: 1.0, gamma: 1.0, floor: 0.0, white: 1.0 }
    }
}

/// What pens draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Layers {
    /// All dots in black.
    #[default]
    Black,
    /// Cyan, magenta, yellow and black.
    Cmyk,
}

/// How large dots are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum DotSizes {
    /// All the same.
    #[default]
    Constant,
    /// By the tone.
    Tone,
}

/// In which order dots are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum DrawOrder {
    /// A short way for the pen.
    #[default]
    Tour,
    /// Any part of it, from the first dot on, is spread by the tone.
    Progressive,
    /// As they come.
    Input,
}

/// A picture as dots.
pub struct StippleOutcome {
    /// The dots of each pen; of pens that have any.
    pub layers: Vec<DotLayer>,
    /// The picture's width and height, in pixels.
    pub picture_px: [usize; 2],
    is_cancelled: bool,
}

/// The dots of one pen.
pub struct DotLayer {
    /// Its ink.
    pub name: &'static str,
    /// The ink's colour, as `#rrggbb`.
    pub colour: &'static str,
    /// In the picture's pixels, y upwards from its lower left corner.
    pub points: PointSet,
    /// The dots' areas, relative to the largest.
    pub areas: Vec<f64>,
    /// The diameter of the largest dot that neither touches others nor darkens the picture too much, in pixels.
    pub widest_px: f64,
    /// How dark the ink is to be on average, from 0 to 1.
    pub mean_darkness: f64,
    /// What the tone is compared with, if that is asked for.
    pub wanted: Option<Wanted>,
    /// As [`Measures::density_error`](evenly::Measures::density_error), if it is asked for.
    pub density_error: Option<f64>,
}

impl InkTone {
    fn tone(&self) -> Result<Tone, Error> {
        let Self { invert, contrast, gamma, floor, white } = *self;
        let checks = [
            ("contrast", contrast, (0.0..=100.0).contains(&contrast), "0 to 100"),
            ("gamma", gamma, gamma > 0.0 && gamma <= 100.0, "above 0, and 100 at most"),
            ("floor", floor, (0.0..=1.0).contains(&floor), "0 to 1"),
            ("white", white, white > 0.0 && white <= 1.0, "above 0, and 1 at most"),
        ];
        match checks.into_iter().find(|(.., is_good, _)| !is_good) {
            Some((name, value, _, expected)) => Err(Error::invalid(name, value, expected)),
            None => Ok(Tone { is_inverted: !invert, contrast, gamma, floor, cutoff: 1.0 - white }),
        }
    }
}

impl StippleRequest {
    /// The same with the defaults.
    pub fn of(picture: Resource<Colours>, n_points: usize) -> Self {
        Self {
            picture,
            n_points,
            method: Method::default(),
            parameters: Settings::default(),
            seed: 0,
            tone: InkTone::default(),
            layers: Layers::default(),
            sizes: DotSizes::default(),
            order: DrawOrder::default(),
            is_measured: false,
        }
    }

    /// Checks what can be checked without data.
    ///
    /// # Errors
    /// Tones outside their range, what the method is told wrongly, dots that do not fit into memory.
    pub fn check(&self) -> Result<(), Error> {
        Job::Stipple.require("method", self.method)?;
        if self.n_points == 0 {
            return Err(Error::invalid("n_points", 0, "1 or more"));
        }
        Job::Stipple.check(self.method, &self.parameters)?;
        memory::require_points(self.n_points, self.method)?;
        self.tone.tone()?;
        spread::optimizer(self.method, &self.parameters, self.seed).map(drop)
    }

    /// The area that all dots together must have to be as dark as a picture is to be, in pixels.
    ///
    /// # Errors
    /// Tones outside their range.
    pub fn ink_area(&self, picture: &Photograph) -> Result<f64, Error> {
        let [width, height] = picture.size();
        let darkness: f64 = Ink::of(picture, &self.tone.tone()?, self.layers).iter().map(|ink| ink.mean_darkness).sum();
        Ok(darkness * (width * height) as f64)
    }

    /// Makes the dots.
    ///
    /// # Errors
    /// As [`check`](Self::check), for a picture that has no tone, and as the method.
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<StippleOutcome, Error> {
        self.check()?;
        context.enter(Stage::Read);
        let (picture, tone) = (self.picture.get(resources)?, self.tone.tone()?);
        let size = picture.size().map(|n| n as f64);
        let space: Space = Rectangle::new([0.0, 0.0], size).map_err(|error| Error::of(error, picture.name(), &[]))?.into();
        let inks = Ink::of(&picture, &tone, self.layers);
        let mut layers = Vec::new();
        // Of each layer another seed, so that no two put their dots in the same places.
        let seeds = (0..).map(|layer| self.seed.wrapping_add(layer));
        for ((ink, n_points), seed) in inks.iter().zip(shares(&inks, self.n_points)).zip(seeds).filter(|((_, n), _)| *n > 0) {
            layers.push(self.layer(&picture, &tone, space.clone(), ink, n_points, seed, context)?);
        }
        Ok(StippleOutcome { layers, picture_px: picture.size(), is_cancelled: context.is_cancelled() })
    }

    #[expect(clippy::too_many_arguments, reason = "a layer is made of all of it")]
    fn layer(
        &self,
        picture: &Photograph,
        tone: &Tone,
        space: Space,
        ink: &Ink,
        n_points: usize,
        seed: u64,
        context: &mut Context,
    ) -> Result<DotLayer, Error> {
        let tones = ink.tones(picture, tone, self.sizes)?;
        let params = DotsParams { method: self.method, settings: &self.parameters, sizes: self.sizes, order: self.order };
        let made = dots(&params, space, ink, &tones, n_points, seed, context)?;
        let wanted = self.is_measured.then(|| Wanted::new(&made.points, &tones.darkness, ink.mean_darkness)).transpose()?;
        let density_error = if self.is_measured { measure(&made.points).ok().and_then(|measures| measures.density_error) } else { None };
        Ok(DotLayer {
            name: ink.name(),
            colour: ink.colour(),
            // The density's pixels are not needed any more.
            points: made.points.with_density(&Density::uniform()),
            areas: made.areas,
            widest_px: made.widest_px,
            mean_darkness: ink.mean_darkness,
            wanted,
            density_error,
        })
    }
}

impl StippleOutcome {
    /// How the job ended.
    pub fn ending(&self) -> Ending {
        if self.is_cancelled { Ending::Cancelled } else { Ending::Done }
    }
}
