//! [`Density`]: how many points are wanted where.

mod field;
mod raster;
mod soft;
#[cfg(test)]
mod tests;
mod walk;

pub(crate) use field::Field;
pub(crate) use soft::SoftField;

use std::sync::Arc;

use glam::DVec2;

use crate::error::Error;
use crate::space::{Domain, Space};
use raster::Raster;

/// How many points are wanted where, in proportion: the same everywhere, or as the pixels of a picture that spans the domain have it. Cheap to clone.
#[derive(Debug, Clone, Default)]
pub struct Density(Option<Arc<Raster>>);

impl Density {
    /// The largest picture: 20,000 x 20,000 pixels.
    pub const MOST_PIXELS: usize = 400_000_000;

    /// The same everywhere.
    pub fn uniform() -> Self {
        Self(None)
    }

    /// `width * height` densities, row by row, the first of which lies at the top of the domain, where y is largest. Only their proportions count. Where a density is 0
    /// there will be no points.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for no pixels or more than [`Self::MOST_PIXELS`], for another number of densities, and for densities that are negative, not finite, or 0 everywhere.
    ///
    /// # Example
    /// ```
    /// use evenly::{Density, PushPullParams, RunContext, Torus, push_pull, warp_isotropic, white_by_density};
    ///
    /// // Nine times as dense at the right as at the left.
    /// let density = Density::image(3, 1, &[1.0, 3.0, 9.0])?;
    /// let mut points = white_by_density(Torus::new([0.0, 0.0], [1.0, 1.0])?, &density, 1300, 7)?;
    /// warp_isotropic(&mut points);
    /// push_pull(&mut points, &PushPullParams::default(), &mut RunContext::default())?;
    /// let left = points.positions().iter().filter(|p| p[0] < 1.0 / 3.0).count();
    /// assert!(left.abs_diff(100) < 20, "{left}");
    /// # Ok::<(), evenly::Error>(())
    /// ```
    pub fn image(width: usize, height: usize, values: &[f32]) -> Result<Self, Error> {
        let wrong = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
        if !(1..=Self::MOST_PIXELS).contains(&width.saturating_mul(height)) {
            return wrong("size", format!("{width} x {height}"), "1 to 400 million pixels");
        }
        if values.len() != width * height {
            return wrong("values", format!("{} numbers", values.len()), "one density a pixel");
        }
        if let Some(value) = values.iter().find(|&&value| !(value >= 0.0 && value.is_finite())) {
            return wrong("values", value.to_string(), "0 or more, and finite");
        }
        // Rows from the bottom, where y begins.
        let raster = Raster::new(width, values.chunks_exact(width).rev());
        if raster.total() == 0.0 {
            return wrong("values", "0 everywhere".into(), "more than 0 somewhere");
        }
        Ok(Self(Some(Arc::new(raster))))
    }

    /// What a function of the place, in input units, is in the middle of `width * height` pixels.
    ///
    /// # Errors
    /// As [`Self::image`].
    pub fn function(space: &Space, width: usize, height: usize, density: impl Fn([f64; 2]) -> f64) -> Result<Self, Error> {
        let (origin, size) = (space.origin(), space.size());
        let along = |axis: usize, k: usize, n: usize| origin[axis] + (k as f64 + 0.5) / n as f64 * size[axis];
        if width.saturating_mul(height) > Self::MOST_PIXELS {
            return Self::image(width, height, &[]);
        }
        let rows = (0..height).rev();
        let pixels = rows.flat_map(|row| (0..width).map(move |column| (column, row)));
        let values: Vec<f32> = pixels.map(|(column, row)| density([along(0, column, width), along(1, row, height)]) as f32).collect();
        Self::image(width, height, &values)
    }

    /// The mean over each pixel of another grid, row by row from the top; 1 is the mean of all.
    pub fn resampled(&self, width: usize, height: usize) -> Vec<f64> {
        let domain = Domain::new([0.0, 0.0], [1.0, 1.0], false);
        let Some(field) = self.field(&domain) else { return vec![1.0; width * height] };
        let size = DVec2::new(1.0 / width as f64, 1.0 / height as f64);
        let low = |column: usize, row: usize| DVec2::new(column as f64, row as f64) * size;
        let mean = |column: usize, row: usize| field.mass_in(low(column, row), low(column + 1, row + 1)) / (size.x * size.y);
        (0..height).rev().flat_map(|row| (0..width).map(move |column| mean(column, row))).collect()
    }

    /// Whether it is the same everywhere.
    pub fn is_uniform(&self) -> bool {
        self.0.is_none()
    }

    /// The same in normalised coordinates; `None` where it is uniform.
    pub(crate) fn field(&self, domain: &Domain) -> Option<Field> {
        self.0.as_ref().map(|raster| Field::new(raster, domain))
    }
}

/// Densities are the same that share their pixels.
impl PartialEq for Density {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}
