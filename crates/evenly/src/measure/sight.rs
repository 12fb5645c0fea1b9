//! What the points of a polygon see: of their neighbours, and of their cells.

use glam::DVec2;

use super::star::StarMeasures;
use crate::error::Error;
use crate::space::Domain;
use crate::star::Senses;
use crate::triangulation::{LiveMesh, MIRROR, StarBuffer, part_shares};

/// What one point sees, everything relative to it.
pub(super) struct Seen<'a> {
    /// The ways to its neighbours, counter-clockwise.
    pub spokes: &'a [DVec2],
    /// The corners of its cell, counter-clockwise.
    pub cell: &'a [DVec2],
    /// The distance of the cell's farthest place from the nearest point that sees it.
    pub reach: f64,
    /// Whether the cell stays clear of the border.
    pub is_inner: bool,
    /// The mean capacity of all over that of the part in which it lies.
    pub share: f64,
}

impl Seen<'_> {
    /// The same in numbers; the capacity relative to the mean of the part.
    pub fn measures(&self) -> StarMeasures {
        let star = StarMeasures::of(self.spokes, self.cell, self.is_inner);
        StarMeasures { reach: self.reach, capacity: self.share * star.capacity, ..star }
    }
}

/// Looks at what each of some distinct points sees, given in Hilbert order.
pub(super) fn look<T: Send>(domain: &Domain, positions: &[DVec2], look: impl Fn(Seen) -> T + Sync) -> Result<Vec<T>, Error> {
    let shares = domain.border.as_ref().map_or_else(Vec::new, |border| part_shares(border, positions, None));
    let n_points = positions.len();
    let order = (0..n_points as u32).collect();
    let mut mesh = LiveMesh::new(domain, None, positions.to_vec(), order, domain.hex_spacing(n_points))?;
    mesh.look(Senses::default(), |mesh, v, StarBuffer { star, spokes, sight, near, .. }| {
        let ways: Vec<DVec2> = spokes.iter().filter(|spoke| spoke.vertex != MIRROR).map(|spoke| spoke.way).collect();
        let is_inner = sight.outline.is_empty();
        let at = mesh.position(v);
        let squared = if is_inner {
            let centre = |k: usize| {
                let [along_u, along_v] = star.centre(k);
                along_u * spokes[k].way + along_v * spokes[star.after(k)].way
            };
            sight.outline.extend((0..star.n_spokes()).map(centre));
            sight.outline.iter().map(|corner| corner.length_squared()).fold(0.0, f64::max)
        } else {
            // Behind corners cells overlap: what this point sees may be nearer to one that it does not see.
            sight.outline.iter().map(|&corner| mesh.distance_to_seeing(v, near, at + corner)).fold(0.0, f64::max)
        };
        let share = shares.get(v as usize).copied().unwrap_or(1.0);
        let seen = look(Seen { spokes: &ways, cell: &sight.outline, reach: squared.sqrt(), is_inner, share });
        sight.outline.clear();
        seen
    })
}
