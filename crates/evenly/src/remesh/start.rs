//! The start of a remeshing: exactly n vertices on the surface, with its topology and along its features.

use super::chains::pin_chains;
use super::draft::Draft;
use super::eliminate::{eliminate, subdivide};
use super::given::{n_kept, on_edges, put_all};
use super::live::{Start, Vertex};
use super::rows::rows;
use crate::error::Error;
use crate::geometry::spacing::hexagonal_spacing;
use crate::surface::{Features, Place, Surface};

/// The spacing of so many vertices on a surface: the edge of equilateral triangles, two for each.
pub(super) fn spacing(surface: &Surface, n_points: usize) -> f64 {
    hexagonal_spacing(surface.inner_area(), n_points as f64)
}

/// What a start is to be.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub surface: &'a Surface,
    pub features: &'a Features,
    /// Relative to the mean, at each vertex of the surface.
    pub sizes: &'a [f64],
    pub n_points: usize,
    /// Whether vertices beside creases begin in rows.
    pub has_rows: bool,
    /// Places to choose from, if there are any, and how far from the surface they were given.
    pub given: &'a [(Place, f64)],
    pub seed: u64,
}

/// Splits and collapses edges of the surface until exactly so many vertices are left; of given places, if there are any. How many
/// are needed, where the features and the topology do not let it be so few.
///
/// # Errors
/// [`Error::InvalidParameter`] for two given places that are one.
pub(super) fn start(wanted: Wanted) -> Result<Result<Start, usize>, Error> {
    let mut least = usize::MAX;
    for round in 0..ROUNDS {
        let seed = wanted.seed.wrapping_add(round as u64);
        match attempt(Wanted { seed, ..wanted }, SPARING.powi(round.min(SPARINGS)))? {
            Ok(start) => return Ok(Ok(start)),
            Err(n) => least = least.min(n),
        }
    }
    Ok(Err(least))
}

/// Rows beside creases are no more than this part of the vertices.
const MOST_IN_ROWS: f64 = 0.25;

/// Where creases and boundaries leave too few vertices for the rest, they have so many times fewer in the next round, up to some; what is
/// collapsed first is another edge in each.
const SPARING: f64 = 1.5;
const SPARINGS: i32 = 8;
const ROUNDS: i32 = 24;

/// As [`start`], with points on creases and boundaries so many spacings apart; how many vertices are needed where these are not enough.
fn attempt(wanted: Wanted, spacings: f64) -> Result<Result<Start, usize>, Error> {
    let Wanted { surface, features, sizes, n_points, has_rows, given, seed } = wanted;
    let spacing = spacing(surface, n_points);
    let mut draft = Draft::new(surface, features, sizes);
    // 1. Points along creases and boundaries.
    let gaps = match pin_chains(&mut draft, spacings * spacing, n_points, &on_edges(surface, given)) {
        Ok(gaps) => gaps,
        Err(least) => return Ok(Err(least)),
    };
    draft.split_doubles();
    features.tips.iter().for_each(|&v| draft.pin(v));
    // 2. Vertices to choose from.
    if given.is_empty() {
        let is_uniform = sizes.iter().all(|&size| size == 1.0);
        let rows = if has_rows && is_uniform { rows(&draft, &gaps, spacing) } else { Vec::new() };
        if (rows.len() as f64) < MOST_IN_ROWS * n_points as f64 {
            put_all(&mut draft, &rows)?;
        }
        subdivide(&mut draft, spacing, n_points, seed);
    } else {
        put_all(&mut draft, given)?;
        // All others go first.
        let n_kept = n_kept(&draft).max(n_points);
        eliminate(&mut draft, n_kept, seed);
        draft.keeps_given = false;
    }
    // 3. As many as are wanted.
    draft.tidy();
    let mut is_reached = eliminate(&mut draft, n_points, seed);
    if !is_reached && draft.keeps_given {
        draft.keeps_given = false;
        is_reached = eliminate(&mut draft, n_points, seed);
    }
    Ok(if is_reached { Ok(finished(draft)) } else { Err(draft.n_live) })
}

/// What is left.
fn finished(mut draft: Draft) -> Start {
    draft.tidy();
    let vertex = |of: &super::draft::Vertex| {
        let Place { at, face, weights } = of.place;
        Vertex { at, normal: of.normal, size: of.size, face, weights }
    };
    let ends = |h: usize| {
        let [a, b] = [draft.mesh.origin[h], draft.mesh.target(h as u32)];
        [a.min(b), a.max(b)]
    };
    let mut bonds: Vec<[u32; 2]> = (0..draft.mesh.origin.len()).filter(|&h| draft.is_crease[h]).map(ends).collect();
    bonds.sort_unstable();
    bonds.dedup();
    let given: Vec<u32> = (0..).zip(&draft.vertices).filter(|(_, vertex)| vertex.is_given).map(|(v, _)| v).collect();
    Start {
        vertices: draft.vertices.iter().map(vertex).collect(),
        fixed: draft.vertices.iter().map(|vertex| vertex.is_pinned).collect(),
        bonds,
        n_given: given.len(),
        rows: if draft.keeps_given { given } else { Vec::new() },
        half_edges: draft.mesh,
    }
}
