//! Points on a surface, without a mesh: each with its facet, its barycentric coordinates and the normal.

use serde::Serialize;

use super::start::{Wanted, start};
use super::{RemeshParams, SurfacePoint, remesh};
use crate::error::Error;
use crate::geometry::spacing::hexagonal_spacing;
use crate::run::{Outcome, Phase, Report, RunContext};
use crate::surface::{Features, Place, Surface, poisson_disk, white};

/// How points are spread over a surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SurfaceSampling {
    /// Independent uniform points, so many.
    White(usize),
    /// A maximal Poisson-disk sample with a spacing, in input units.
    PoissonDisk(f64),
    /// So many by elimination along the surface's own edges.
    Eliminate(usize),
    /// So many by push-pull optimization: the vertices of a [`remesh`], without features.
    PushPull(usize),
}

/// The smallest distance of a maximal Poisson-disk sample, in the spacings of the hexagonal lattice with as many points.
const SPACING_OF_MAXIMAL: f64 = 0.78;

impl SurfaceSampling {
    /// A maximal Poisson-disk sample with about so many points.
    pub fn poisson_disk_of(surface: &Surface, n_points: usize) -> Self {
        Self::PoissonDisk(SPACING_OF_MAXIMAL * hexagonal_spacing(surface.area(), n_points.max(1) as f64))
    }
}

/// Spreads points over a surface.
///
/// # Errors
/// [`Error::InvalidParameter`] for a spacing that is not positive, or so small that more than 40 million points would fit, and for no points.
///
/// # Example
/// ```
/// use evenly::{RunContext, Surface, SurfaceSampling, TriangleMesh, sample_surface};
///
/// let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
/// let surface = Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() })?;
/// let (points, _) = sample_surface(&surface, SurfaceSampling::PoissonDisk(0.1), 7, &mut RunContext::default())?;
/// assert!(points.len() > 100 && points.iter().all(|point| point.facet < 4));
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn sample_surface(
    surface: &Surface,
    sampling: SurfaceSampling,
    seed: u64,
    run: &mut RunContext,
) -> Result<(Vec<SurfacePoint>, Report), Error> {
    let invalid = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
    let features = Features::borders(surface);
    let shown = |places: Vec<Place>| places.into_iter().map(|place| SurfacePoint::new(surface, &features, &place)).collect::<Vec<_>>();
    let done = |method, points: Vec<SurfacePoint>| {
        let mut report = Report::new(method, points.len());
        report.outcome = Outcome::Converged;
        Ok((points, report))
    };
    // Where no mesh has so few vertices.
    let by_distance = |n: usize| {
        let mut report = Report::new("eliminate", n);
        report.outcome = Outcome::Converged;
        report.notes.push("no mesh of the surface has so few vertices; the points are spread by straight distances".into());
        (shown(farthest(white(surface, CANDIDATES * n, seed), n)), report)
    };
    let is_too_few = |e: &Error| matches!(e, Error::InvalidParameter { name: "n_points", .. });
    run.enter(Phase::Separate);
    match sampling {
        SurfaceSampling::White(n) if !(1..=crate::MAX_POINTS).contains(&n) => {
            invalid("n_points", n.to_string(), "1 or more, and at most 40 million")
        }
        SurfaceSampling::White(n) => done("white", shown(white(surface, n, seed))),
        SurfaceSampling::PoissonDisk(spacing) => {
            let inside = surface.frame.length_inward(spacing);
            let n_expected = surface.inner_area() / (0.7 * inside * inside);
            if !(spacing > 0.0 && n_expected <= crate::MAX_POINTS as f64) {
                return invalid("spacing", spacing.to_string(), "positive, and such that at most 40 million points fit");
            }
            done("poisson-disk", shown(poisson_disk(surface, inside, seed)))
        }
        SurfaceSampling::Eliminate(n) | SurfaceSampling::PushPull(n) if !(1..=crate::MAX_POINTS).contains(&n) => {
            invalid("n_points", n.to_string(), "1 or more, and at most 40 million")
        }
        SurfaceSampling::Eliminate(n) | SurfaceSampling::PushPull(n) if n < LEAST_OF_PART * surface.n_components() => Ok(by_distance(n)),
        SurfaceSampling::Eliminate(n) => {
            let sizes = vec![1.0; surface.n_vertices()];
            match start(Wanted { surface, features: &features, sizes: &sizes, n_points: n, given: &[], seed })? {
                Err(_) => Ok(by_distance(n)),
                Ok(start) => done("eliminate", start.vertices.iter().map(|vertex| vertex.shown(surface)).collect()),
            }
        }
        SurfaceSampling::PushPull(n_points) => {
            let params = RemeshParams { n_points, features_deg: None, tolerance: None, seed, ..RemeshParams::default() };
            match remesh(surface, &params, run) {
                Err(e) if is_too_few(&e) => Ok(by_distance(n_points)),
                made => made.map(|(remeshed, report)| (remeshed.places, report)),
            }
        }
    }
}

/// With fewer points than this for each part, there may be no mesh of them.
const LEAST_OF_PART: usize = 8;
/// Points to choose from, for each that is wanted.
const CANDIDATES: usize = 8;

/// Of many places so many, each the farthest from those before it.
fn farthest(places: Vec<Place>, n: usize) -> Vec<Place> {
    let mut distances = vec![f64::INFINITY; places.len()];
    let mut chosen = Vec::with_capacity(n);
    let mut next = 0;
    while chosen.len() < n {
        chosen.push(places[next]);
        let at = places[next].at;
        let mut largest = -1.0;
        for (k, (place, distance)) in places.iter().zip(&mut distances).enumerate() {
            *distance = distance.min(place.at.distance_squared(at));
            if *distance > largest {
                (next, largest) = (k, *distance);
            }
        }
    }
    chosen
}
