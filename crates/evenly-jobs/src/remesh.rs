//! [`RemeshRequest`]: a surface's new mesh.

use std::collections::HashSet;

use evenly::{
    CertificateBreach, LocalMethod, Method, MissedLengths, OBTUSE_DEG, Outcome, RemeshParams, Remeshed, Report, Settings, Surface,
    SurfaceDistance, SurfaceQuality, TriangleMesh, certificate, expected_vertices, missed_lengths, remesh, self_intersections,
    surface_distance, surface_quality, surface_sizes, triangle_side,
};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::context::{Context, Event, Stage};
use crate::error::Error;
use crate::memory;
use crate::message::Message;
use crate::method::{Job, check_on_meshes, on_meshes};
use crate::points::Ending;
use crate::resource::{Places, Resource, Resources, Triangles};
use crate::surface::{OrOff, Prepared, Repair, Sizing, number_of, place_attributes};

/// A surface's new mesh. Its size is a number of vertices, an edge length, a density with an error, or given points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RemeshRequest {
    /// The mesh that it is made of.
    pub mesh: Resource<Triangles>,
    /// How many vertices, exactly.
    #[serde(default)]
    pub n_vertices: Option<usize>,
    /// The length of edges, in the mesh's units, instead; with a density their mean.
    #[serde(default)]
    pub edge_length: Option<f64>,
    /// Points at which vertices begin, as many as are wanted or more.
    #[serde(default)]
    pub points: Option<Resource<Places>>,
    /// The same seed makes the same mesh.
    #[serde(default)]
    pub seed: u64,
    /// How vertices find their places.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::MethodName"))]
    pub method: Method,
    /// What the method is told.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
    /// Edges of other lengths here and there.
    #[serde(default)]
    pub density: Option<Resource<Sizing>>,
    /// Creases that turn by more than this, in degrees, are kept; off for boundaries alone.
    #[serde(default = "usual_features")]
    #[cfg_attr(test, schemars(with = "crate::schema::NumberOrOff"))]
    pub features: OrOff,
    /// How far the given mesh may be from the new one, in edge lengths: where it is farther, a vertex is put and kept.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "Option<crate::schema::NumberOrOff>"))]
    pub max_deviation: Option<OrOff>,
    /// Mend what can be without guessing.
    #[serde(default)]
    pub repair: bool,
    /// Make one of corners that lie within this distance of each other, in the mesh's units.
    #[serde(default)]
    pub weld: Option<f64>,
}

fn usual_features() -> OrOff {
    OrOff(RemeshParams::default().features_deg)
}

/// A new mesh, and how it came about.
pub struct RemeshOutcome {
    /// The mesh, and where its vertices lie on the one that was given.
    pub remeshed: Remeshed,
    /// How it came about.
    pub report: Report,
    /// What the user should know.
    pub notes: Vec<Message>,
    /// What was asked of the library.
    pub parameters: Value,
    surface: Surface,
    method: LocalMethod,
    has_targets: bool,
}

/// What a new mesh is worth.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RemeshMeasured {
    /// Of its triangles.
    pub quality: SurfaceQuality,
    /// How far it is from the one that was given.
    pub distance: SurfaceDistance,
    /// Pairs of triangles that cross each other.
    pub self_intersections: usize,
    /// Triangles whose angles are not what the targets imply, the worst first; none for methods without targets.
    pub breaches: Vec<CertificateBreach>,
    /// Lengths that are not what was asked for, where the run has not converged.
    pub missed: Vec<MissedLengths>,
    /// What had to be mended to measure it.
    pub notes: Vec<Message>,
}

/// Parameters of the library that have another name here.
const NAMES: [(&str, &str); 5] = [
    ("features_deg", "features"),
    ("error", "density curvature"),
    ("sizes", "density"),
    ("linear", "density linear"),
    ("attr", "density attr"),
];
/// The distance at which vertices are put on what stands out where sizes vary, in spacings: who varies them wants a mesh that is near.
const SIZED_DEVIATION: f64 = 0.35;
/// What asks for angles.
const TARGETS: [&str; 4] = ["preset", "min_distance", "coverage_radius", "beta"];
/// Without a target no angle is to be smaller, in degrees, and none obtuse.
const LEAST_DEG: f64 = 30.0;

impl RemeshRequest {
    /// The same with the defaults.
    pub fn of(mesh: Resource<Triangles>) -> Self {
        Self {
            mesh,
            n_vertices: None,
            edge_length: None,
            points: None,
            seed: 0,
            method: Method::default(),
            parameters: Settings::default(),
            density: None,
            features: usual_features(),
            max_deviation: None,
            repair: false,
            weld: None,
        }
    }

    /// Checks what can be checked without data.
    ///
    /// # Errors
    /// Sizes and parts that do not go together, and what the method is told wrongly.
    pub fn check(&self) -> Result<(), Error> {
        Job::Remesh.require("method", self.method)?;
        if self.n_vertices.is_some() && self.edge_length.is_some() {
            return Err(Message::from("give either ").name("n_vertices").text(" or ").name("edge_length").into());
        }
        if self.parameters.get("tolerance").is_some() && !self.method.takes("tolerance") {
            let ends = Message::default().name("tolerance").text(" ends methods that have one; how far the input may be from the mesh is ");
            return Err(ends.name("max_deviation").into());
        }
        if self.max_deviation.is_some() && !self.method.is_optimizer() {
            let needs = Message::default().name("max_deviation").text(format!(" needs vertices that move; those of {} stay", self.method));
            return Err(needs.into());
        }
        check_on_meshes(self.method, &self.parameters)
    }

    /// Makes the mesh.
    ///
    /// # Errors
    /// As [`check`](Self::check), for data that cannot be worked with, and as [`remesh`].
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<RemeshOutcome, Error> {
        self.check()?;
        context.enter(Stage::Read);
        let repair = if self.repair { Repair::Always } else { Repair::Never };
        let Prepared { surface, mut notes } = Prepared::new(&self.mesh, self.weld, repair, resources)?;
        notes.iter().for_each(|note| context.tell(Event::Note(note)));
        let named = |error| Error::of(error, self.mesh.called(), &NAMES);
        let sizing = self.density.as_ref().map(|density| density.get(resources)).transpose()?;
        let points = self.points.as_ref().map_or(Ok(Vec::new()), |points| points.get(resources))?;
        let (points, n_equal) = distinct(points);
        let of_points = (!points.is_empty()).then_some(points.len());
        if let Some(n) = of_points.filter(|&n| n < 4 && self.n_vertices.is_none()) {
            return Err(Message::default().name("points").text(format!(" has {n} in different places; it must have 4 or more")).into());
        }
        let mut n_vertices = number_of(&surface, self.n_vertices, "edge_length", self.edge_length)?.or(of_points);
        let mut sizes = Vec::new();
        if let Some(sizing) = sizing {
            sizes = surface_sizes(&surface, &sizing, n_vertices).map_err(named)?;
            n_vertices = n_vertices.or(Some((expected_vertices(&surface, &sizes).round() as usize).max(4)));
        }
        let missing = evenly::Error::Missing { names: &["n_vertices", "edge_length"], question: "how many vertices?" };
        let n_vertices = n_vertices.ok_or(missing)?;
        memory::require_vertices(n_vertices)?;
        // Two triangles a vertex, about.
        let side = triangle_side(surface.area(), 2.0 * n_vertices as f64);
        let method = on_meshes(self.method, &self.parameters, &Settings::default(), sizes.is_empty().then_some(side), self.seed)?;
        let default = if sizes.is_empty() { RemeshParams::default().max_deviation } else { Some(SIZED_DEVIATION) };
        let params = RemeshParams {
            n_vertices,
            method: method.clone(),
            features_deg: self.features.0,
            max_deviation: self.max_deviation.map_or(default, |wanted| wanted.0),
            sizes,
            points,
            seed: self.seed,
        };
        let (remeshed, report) = context.run(|run| remesh(&surface, &params, run)).map_err(named)?;
        notes.extend(report.notes.iter().cloned().map(Message::from));
        if n_equal > 0 {
            notes.push(format!("points in the place of an earlier one, left out: {n_equal}").into());
        }
        let has_targets = self.parameters.names().any(|name| TARGETS.contains(&name));
        Ok(RemeshOutcome { remeshed, report, notes, parameters: serde_json::json!(params), surface, method, has_targets })
    }
}

impl RemeshOutcome {
    /// Measures the mesh.
    ///
    /// # Errors
    /// As [`Surface::repaired`].
    pub fn measured(&self) -> Result<RemeshMeasured, Error> {
        // What has no area, or touches itself, is mended for the measures alone.
        let made = Surface::repaired(&self.remeshed.mesh)?;
        let mut breaches = self.method.beta().map_or_else(Vec::new, |beta| certificate(&made, beta));
        breaches.retain(|breach| self.remeshed.forced.binary_search(&breach.triangle).is_err());
        worst_first(&mut breaches);
        let [distance, radius] = self.method.lengths();
        let has_missed = self.report.outcome == Outcome::IterationLimit && distance.or(radius).is_some();
        let missed = if has_missed { missed_lengths(&made, distance, radius) } else { Vec::new() };
        Ok(RemeshMeasured {
            quality: surface_quality(&made),
            distance: surface_distance(&made, &self.surface),
            self_intersections: self_intersections(&made).len(),
            breaches,
            missed,
            notes: made.notes().iter().map(|note| format!("in the new mesh, as measured: {note}").into()).collect(),
        })
    }

    /// How the job ended: whether targets that were given were reached, or, without one, what every new mesh is to be.
    pub fn ending(&self, measured: Option<&RemeshMeasured>) -> Ending {
        let breaches = measured.map_or(&[][..], |measured| &measured.breaches);
        let is_bad = |breach: &CertificateBreach| breach.min_angle_deg < LEAST_DEG || breach.max_angle_deg > OBTUSE_DEG;
        let has_missed = match self.has_targets {
            true => self.report.outcome == Outcome::IterationLimit || !breaches.is_empty(),
            false => breaches.iter().any(is_bad),
        };
        match has_missed {
            _ if self.report.outcome == Outcome::Cancelled => Ending::Cancelled,
            true => Ending::Missed,
            false => Ending::Done,
        }
    }

    /// The mesh with what its vertices know of the surface as attributes.
    pub fn with_places(&self) -> TriangleMesh {
        let mut mesh = self.remeshed.mesh.clone();
        let own = place_attributes(&self.remeshed.places);
        mesh.attributes.retain(|attribute| own.iter().all(|other| other.name != attribute.name));
        mesh.attributes.extend(own);
        mesh
    }
}

/// Puts the worst triangles first: those with the smallest angles, or the largest.
fn worst_first(breaches: &mut [CertificateBreach]) {
    let worst = |breach: &CertificateBreach| breach.min_angle_deg.min(0.5 * (180.0 - breach.max_angle_deg));
    breaches.sort_by(|a, b| worst(a).total_cmp(&worst(b)).then(a.triangle.cmp(&b.triangle)));
}

/// Points without those that share a place with an earlier one, and how many these are.
fn distinct(mut points: Vec<[f64; 3]>) -> (Vec<[f64; 3]>, usize) {
    let n = points.len();
    let mut seen = HashSet::new();
    points.retain(|p| seen.insert(p.map(|x| (x + 0.0).to_bits())));
    let n_equal = n - points.len();
    (points, n_equal)
}
