//! The model triangle fitted to a triangle, in closed form.
//!
//! For a triangle with spokes u and v from its first corner, A = -(3/2) c + (sqrt(3)/2) J (v - u), with c = (u + v) / 3 and J the quarter
//! turn, is the first Fourier coefficient of its centred corners. The model triangle of side d fits best when it is
//! turned to A, and the energy is E = (2/3) (|A| - (sqrt(3)/2) d)^2 + d^2 / 2 - (4/sqrt(3)) area.

use glam::DVec2;

use crate::density::{Field, SoftField};

/// sqrt(3) / 2.
pub(super) const H: f64 = 0.866_025_403_784_438_6;

/// A way into a gap is halved so often.
const HALVINGS: i32 = 8;

/// The side of the model triangle: the same everywhere, or as long as the density wants it.
pub(super) struct Sides {
    /// The side where the density is 1, its mean.
    pub mean: f64,
    /// No side is longer than this.
    pub longest: f64,
    pub field: Option<SoftField>,
    /// The density itself, where some of it is 0.
    pub gaps: Option<Field>,
}

impl Sides {
    /// The side of a triangle with its centroid there.
    #[inline]
    pub fn at(&self, place: DVec2) -> f64 {
        self.field.as_ref().map_or(self.mean, |field| (self.mean / field.root(place)).min(self.longest))
    }

    /// Whether no points are wanted at a place.
    #[inline]
    pub fn is_gap(&self, place: DVec2) -> bool {
        self.gaps.as_ref().is_some_and(|field| field.at(place) == 0.0)
    }

    /// Where a point comes to that is to go from one place to another: there, or half as far, and so on, where that lies in a gap.
    #[inline]
    pub fn out_of_gap(&self, from: DVec2, by: DVec2) -> DVec2 {
        let Some(field) = &self.gaps else { return by };
        let parts = (0..HALVINGS).map(|k| by * 0.5f64.powi(k));
        parts.into_iter().find(|&part| field.at(from + part) > 0.0).unwrap_or(DVec2::ZERO)
    }
}

/// |A|, from the triangle's spokes.
#[inline]
pub(super) fn amplitude(u: DVec2, v: DVec2) -> f64 {
    let edges = u.length_squared() + v.length_squared() + (v - u).length_squared();
    (0.5 * edges + 2.0 * H * u.perp_dot(v)).max(0.0).sqrt()
}

/// E(T) of equation (3), from |A| and twice the signed area.
#[inline]
pub(super) fn triangle_energy(amplitude: f64, twice_area: f64, side: f64) -> f64 {
    let excess = amplitude - H * side;
    excess * excess / 1.5 + 0.5 * side * side - twice_area / H
}

/// The ways from the corners to the targets of equation (1).
#[inline]
pub(super) fn ways_to_targets(u: DVec2, v: DVec2, amplitude: f64, side: f64) -> [DVec2; 3] {
    let (centre, edge) = ((u + v) / 3.0, v - u);
    let a = -1.5 * centre + H * edge.perp();
    // An inverted equilateral triangle has no best rotation: any will do.
    let radius = side / (2.0 * H);
    let model = if amplitude > 0.0 { a * (radius / amplitude) } else { DVec2::new(radius, 0.0) };
    let (half, turned) = (-0.5 * model, H * model.perp());
    [centre + model, centre + half + turned - u, centre + half - turned - v]
}
