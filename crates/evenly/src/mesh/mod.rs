//! [`mesh`]: triangles in a polygon that conform to its boundary, as good as points in blue noise give, and no more regular than that.
//!
//! Ebeida, Awad, Ge, Mahmoud, Mitchell, Knupp and Wei, "Improving Spatial Coverage while Preserving the Blue Noise of Point Sets", Computer-Aided Design 46, 2014, doi
//! 10.1016/j.cad.2013.08.015, section 7.0.1: points on the boundary move along it, corners stay, and beta bounds the angles.
//!
//! What differs, and why: points are moved by Push-Pull's rule, to one distance and one radius, which reaches a lower beta than Opt-beta's; [`MeshParams::method`] can be that one too, and others. At the boundary a
//! star is seen once more as in a mirror, so rules know of none. The spacing is shorter where the boundary asks for it, and where points cannot come to rest some are added or removed.
//!
//! Cost: O(n log n); 15 to 30 visits a point where the spacing is the same everywhere, a hundred and more where it varies much. It does not promise any angle, though refinement at the end leaves none
//! below 25 degrees but at sharper corners, and where the domain is thinner than a five-hundredth of the spacing.

mod aim;
mod arrangement;
mod background;
mod boundary;
mod caps;
mod cells;
mod coarsen;
mod finish;
mod mover;
mod outline;
mod patches;
mod polish;
mod quality;
mod regions;
mod repair;
mod scatter;
mod settle;
mod settled;
mod state;

use glam::DVec2;
use serde::Serialize;

use self::background::{Background, Grading, background, limit_growth};
use self::caps::{Cap, cut_off};
pub use self::cells::mesh_cells;
use self::mover::Mover;
use self::outline::Outline;
pub use self::quality::{MeshQuality, mesh_quality};
pub use self::regions::MeshRegion;
use self::scatter::{least_mass, scatter, total_mass};
use self::settle::{Place, settle};
use self::state::State;
use crate::error::Error;
use crate::geometry::triangle::Shape;
use crate::methods::LocalMethod;
use crate::parameter::Settings;
use crate::points::{MAX_POINTS, Random};
use crate::polygon::Polygon;
use crate::run::{Outcome, Phase, Report, RunContext};
use crate::space::{Domain, SegmentTree, Space};

/// The smallest spacing that points follow the domain's details to, in wanted spacings.
const FLOOR: f64 = 1.0 / 512.0;
/// And the shortest sides that refinement makes at the end, in the same.
const FINEST: f64 = 1e-6;
/// The shortest lengths, in distances between neighbouring f64.
const RESOLVED: f64 = 1e3;
/// Where triangles stay obtuse that shall not be, the spacing is made to grow more slowly: by so much a length, one after the other.
const SLOW_GROWTHS: [f64; 2] = [0.15, 0.09];
/// The base of a cap is at most so many spacings long; caps are made smaller so often.
const LONGEST_BASE: f64 = 1.3;
const MOST_TRIES: usize = 8;

/// What [`mesh`] can be told.
#[derive(Clone, Serialize)]
pub struct MeshParams<'a> {
    /// The wanted length of edges, in input units; positive. They are shorter where the boundary is detailed or the domain narrow.
    pub edge_length: f64,
    /// The longest edges wanted inside, in input units; `None` for `edge_length`, which edges on the boundary never exceed by much. More lets triangles grow away from it.
    pub max_edge_length: Option<f64>,
    /// How fast edges may grow away from where they are short, in length per unit of distance; in (0, 1]. Less makes more triangles, and better ones; where no triangle shall be obtuse, it may be made less.
    pub growth: f64,
    /// How points find their places; `None` for Push-Pull to targets that suit the demands. Those on the boundary and on lines move along their segment, and corners stay, whatever the
    /// method. Where triangles are bad then, points are added or removed and the method goes on there; the last bad ones are polished.
    pub method: Option<LocalMethod>,
    /// No triangle shall be obtuse. That takes longer, and is not always reached.
    pub is_non_obtuse: bool,
    /// No angle shall be smaller, in degrees, but at the polygon's sharper corners; in [0, 35]. `None` for 25. More than 30 is not always reached.
    pub min_angle_deg: Option<f64>,
    /// Points that stay and become vertices, in input units.
    pub fixed: Vec<[f64; 2]>,
    /// Lines that become edges, each from point to point, in input units; they are split where they cross, and clipped at the boundary.
    pub lines: Vec<Vec<[f64; 2]>>,
    /// Parts of the domain that are kept apart.
    pub regions: Vec<MeshRegion>,
    /// A length of edges for each place, both in input units, where it is to be less than `edge_length` or `max_edge_length`.
    #[serde(skip)]
    pub wanted: Option<&'a (dyn Fn([f64; 2]) -> f64 + Sync)>,
    /// The points depend on it.
    pub seed: u64,
}

impl MeshParams<'_> {
    /// Edges of one length everywhere, but where the boundary asks for less.
    pub fn new(edge_length: f64) -> Self {
        Self {
            edge_length,
            max_edge_length: None,
            growth: 0.25,
            method: None,
            is_non_obtuse: false,
            min_angle_deg: None,
            fixed: Vec::new(),
            lines: Vec::new(),
            regions: Vec::new(),
            wanted: None,
            seed: 0,
        }
    }

    /// What Push-Pull aims at where no lengths are asked for: more than triangles must have.
    pub fn usual_targets(is_non_obtuse: bool) -> Settings {
        Mover::new(None, is_non_obtuse, 0).targets()
    }

    /// How the spacing is to vary, in normalised units.
    fn grading<'a>(&self, domain: &Domain, resolution: f64, wanted: Option<&'a (dyn Fn(DVec2) -> f64 + Sync)>) -> Grading<'a> {
        let unit = domain.restore_length(1.0);
        // Not finer than the numbers are, inside or in input units.
        let least = outline::LEAST.max(RESOLVED * resolution / unit);
        Grading {
            on_boundary: self.edge_length / unit,
            largest: self.max_edge_length.unwrap_or(self.edge_length) / unit,
            growth: self.growth,
            floor: (FLOOR * self.edge_length / unit).max(least),
            finest: (FINEST * self.edge_length / unit).max(outline::LEAST),
            least,
            max_vertices: MAX_POINTS / 4,
            wanted,
            follows_all: self.is_non_obtuse || self.min_angle_deg.is_some_and(|least| least > finish::REFINED_DEG),
        }
    }

    /// Checks the parameters, as [`mesh`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a value outside its range.
    pub fn validate(&self) -> Result<(), Error> {
        let invalid = |name, value: f64, expected| Err(Error::InvalidParameter { name, value: value.to_string(), expected });
        if !(self.edge_length > 0.0 && self.edge_length.is_finite()) {
            return invalid("edge_length", self.edge_length, "positive and finite");
        }
        if !(self.growth > 0.0 && self.growth <= 1.0) {
            return invalid("growth", self.growth, "more than 0, and 1 at most");
        }
        self.method.as_ref().map_or(Ok(()), LocalMethod::check)?;
        if let Some(least) = self.min_angle_deg.filter(|least| !(0.0..=35.0).contains(least)) {
            return invalid("min_angle_deg", least, "0 or more, and 35 at most");
        }
        match self.max_edge_length {
            Some(largest) if largest < self.edge_length || !largest.is_finite() => {
                invalid("max_edge_length", largest, "the edge length at least, and finite")
            }
            _ => Ok(()),
        }
    }
}

/// Triangles that cover a polygon.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// In input units; the polygon's corners have the bits that they were given with.
    pub vertices: Vec<[f64; 2]>,
    /// Vertices of each triangle, counter-clockwise.
    pub triangles: Vec<[usize; 3]>,
    /// The edges on the boundary and on lines.
    pub edges: Vec<MeshEdge>,
    /// The length of edges that is wanted at each vertex, in input units: what was asked for, and less where the boundary is detailed. Empty where nobody knows.
    pub sizes: Vec<f64>,
    /// The region in which each triangle lies, as [`MeshParams::regions`] has them; `u32::MAX` for none. Empty where there are none.
    pub regions: Vec<u32>,
    /// Their names.
    pub region_names: Vec<String>,
    /// So many triangles, the last ones, lie in corners of the polygon that are sharper than 60 degrees:
    /// there its boundary forces the angles.
    pub n_in_corners: usize,
}

impl Mesh {
    /// The angles of triangle `t` in degrees, each at its corner.
    pub fn angles_deg(&self, t: usize) -> [f64; 3] {
        self.shape(t).angles_deg
    }

    fn shape(&self, t: usize) -> Shape {
        Shape::of_plane(self.triangles[t].map(|v| self.vertices[v].into()))
    }
}

/// An edge that a mesh had to have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshEdge {
    /// Its vertices; on the boundary with the inside on their left.
    pub ends: [usize; 2],
    /// What it is part of.
    pub kind: EdgeKind,
}

/// What an edge of a mesh is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// The polygon's boundary.
    Boundary {
        /// Its segment, counted through all of [`Polygon::rings`].
        segment: usize,
    },
    /// A line inside.
    Line {
        /// Which.
        line: usize,
    },
    /// What lies between two regions, or around one inside of another.
    Between,
}

/// Meshes a polygon.
///
/// The report's number of points is that of the mesh. Its outcome says whether all triangles are as good as they were to be: no angle below 35.5 or above 109 degrees, or none above 90, but at the
/// polygon's own sharp corners; [`mesh_quality`] tells more.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`MeshParams::validate`] has it; [`Error::NotInside`] where a fixed point, or all of all lines, lies outside; [`Error::TooManyPoints`] where the
/// spacing asks for more than [`MAX_POINTS`]; [`Error::Degenerate`] where the boundary is finer than f64 can tell.
///
/// # Example
/// ```
/// use evenly::{MeshParams, Polygon, RunContext, mesh, mesh_quality};
///
/// let l_shape = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]];
/// let (mesh, _) = mesh(&Polygon::from_rings(vec![l_shape])?, &MeshParams::new(0.05), &mut RunContext::default())?;
/// assert!(mesh_quality(&mesh).min_angle_deg > 41.0);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn mesh(polygon: &Polygon, params: &MeshParams, run: &mut RunContext) -> Result<(Mesh, Report), Error> {
    params.validate()?;
    let n_obtuse = |mesh: &Mesh| mesh_quality(mesh).obtuse_triangles;
    let mut best = meshed(polygon, params, run)?;
    // Along a finely divided boundary that bends inwards each corner takes three triangles, and where the spacing grows fast there are too few.
    for growth in SLOW_GROWTHS.into_iter().filter(|&growth| params.is_non_obtuse && growth < params.growth) {
        if best.1.outcome != Outcome::IterationLimit || n_obtuse(&best.0) == 0 {
            break;
        }
        let Ok((slower, mut report)) = meshed(polygon, &MeshParams { growth, ..params.clone() }, run) else { break };
        if report.outcome == Outcome::Cancelled {
            break;
        }
        if n_obtuse(&slower) < n_obtuse(&best.0) {
            report.notes.push(format!("so that fewer triangles are obtuse, the spacing grows by {growth} a length, not {}", params.growth));
            best = (slower, report);
        }
    }
    Ok(best)
}

/// Makes a mesh whose spacing grows as it says.
fn meshed(polygon: &Polygon, params: &MeshParams, run: &mut RunContext) -> Result<(Mesh, Report), Error> {
    run.enter(Phase::Triangulate);
    let domain = polygon.domain();
    let spacing = params.edge_length / domain.restore_length(1.0);

    // 1. What the mesh must keep; sharp corners are set apart, and the spacing is found for every place.
    let Graded { outline, caps, mut background, floor } = graded(polygon, params)?;

    // 2. Points on the boundary and on lines, and a spacing that fits them.
    let parts = boundary::divide(&outline, &mut background);
    limit_growth(&mut background.sizing, params.growth);

    // 3. Points inside: what the spacing asks for.
    let n_on_segments = outline.points.len() + parts.iter().map(|parts| parts.points.len()).sum::<usize>();
    require_few(total_mass(&background.sizing) + 0.5 * n_on_segments as f64)?;
    let inside = scatter(&background.sizing, &SegmentTree::new(&outline.rails()), &mut Random::new(params.seed, 11));
    let state = State::new(&outline, background, &parts, inside);

    // 4. They find their places.
    run.enter(Phase::Optimize);
    let mut report = Report::new("mesh", 0);
    report.notes.clone_from(&outline.notes);
    let place = Place { domain: &domain, outline: &outline, spacing };
    let mover = Mover::new(params.method.as_ref(), params.is_non_obtuse, params.seed);
    let settled = settle(state, place, &mover, run, &mut report)?;

    // 5. What is left is refined, and the corners come back.
    let least_deg = if report.outcome == Outcome::Cancelled { 0.0 } else { finish::refined_deg(params.min_angle_deg) };
    let (mut mesh, n_added) = finish::finish(settled, &outline, &caps, &domain, least_deg, [FINEST * spacing, 0.5 * floor]);
    regions::mark(&mut mesh, &params.regions, params.lines.len());
    report.n_points = mesh.vertices.len();
    if n_added > 0 {
        report.notes.push(format!("{n_added} points were added at the end, where triangles were thin"));
    }
    Ok((mesh, report))
}

/// # Errors
/// [`Error::TooManyPoints`] where there would be more than [`MAX_POINTS`].
fn require_few(n_points: f64) -> Result<(), Error> {
    if n_points > MAX_POINTS as f64 { Err(Error::TooManyPoints(n_points.min(1e18) as usize, MAX_POINTS)) } else { Ok(()) }
}

/// About how many triangles a mesh will have: what the spacing asks for.
///
/// # Errors
/// As [`mesh`].
pub fn expected_triangles(polygon: &Polygon, params: &MeshParams) -> Result<f64, Error> {
    params.validate()?;
    let Graded { caps, background, .. } = graded(polygon, params)?;
    Ok(2.0 * total_mass(&background.sizing) + caps.len() as f64)
}

/// An outline without its sharp corners, these as caps, the spacing for every place, and the shortest that details are followed to.
struct Graded {
    outline: Outline,
    caps: Vec<Cap>,
    background: Background,
    floor: f64,
}

/// Finds the outline and the spacing that the parameters ask for.
fn graded(polygon: &Polygon, params: &MeshParams) -> Result<Graded, Error> {
    let domain = polygon.domain();
    let unit = domain.restore_length(1.0);
    let wanted = params.wanted.map(|wanted| {
        let domain = domain.clone();
        move |p: DVec2| wanted(domain.restore(p)) / unit
    });
    let wanted = wanted.as_ref().map(|wanted| wanted as &(dyn Fn(DVec2) -> f64 + Sync));
    let grading = params.grading(&domain, Space::from(*polygon.frame()).resolution(), wanted);
    require_few(polygon.area() / (unit * grading.largest).powi(2))?;
    let whole = Outline::new(polygon, &params.fixed, &params.lines, &params.regions)?;
    let (outline, caps, background) = capped(&whole, &domain, &grading)?;
    Ok(Graded { outline, caps, background, floor: grading.floor })
}

/// The outline without its sharp corners, these as caps, and the spacing. Where it asks for more points at the base of a cap, the cap was too large.
fn capped(whole: &Outline, domain: &Domain, grading: &Grading) -> Result<(Outline, Vec<Cap>, Background), Error> {
    let planar = whole.triangulated(domain)?;
    let mut radii = vec![grading.on_boundary; whole.points.len()];
    let mut n_tries = 0;
    loop {
        let (outline, caps) = cut_off(whole, &planar, &radii);
        let own = if caps.is_empty() { planar.clone() } else { outline.triangulated(domain)? };
        let background = background(&outline, own, grading);
        let lengths = boundary::lengths(&outline, &background);
        n_tries += 1;
        let is_large = |cap: &&Cap| lengths[cap.base as usize] > LONGEST_BASE;
        let n_large = caps.iter().filter(is_large).count();
        if n_large == 0 || n_tries == MOST_TRIES {
            require_few(least_mass(&background.sizing))?;
            return Ok((outline, caps, background));
        }
        for cap in caps.iter().filter(is_large) {
            let [tip, end] = [cap.corners[0], cap.corners[1]].map(|v| outline.points[v as usize]);
            radii[cap.corners[0] as usize] = tip.distance(end) / lengths[cap.base as usize];
        }
    }
}
