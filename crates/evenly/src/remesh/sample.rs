//! Points on a surface, without a mesh: each with its facet, its barycentric coordinates and the normal.

use super::{RemeshParams, SurfacePoint, relative_sizes, remesh, validate_sizes};
use crate::error::Error;
use crate::geometry::spacing::hexagonal_spacing;
use crate::methods::LocalMethod;
use crate::run::{Outcome, Phase, Report, RunContext};
use crate::surface::{Features, Place, Surface, poisson_disk, white};

/// How points are spread over a surface.
#[derive(Debug, Clone, PartialEq)]
pub enum SurfaceSampling {
    /// Independent points, so many.
    White(usize),
    /// A maximal Poisson-disk sample with a spacing, in input units; where sizes vary, their mean, and two points are as far apart as the smaller of theirs.
    PoissonDisk(f64),
    /// So many as the vertices of a [`remesh`], without features.
    Vertices(usize, LocalMethod),
}

/// What [`sample_surface`] can be told.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleParams {
    /// The method.
    pub sampling: SurfaceSampling,
    /// How far apart points are to be, in proportion, at each vertex of the surface; empty where they are to be spread alike.
    pub sizes: Vec<f64>,
    /// The same seed gives the same points.
    pub seed: u64,
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
/// [`Error::InvalidParameter`] for a spacing that is not positive, or so small that more than 40 million points would fit, for no points, and as
/// [`RemeshParams::validate`] has it for the sizes and the method.
///
/// # Example
/// ```
/// use evenly::{RunContext, SampleParams, Surface, SurfaceSampling, TriangleMesh, sample_surface};
///
/// let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
/// let surface = Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() })?;
/// let params = SampleParams { sampling: SurfaceSampling::PoissonDisk(0.1), sizes: Vec::new(), seed: 7 };
/// let (points, _) = sample_surface(&surface, &params, &mut RunContext::default())?;
/// assert!(points.len() > 100 && points.iter().all(|point| point.facet < 4));
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn sample_surface(surface: &Surface, params: &SampleParams, run: &mut RunContext) -> Result<(Vec<SurfacePoint>, Report), Error> {
    let SampleParams { sampling, sizes, seed } = params;
    let invalid = |name, value: String, expected| Error::InvalidParameter { name, value, expected };
    let require_some = |n: usize| match n {
        1..=crate::MAX_POINTS => Ok(()),
        _ => Err(invalid("n_points", n.to_string(), "1 or more, and at most 40 million")),
    };
    validate_sizes(surface, sizes)?;
    let relative = relative_sizes(surface, sizes);
    let features = Features::boundaries(surface);
    let done = |method, places: Vec<Place>| {
        let points: Vec<SurfacePoint> = places.into_iter().map(|place| SurfacePoint::new(surface, &features, &place)).collect();
        let mut report = Report::new(method, points.len());
        report.outcome = Outcome::Converged;
        (points, report)
    };
    // Where no mesh has so few vertices.
    let by_distance = |n: usize| {
        let (points, mut report) = done("eliminate", farthest(white(surface, &relative, CANDIDATES * n, *seed), n));
        report.notes.push("no mesh of the surface has so few vertices; the points are spread by straight distances".into());
        Ok((points, report))
    };
    run.enter(Phase::Separate);
    match *sampling {
        SurfaceSampling::White(n) => {
            require_some(n)?;
            Ok(done("white", white(surface, &relative, n, *seed)))
        }
        SurfaceSampling::PoissonDisk(spacing) => {
            let inside = surface.frame.length_inward(spacing);
            let n_expected = surface.inner_area() / (0.7 * inside * inside);
            if !(spacing > 0.0 && n_expected <= crate::MAX_POINTS as f64) {
                return Err(invalid("spacing", spacing.to_string(), "positive, and such that at most 40 million points fit"));
            }
            Ok(done("poisson-disk", poisson_disk(surface, &relative, inside, *seed)))
        }
        SurfaceSampling::Vertices(n_points, ref method) => {
            require_some(n_points)?;
            if n_points < LEAST_OF_PART * surface.n_components() {
                return by_distance(n_points);
            }
            let (method, sizes) = (method.clone(), sizes.clone());
            let params = RemeshParams {
                n_vertices: n_points,
                method,
                sizes,
                features_deg: None,
                max_deviation: None,
                seed: *seed,
                ..RemeshParams::default()
            };
            match remesh(surface, &params, run) {
                Err(Error::InvalidParameter { name: "n_vertices", .. }) => by_distance(n_points),
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
