//! What each pen draws: the picture in one ink or in four.

use evenly::Density;
use evenly_io::{Photograph, Tone, luma};

use super::{DotSizes, Layers};
use crate::error::Error;

/// One pen's share of the picture.
pub struct Ink {
    separation: Separation,
    /// How dark it is to be on average, from 0 to 1.
    pub mean_darkness: f64,
}

/// An ink's tones, which take memory.
pub struct Tones {
    /// How dark the picture is to be, 1 on average.
    pub darkness: Density,
    /// How many dots are wanted where: the same, if all are of one size.
    pub density: Density,
}

/// A pen's name and colour, and what of a colour is its.
type Separation = (&'static str, &'static str, fn([f32; 3]) -> f32);

/// The area of the smallest dots, relative to the largest.
const SMALLEST: f64 = 0.25;

/// The area of a dot where the picture is so dark, relative to the largest.
pub fn dot_area(darkness: f64) -> f64 {
    SMALLEST + (1.0 - SMALLEST) * darkness.clamp(0.0, 1.0)
}

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

impl Ink {
    /// The inks of a picture.
    pub fn of(photograph: &Photograph, tone: &Tone, layers: Layers) -> Vec<Self> {
        let separations: &[Separation] = if layers == Layers::Cmyk { &CMYK } else { &BLACK };
        let ink = |&separation| {
            let values = Self { separation, mean_darkness: 0.0 }.values(photograph, tone);
            let mean_darkness = values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64;
            Self { separation, mean_darkness }
        };
        separations.iter().map(ink).collect()
    }

    pub fn name(&self) -> &'static str {
        self.separation.0
    }

    pub fn colour(&self) -> &'static str {
        self.separation.1
    }

    fn values(&self, photograph: &Photograph, tone: &Tone) -> Vec<f32> {
        // Separations are dark already.
        let of_dark = Tone { is_inverted: !tone.is_inverted, ..*tone };
        photograph.values(|colour| of_dark.density(self.separation.2(colour)))
    }

    /// Its tones in a picture.
    ///
    /// # Errors
    /// It has nothing to draw.
    pub fn tones(&self, photograph: &Photograph, tone: &Tone, sizes: DotSizes) -> Result<Tones, Error> {
        let mut values = self.values(photograph, tone);
        let darkness = photograph.density_of(&values)?;
        let density = match sizes {
            DotSizes::Constant => darkness.clone(),
            DotSizes::Tone => {
                values.iter_mut().for_each(|value| *value /= dot_area(f64::from(*value)) as f32);
                photograph.density_of(&values)?
            }
        };
        Ok(Tones { darkness, density })
    }
}

/// So many dots divided among inks as their darkness wants it, exactly; an ink may get none. All to the last where there is no darkness.
pub fn shares(inks: &[Ink], n_points: usize) -> Vec<usize> {
    let total: f64 = inks.iter().map(|ink| ink.mean_darkness).sum();
    let (mut darkness, mut n_given) = (0.0, 0);
    let share = |(k, ink): (usize, &Ink)| {
        darkness += ink.mean_darkness;
        let n_upto = if k + 1 == inks.len() { n_points } else { ((darkness / total * n_points as f64).round() as usize).min(n_points) };
        let share = n_upto - n_given;
        n_given = n_upto;
        share
    };
    inks.iter().enumerate().map(share).collect()
}
