//! Remeshing: a surface with exactly as many vertices as are wanted, spread evenly, and by default without an obtuse triangle.
//!
//! Ahmed, Guo, Yan, Franceschi, Zhang and Deussen, "A Simple Push-Pull Algorithm for Blue-Noise Sampling", IEEE Transactions on Visualization
//! and Computer Graphics 23(12), 2017, doi 10.1109/TVCG.2016.2641963, sections 4.3 and 5.3.
//!
//! What differs from the paper, and why:
//! - There is no restricted Voronoi diagram, but one mesh over the points from the start to the end, whose edges are flipped where the angles across exceed pi. Its
//!   topology is the surface's from the start, and stays.
//! - The start is not a random set: long edges of the surface are split, and short ones collapsed, until the number is right. Given points, if there are any, come into the
//!   surface's triangles as vertices, and all others are collapsed.
//! - Points land on the nearest place to which a walk along the surface leads, never on another sheet; a move that would turn a triangle away from the surface is not made.
//! - Creases and boundaries are kept: the points along them come first, and stay.
//! - Vertices go from where a crease has too many beside it to where it has too few, and runs that miss little begin again with another seed.
//! - Where the wanted spacing varies it counts a triangle at a time, so that the bounds on angles hold as they do where it is uniform.
//!
//! Cost: O(n) passes of about a microsecond a visit, some 60 visits per point. The start, a fifth of the time, is on one thread. It does not promise that the targets are reached, but the
//! report says so.

mod anchors;
mod cells;
mod chains;
mod coarse;
mod collapse;
mod draft;
mod eliminate;
mod flips;
mod forced;
mod given;
mod ground;
mod live;
mod moves;
mod polish;
mod queue;
mod rows;
mod sample;
mod settle;
mod shape;
mod stars;
mod start;
mod targets;
mod transplant;

use std::collections::HashSet;

use serde::Serialize;

use self::live::{LiveSurface, Vertex};
pub use self::sample::{SampleParams, SurfaceSampling, sample_surface};
use self::settle::settle;
use self::start::{Wanted, start};
use crate::error::Error;
use crate::methods::{Local, LocalMethod, PushPullParams};
use crate::run::{Outcome, Phase, Report, RunContext};
use crate::surface::{Attribute, Features, Place, SIZE, Surface, TriangleMesh, weighted_area};
use crate::sweep::Ground as _;
use crate::triangulation::prev;

/// So often runs begin again with another seed that have so few vertices, and miss little.
const MORE_TRIES: u64 = 3;
const FEW: usize = 10_000;
/// That is: so many degrees, all triangles together, of what every mesh is to keep; the targets at so many triangles, and at one more per so many vertices.
const LITTLE_DEG: f64 = 5.0;
const MISSED: usize = 40;
const PART: usize = 50;
/// The smallest size over the largest, at least.
const SMALLEST_SIZE: f64 = 1e-6;

/// What [`remesh`] can be told.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RemeshParams {
    /// How many vertices the mesh is to have, exactly; 3 at least, and 4 of a closed surface.
    pub n_vertices: usize,
    /// By which rule they find their places; of `eliminate`, which makes points, they stay where the start, or given points, have them.
    pub method: LocalMethod,
    /// Edges at which the surface turns by more than this are kept if they stand out and are some spacings long, and tips if they can be; boundaries are in any case; in (0, 180).
    /// `None` for boundaries alone.
    pub features_deg: Option<f64>,
    /// Where a vertex of the surface is farther from the mesh than this, in spacings, a vertex is put there, and stays if the targets can be met so; `None` for nowhere.
    pub max_deviation: Option<f64>,
    /// How long edges are to be, in proportion, at each vertex of the surface; empty where they are to be alike.
    #[serde(skip)]
    pub sizes: Vec<f64>,
    /// Points on the surface, or near it, at which vertices are to begin, at least as many as are wanted; empty for a start by elimination.
    #[serde(skip)]
    pub points: Vec<[f64; 3]>,
    /// The start and the order of visits depend on it.
    pub seed: u64,
}

impl Default for RemeshParams {
    fn default() -> Self {
        Self {
            n_vertices: 1000,
            method: Self::usual_method(),
            features_deg: Some(40.0),
            max_deviation: Some(0.5),
            sizes: Vec::new(),
            points: Vec::new(),
            seed: 0,
        }
    }
}

impl RemeshParams {
    /// Push-Pull to the paper's {0.90, 0.63}, which leave no obtuse triangle, with a tolerance that takes a third of the time.
    fn usual_method() -> LocalMethod {
        let (min_distance, coverage_radius, capacity_tolerance) = (Some(0.90), Some(0.63), Some(0.1));
        PushPullParams { min_distance, coverage_radius, capacity_tolerance, ..PushPullParams::default() }.into()
    }

    /// Checks the parameters, as [`remesh`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a value outside its range, sizes that are not positive, differ more than a millionfold, or are not as many as the surface has vertices, and
    /// points that are not finite, or fewer than are wanted.
    pub fn validate(&self, surface: &Surface) -> Result<(), Error> {
        let invalid = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
        if self.n_vertices < 3 || self.n_vertices > crate::MAX_POINTS {
            return invalid("n_vertices", self.n_vertices.to_string(), "3 or more, and at most 40 million");
        }
        if let Some(angle) = self.features_deg.filter(|&angle| !(angle > 0.0 && angle < 180.0)) {
            return invalid("features_deg", angle.to_string(), "more than 0, and less than 180");
        }
        if let Some(length) = self.max_deviation.filter(|&length| !(length > 0.0 && length.is_finite())) {
            return invalid("max_deviation", length.to_string(), "positive and finite");
        }
        validate_sizes(surface, &self.sizes)?;
        if !self.points.is_empty() && self.points.len() < self.n_vertices {
            let value = format!("{} where {} vertices are wanted", self.points.len(), self.n_vertices);
            return invalid("points", value, "at least as many, or none");
        }
        if let Some((k, p)) = self.points.iter().enumerate().find(|(_, p)| !p.iter().all(|x| x.is_finite())) {
            return invalid("points", format!("({}, {}, {}) at {k}", p[0], p[1], p[2]), "finite");
        }
        self.method.check()
    }
}

/// # Errors
/// [`Error::InvalidParameter`] for sizes that are not positive, differ more than a millionfold, or are not as many as the surface has vertices.
fn validate_sizes(surface: &Surface, sizes: &[f64]) -> Result<(), Error> {
    let invalid = |value: String, expected| Err(Error::InvalidParameter { name: "sizes", value, expected });
    if !sizes.is_empty() && sizes.len() != surface.n_vertices() {
        return invalid(format!("{} numbers", sizes.len()), "as many as the surface has vertices, or none");
    }
    if let Some(size) = sizes.iter().find(|&&size| !(size > 0.0 && size.is_finite())) {
        return invalid(size.to_string(), "positive and finite");
    }
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    if let Some(size) = sizes.iter().find(|&&size| size < largest * SMALLEST_SIZE) {
        return invalid(format!("{size}, and {largest} elsewhere"), "such that the largest is at most a million times the smallest");
    }
    Ok(())
}

/// A surface's new mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Remeshed {
    /// Vertices in input units, triangles that run as the surface's do, what the surface's vertices carry, interpolated, and as `edge_length` how long edges are to be there.
    pub mesh: TriangleMesh,
    /// Where each vertex lies on the mesh that was given.
    pub places: Vec<SurfacePoint>,
    /// Triangles that miss the targets because an angle of the input cannot be divided better; see [`Outcome::Forced`](crate::Outcome::Forced).
    pub forced: Vec<usize>,
}

/// A place on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// In input units.
    pub position: [f64; 3],
    /// The triangle of the given mesh on which it lies.
    pub facet: usize,
    /// The weights of that triangle's corners.
    pub barycentric: [f64; 3],
    /// The surface's unit normal, rounded between creases.
    pub normal: [f64; 3],
}

impl SurfacePoint {
    fn new(surface: &Surface, features: &Features, place: &Place) -> Self {
        Self {
            position: surface.frame.outward(place.at),
            facet: surface.faces[place.face as usize],
            barycentric: place.weights,
            normal: features.normal(place).to_array(),
        }
    }
}

impl Vertex {
    fn shown(&self, surface: &Surface) -> SurfacePoint {
        SurfacePoint {
            position: surface.frame.outward(self.at),
            facet: surface.faces[self.face as usize],
            barycentric: self.weights,
            normal: self.normal.to_array(),
        }
    }
}

/// Makes a new mesh of a surface.
///
/// Where the targets are not reached, the report says so, and the mesh is in the best state that was seen.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`RemeshParams::validate`] has it, for fewer points than the surface's shape and features need, and for two of the points in one place.
///
/// # Example
/// ```
/// use evenly::{RemeshParams, RunContext, Surface, TriangleMesh, remesh, surface_quality};
///
/// // An octahedron, of which nothing is kept but its shape.
/// let vertices = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
/// let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
/// let surface = Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() })?;
/// let params = RemeshParams { n_vertices: 500, ..RemeshParams::default() };
/// let (remeshed, report) = remesh(&surface, &params, &mut RunContext::default())?;
/// assert_eq!(remeshed.mesh.vertices.len(), 500);
/// assert!(surface_quality(&Surface::new(&remeshed.mesh)?).min_angle_deg > 25.0);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn remesh(surface: &Surface, params: &RemeshParams, run: &mut RunContext) -> Result<(Remeshed, Report), Error> {
    params.validate(surface)?;
    let mut report = Report::new(params.method.method().name(), params.n_vertices);
    let sizes = relative_sizes(surface, &params.sizes);
    let long = Features::new(surface, params.features_deg, start::spacing(surface, params.n_vertices));

    // 1. Exactly so many vertices, with the surface's topology.
    run.enter(Phase::Triangulate);
    let inside: Vec<_> = params.points.iter().map(|&p| surface.frame.inward(p)).collect();
    let given = given::places(surface, &inside);
    let has_rows = matches!(params.method.local(), Local::Targets(_));
    let n_points = params.n_vertices;
    let wanted = Wanted { surface, features: &long, sizes: &sizes, n_points, has_rows, given: &given, seed: params.seed };
    let all;
    let (features, started) = match start(wanted)? {
        // Creases that are short for the spacing were left out: with all of them, fewer vertices may do.
        Err(least) if params.features_deg.is_some() => {
            all = Features::new(surface, params.features_deg, 0.0);
            let started = start(Wanted { features: &all, ..wanted })?.map_err(|of_all| least.min(of_all));
            (&all, started)
        }
        started => (&long, started),
    };
    let start = started.map_err(|least| Error::InvalidParameter {
        name: "n_vertices",
        value: format!("{} where no fewer than {least} are possible", params.n_vertices),
        expected: "as many as the mesh's shape and its features need; without features fewer do",
    })?;
    report.triangulations = 1;
    note_given(surface, &given, params.n_vertices, start.n_given, &mut report);
    if let Some(warning) = coarse::warning(surface, &start, params.n_vertices) {
        run.warn(warning, &mut report);
    }

    // 2. They move until all is as it should be.
    let begun = report.clone();
    let had_rows = !start.rows.is_empty();
    let mut live = settle(LiveSurface::new(surface, features, &sizes, start), params, params.seed, run, &mut report)?;

    // 3. On narrow faces rows are in each other's way: then without. Where little is missed another seed may help.
    for again in 0..=MORE_TRIES {
        if !has_rows || run.is_cancelled() || report.outcome != Outcome::IterationLimit {
            break;
        }
        let missed = (live.misfit(), live.n_missed);
        let is_little = n_points <= FEW && missed.0 <= LITTLE_DEG && missed.1 <= MISSED + n_points / PART;
        if !(if again == 0 { had_rows && missed.0 > 0.0 } else { is_little }) {
            continue;
        }
        let seed = params.seed.wrapping_add(again);
        let Ok(start) = start::start(Wanted { features, has_rows: again % 2 == 1, seed, ..wanted })? else { break };
        let mut of_other = begun.clone();
        let other = settle(LiveSurface::new(surface, features, &sizes, start), params, seed, run, &mut of_other)?;
        if (other.misfit(), other.n_missed) < missed {
            (live, report) = (other, of_other);
        }
    }
    Ok((finished(surface, &live), report))
}

/// Says what did not go as given points have it.
fn note_given(surface: &Surface, given: &[(Place, f64)], n_points: usize, n_given: usize, report: &mut Report) {
    if given.is_empty() {
        return;
    }
    if n_given < n_points {
        let n = n_points - n_given;
        report
            .notes
            .push(format!("vertices that did not begin at given points: {n}; creases, boundaries and the surface's shape have their own"));
    }
    let spacing = start::spacing(surface, n_points);
    let n_far = given.iter().filter(|(_, distance)| *distance > spacing).count();
    if n_far > 0 {
        let farthest = surface.frame.length_outward(given.iter().map(|(_, distance)| *distance).fold(0.0, f64::max));
        report.notes.push(format!(
            "given points farther than a spacing from the surface: {n_far}, the farthest {farthest:.3e}; are the units right?"
        ));
    }
}

/// Sizes of which 1 is the mean, such that they ask for as many vertices as 1 everywhere.
fn relative_sizes(surface: &Surface, sizes: &[f64]) -> Vec<f64> {
    if sizes.is_empty() {
        return vec![1.0; surface.n_vertices()];
    }
    // By the largest first, so that squares do not overflow.
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let shares: Vec<f64> = sizes.iter().map(|size| size / largest).collect();
    let mean = (surface.inner_area() / weighted_area(surface, &shares)).sqrt();
    shares.into_iter().map(|share| share / mean).collect()
}

/// The length of edges that is wanted at each vertex, in input units.
fn size(surface: &Surface, live: &LiveSurface) -> Attribute {
    let of = |v: u32| surface.frame.length_outward(live.local_spacing(v));
    Attribute { name: SIZE.into(), values: (0..live.n_points() as u32).map(of).collect() }
}

/// How far a vertex is moved that shares a place with another, on the way to its neighbours' mean.
const PARTED: f64 = 1e-6;

/// Moves vertices apart that are in one place, as where parts touched: who reads the mesh would weld them.
fn part_equal(vertices: &mut [[f64; 3]], live: &LiveSurface) {
    let mut seen = HashSet::with_capacity(vertices.len());
    let equal: Vec<usize> = (0..vertices.len()).filter(|&v| !seen.insert(vertices[v].map(|x| (x + 0.0).to_bits()))).collect();
    if equal.is_empty() {
        return;
    }
    let mesh = live.half_edges();
    let outgoing = mesh.outgoing(vertices.len());
    for v in equal {
        let around: Vec<usize> =
            mesh.around(outgoing[v]).flat_map(|h| [mesh.target(h), mesh.origin[prev(h) as usize]]).map(|w| w as usize).collect();
        let n = around.len() as f64;
        let mean = [0, 1, 2].map(|axis| around.iter().map(|&w| vertices[w][axis]).sum::<f64>() / n);
        vertices[v].iter_mut().zip(mean).for_each(|(x, mean)| *x += PARTED * (mean - *x));
    }
}

/// The mesh as it is given back.
fn finished(surface: &Surface, live: &LiveSurface) -> Remeshed {
    let vertices = live.vertices();
    let places: Vec<SurfacePoint> = vertices.iter().map(|vertex| vertex.shown(surface)).collect();
    let attribute = |attribute: &Attribute| Attribute {
        name: attribute.name.clone(),
        values: vertices.iter().map(|vertex| surface.attribute(attribute, vertex.face as usize, vertex.weights)).collect(),
    };
    let mut vertices: Vec<[f64; 3]> = places.iter().map(|place| place.position).collect();
    part_equal(&mut vertices, live);
    let mesh = TriangleMesh {
        vertices,
        triangles: live.half_edges().triangles().map(|t| t.map(|v| v as usize)).collect(),
        attributes: surface.attributes().iter().filter(|own| own.name != SIZE).map(attribute).chain([size(surface, live)]).collect(),
    };
    Remeshed { mesh, places, forced: live.forced.clone() }
}
