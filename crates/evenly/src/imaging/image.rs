//! [`Image`]: pixels as numbers.

use serde::Serialize;

use crate::error::Error;

/// A picture, grey or in colour; row by row from the top, channels together, 0 for black and 1 for full intensity.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    n_channels: usize,
    values: Vec<f64>,
}

/// How two pictures of one size differ, over all pixels and channels.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ImageDifference {
    /// The mean of the absolute difference.
    pub mean_error: f64,
    /// The root of the mean squared difference.
    pub rmse: f64,
}

impl Image {
    /// The largest picture: 33 million pixels.
    pub const MOST_PIXELS: usize = 1 << 25;

    /// Takes `width * height * n_channels` finite values.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a picture without pixels or with more than [`Self::MOST_PIXELS`], a number of channels that is not 1 or 3, or values of another number or not finite.
    pub fn new(width: usize, height: usize, n_channels: usize, values: Vec<f64>) -> Result<Self, Error> {
        let wrong = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
        if !(1..=Self::MOST_PIXELS).contains(&width.saturating_mul(height)) {
            return wrong("size", format!("{width} x {height}"), "1 to 33554432 pixels");
        }
        if n_channels != 1 && n_channels != 3 {
            return wrong("n_channels", n_channels.to_string(), "1 (grey) or 3 (colour)");
        }
        if width * height * n_channels != values.len() {
            return wrong("values", format!("{} numbers", values.len()), "one for each channel of each pixel");
        }
        match values.iter().find(|value| !value.is_finite()) {
            Some(value) => wrong("values", value.to_string(), "finite"),
            None => Ok(Self { width, height, n_channels, values }),
        }
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// 1 for grey, 3 for red, green and blue.
    pub fn n_channels(&self) -> usize {
        self.n_channels
    }

    /// All values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// One pixel's channels.
    pub(super) fn pixel(&self, x: usize, y: usize) -> &[f64] {
        &self.values[(x + y * self.width) * self.n_channels..][..self.n_channels]
    }

    /// How it differs from another.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] if sizes or channels differ.
    pub fn difference(&self, other: &Self) -> Result<ImageDifference, Error> {
        let shape = |image: &Self| (image.width, image.height, image.n_channels);
        if shape(self) != shape(other) {
            let value = format!("{:?}", shape(other));
            return Err(Error::InvalidParameter { name: "other", value, expected: "a picture of the same size and channels" });
        }
        let n = self.values.len() as f64;
        let differences = || self.values.iter().zip(&other.values).map(|(a, b)| a - b);
        let mean_error = differences().map(f64::abs).sum::<f64>() / n;
        Ok(ImageDifference { mean_error, rmse: (differences().map(|d| d * d).sum::<f64>() / n).sqrt() })
    }
}
