//! [`Photograph`]: a picture's tones as densities.

use std::path::Path;

use evenly::Density;
use image::{DynamicImage, ImageBuffer, Luma, LumaA, Pixel, Rgb, Rgba};

use crate::Error;
use crate::image::decode;

/// A picture from a file, of up to [`Density::MOST_PIXELS`].
pub struct Photograph {
    name: String,
    pixels: DynamicImage,
}

/// What makes a density of a tone, in this order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tone {
    /// Whether dark counts, as ink does, instead of light.
    pub is_inverted: bool,
    /// Tones are spread from the middle grey by this factor; 1 leaves them.
    pub contrast: f64,
    /// Tones from 0 to 1 are raised to this power; 1 leaves them.
    pub gamma: f64,
    /// The part of the largest density that there is at least.
    pub floor: f64,
    /// Tones below this have no density at all, before all else.
    pub cutoff: f64,
}

impl Default for Tone {
    fn default() -> Self {
        Self { is_inverted: false, contrast: 1.0, gamma: 1.0, floor: 0.0, cutoff: 0.0 }
    }
}

impl Tone {
    /// The density that a tone from 0 to 1 stands for.
    pub fn density(&self, tone: f32) -> f32 {
        let tone = f64::from(if self.is_inverted { 1.0 - tone } else { tone });
        if tone < self.cutoff {
            return 0.0;
        }
        let spread = (self.contrast * (tone - 0.5) + 0.5).clamp(0.0, 1.0);
        (self.floor + (1.0 - self.floor) * spread.powf(self.gamma)) as f32
    }
}

/// How bright a colour is: its luma after ITU-R BT.709.
pub fn luma([red, green, blue]: [f32; 3]) -> f32 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

impl Photograph {
    /// Reads a picture as [`read_image`](crate::read_image) does. Of an animation the first counts.
    ///
    /// # Errors
    /// [`Error`] with the file's name, for what is no such picture.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let (name, pixels) = decode(path, Density::MOST_PIXELS)?;
        Ok(Self { name, pixels })
    }

    /// A picture of these colours, red, green, blue and opacity from 0 to 1, row by row from the top; `None` where they are not `width * height`.
    pub fn of_colours(name: &str, [width, height]: [usize; 2], colours: &[[f32; 4]]) -> Option<Self> {
        let pixels = ImageBuffer::from_raw(width.try_into().ok()?, height.try_into().ok()?, colours.as_flattened().to_vec())?;
        (colours.len() == width * height).then(|| Self { name: name.into(), pixels: DynamicImage::ImageRgba32F(pixels) })
    }

    /// Its name for messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Width and height, in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.pixels.width() as usize, self.pixels.height() as usize]
    }

    /// For each pixel, row by row from the top, what becomes of its colour, times how opaque it is.
    pub fn values(&self, value: impl Fn([f32; 3]) -> f32) -> Vec<f32> {
        let grey = |tone: f32, alpha: f32| alpha * value([tone; 3]);
        let colour = |[red, green, blue]: [f32; 3], alpha: f32| alpha * value([red, green, blue]);
        match &self.pixels {
            DynamicImage::ImageLuma8(pixels) => each(pixels, |&Luma([v])| grey(byte(v), 1.0)),
            DynamicImage::ImageLumaA8(pixels) => each(pixels, |&LumaA([v, a])| grey(byte(v), byte(a))),
            DynamicImage::ImageRgb8(pixels) => each(pixels, |&Rgb(rgb)| colour(rgb.map(byte), 1.0)),
            DynamicImage::ImageRgba8(pixels) => each(pixels, |&Rgba([r, g, b, a])| colour([r, g, b].map(byte), byte(a))),
            DynamicImage::ImageLuma16(pixels) => each(pixels, |&Luma([v])| grey(word(v), 1.0)),
            DynamicImage::ImageLumaA16(pixels) => each(pixels, |&LumaA([v, a])| grey(word(v), word(a))),
            DynamicImage::ImageRgb16(pixels) => each(pixels, |&Rgb(rgb)| colour(rgb.map(word), 1.0)),
            DynamicImage::ImageRgba16(pixels) => each(pixels, |&Rgba([r, g, b, a])| colour([r, g, b].map(word), word(a))),
            other => {
                let unit = |v: f32| if v.is_finite() { v.clamp(0.0, 1.0) } else { 0.0 };
                each(&other.to_rgba32f(), |&Rgba([r, g, b, a])| colour([r, g, b].map(unit), unit(a)))
            }
        }
    }

    /// Its luma as a density.
    ///
    /// # Errors
    /// [`Error::Content`] where no pixel has any.
    pub fn density(&self, tone: &Tone) -> Result<Density, Error> {
        self.density_of(&self.values(|colour| tone.density(luma(colour))))
    }

    /// Densities of its pixels, as [`Self::values`] makes them.
    ///
    /// # Errors
    /// [`Error::Content`] where no pixel has any.
    pub fn density_of(&self, values: &[f32]) -> Result<Density, Error> {
        let [width, height] = self.size();
        if values.iter().all(|&value| value == 0.0) {
            return Err(Error::content(&self.name, "no place for points: the density is 0 everywhere; invert it, or give it a floor"));
        }
        Density::image(width, height, values).map_err(|e| Error::content(&self.name, e.to_string()))
    }
}

fn byte(value: u8) -> f32 {
    f32::from(value) / 255.0
}

fn word(value: u16) -> f32 {
    f32::from(value) / 65535.0
}

fn each<P: Pixel>(pixels: &ImageBuffer<P, Vec<P::Subpixel>>, value: impl Fn(&P) -> f32) -> Vec<f32> {
    pixels.pixels().map(value).collect()
}
