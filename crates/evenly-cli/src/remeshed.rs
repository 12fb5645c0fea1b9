//! [`remeshed`]: a surface's new mesh as it is wished for, whoever wishes it.

use std::collections::HashSet;
use std::path::Path;

use anyhow::{Context as _, bail};
use evenly::{
    Attribute, CertificateBreach, LocalMethod, Method, MissedLengths, OBTUSE_DEG, Outcome, RemeshParams, Remeshed, Report, RunContext,
    Surface, SurfaceDistance, SurfacePoint, SurfaceQuality, SurfaceSizing, TriangleMesh, certificate, expected_vertices, missed_lengths,
    remesh, self_intersections, surface_distance, surface_quality, surface_sizes,
};
use evenly_io::{read_numbers, read_triangles_or_points};
use serde_json::Value;

use crate::measured::told;
use crate::memory;
use crate::method::{MethodArgs, OnMeshes, by_flag};
use crate::parse::read_words;
pub use crate::remesh_args::RemeshWishes;
use crate::remesh_args::density_path;

/// Parameters, and the flags that hold them.
const FLAGS: [(&str, &str); 7] = [
    ("n_vertices", "n-vertices"),
    ("features_deg", "features"),
    ("error", "density curvature"),
    ("sizes", "density"),
    ("points", "points"),
    ("linear", "density linear"),
    ("attr", "density attr"),
];

/// The distance at which vertices are put on what stands out where sizes vary, in spacings: who varies them wants a mesh that is near.
const SIZED_DEVIATION: f64 = 0.35;

/// What asks for angles.
const TARGETS: [&str; 4] = ["preset", "min_distance", "coverage_radius", "beta"];
/// Without a target no angle is to be smaller, in degrees, and none obtuse.
const LEAST_DEG: f64 = 30.0;

/// A new mesh, and how it came about.
pub struct Made {
    /// The mesh, and where its vertices lie on the one that was given.
    pub remeshed: Remeshed,
    /// How it came about.
    pub report: Report,
    /// What was asked for.
    pub parameters: Value,
    method: LocalMethod,
    /// Whether targets were given.
    has_targets: bool,
}

/// The measures of a new mesh.
pub struct Measured {
    /// What its triangles are worth.
    pub quality: SurfaceQuality,
    /// How far it is from the one that was given.
    pub distance: SurfaceDistance,
    /// Pairs of triangles that cross each other.
    pub self_intersections: usize,
    /// Triangles whose angles are not what the targets imply; none for methods without targets.
    pub breaches: Vec<CertificateBreach>,
    /// Lengths that are not what was asked for, where the run has not converged.
    pub missed: Vec<MissedLengths>,
    /// What had to be mended to measure it.
    pub notes: Vec<String>,
}

/// The surface of a mesh.
///
/// # Errors
/// As [`Surface::new`], with the file's name, and the flag that repairs.
pub fn surface_of(mesh: &TriangleMesh, name: &Path, is_repaired: bool) -> anyhow::Result<Surface> {
    let surface = if is_repaired { Surface::repaired(mesh) } else { Surface::new(mesh) };
    surface.map_err(|error| {
        let text = error.to_string();
        let way_out = if text.contains("repair") { " (--repair)" } else { "" };
        anyhow::anyhow!("{}: {text}{way_out}", name.display())
    })
}

/// The mesh with corners welded that lie within a tolerance, if there is one, and a note on how many these are.
///
/// # Errors
/// A tolerance that is not positive and finite.
pub fn welded(mesh: TriangleMesh, tolerance: Option<f64>, notes: &mut Vec<String>) -> anyhow::Result<TriangleMesh> {
    let Some(tolerance) = tolerance else { return Ok(mesh) };
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        bail!("--weld is {tolerance}; it must be positive and finite");
    }
    let (mesh, n) = mesh.welded(tolerance);
    notes.push(format!("{n} vertices within {tolerance} of another were put to its place"));
    Ok(mesh)
}

/// What was done to a surface, and what else there is to say of it.
pub fn notes_on(surface: &Surface) -> Vec<String> {
    let seams = surface.near_borders().map(|(n, distance)| {
        let weld = 10.0 * distance;
        format!("{n} boundary vertices lie within {distance:.1e} of another one; if they should be one, --weld {weld:.0e} joins them")
    });
    surface.notes().iter().cloned().chain(seams).collect()
}

/// Makes a new mesh, from given points if there are any; of wishes in words see [`wishes`]. Its positions are
/// those that will be written: `round` brings them to the precision of a file.
///
/// # Errors
/// As [`remesh`], with the names of flags; `name` is the mesh's.
pub fn remeshed(
    surface: &Surface,
    name: &Path,
    wishes: &RemeshWishes,
    sizing: Option<&SurfaceSizing>,
    points: Vec<[f64; 3]>,
    round: impl FnOnce(&mut TriangleMesh),
    run: &mut RunContext,
) -> anyhow::Result<Made> {
    let told = |e| told(e, name, &FLAGS);
    let (points, n_equal) = distinct(points);
    let of_points = (!points.is_empty()).then_some(points.len());
    if let Some(n) = of_points.filter(|&n| n < 4 && wishes.n_vertices.is_none()) {
        bail!("--points has {n} in different places; it must have 4 or more");
    }
    let mut n_points = number_of(surface, wishes.n_vertices, ("edge-length", wishes.edge_length))?.or(of_points);
    let mut sizes = Vec::new();
    if let Some(sizing) = sizing {
        sizes = surface_sizes(surface, sizing, n_points).map_err(told)?;
        n_points = n_points.or(Some((expected_vertices(surface, &sizes).round() as usize).max(4)));
    }
    let Some(n_points) = n_points else { bail!("--n-vertices or --edge-length is missing: how many vertices?") };
    memory::require_vertices(n_points)?;
    if wishes.method_args.is_given("tolerance") && !wishes.method.takes("tolerance") {
        bail!("--tolerance ends methods that have one; how far the input may be from the mesh is --max-deviation");
    }
    if wishes.max_deviation.is_some() && !wishes.method.is_optimizer() {
        bail!("--max-deviation needs vertices that move; those of {} stay", wishes.method);
    }
    let method = method_of(wishes.method, &wishes.method_args, wishes.seed)?;
    let default = if sizes.is_empty() { RemeshParams::default().max_deviation } else { Some(SIZED_DEVIATION) };
    let max_deviation = wishes.max_deviation.map_or(default, |wanted| wanted.0);
    let features_deg = wishes.features.0;
    let params =
        RemeshParams { n_vertices: n_points, method: method.clone(), features_deg, max_deviation, sizes, points, seed: wishes.seed };
    let (mut remeshed, mut report) = remesh(surface, &params, run).map_err(told)?;
    round(&mut remeshed.mesh);
    if n_equal > 0 {
        report.notes.push(format!("points in the place of an earlier one, left out: {n_equal}"));
    }
    let has_targets = wishes.method_args.of(wishes.method).names().any(|name| TARGETS.contains(&name));
    Ok(Made { remeshed, report, parameters: serde_json::json!(params), method, has_targets })
}

impl Made {
    /// Whether something that was asked for was not reached: a target that was given, or, without one, what every new mesh is to be.
    pub fn has_missed(&self, breaches: &[CertificateBreach]) -> bool {
        let is_bad = |breach: &CertificateBreach| breach.min_angle_deg < LEAST_DEG || breach.max_angle_deg > OBTUSE_DEG;
        match self.has_targets {
            true => self.report.outcome == Outcome::IterationLimit || !breaches.is_empty(),
            false => breaches.iter().any(is_bad),
        }
    }

    /// Measures the mesh, which was made of a surface.
    ///
    /// # Errors
    /// As [`Surface::repaired`].
    pub fn measured(&self, surface: &Surface) -> anyhow::Result<Measured> {
        // What has no area, or touches itself, is mended for the measures alone.
        let made = Surface::repaired(&self.remeshed.mesh)?;
        let mut breaches = self.method.beta().map_or_else(Vec::new, |beta| certificate(&made, beta));
        breaches.retain(|breach| self.remeshed.forced.binary_search(&breach.triangle).is_err());
        worst_first(&mut breaches);
        let [distance, radius] = self.method.lengths();
        let has_missed = self.report.outcome == Outcome::IterationLimit && distance.or(radius).is_some();
        let missed = if has_missed { missed_lengths(&made, distance, radius) } else { Vec::new() };
        Ok(Measured {
            quality: surface_quality(&made),
            distance: surface_distance(&made, surface),
            self_intersections: self_intersections(&made).len(),
            breaches,
            missed,
            notes: made.notes().iter().map(|note| format!("in the new mesh, as measured: {note}")).collect(),
        })
    }
}

/// Puts the worst triangles first: those with the smallest angles, or the largest.
fn worst_first(breaches: &mut [CertificateBreach]) {
    let worst = |breach: &CertificateBreach| breach.min_angle_deg.min(0.5 * (180.0 - breach.max_angle_deg));
    breaches.sort_by(|a, b| worst(a).total_cmp(&worst(b)).then(a.triangle.cmp(&b.triangle)));
}

/// The mesh with what its vertices know of the surface as attributes.
pub fn with_places(remeshed: &Remeshed) -> TriangleMesh {
    let mut mesh = remeshed.mesh.clone();
    let own = place_attributes(&remeshed.places);
    mesh.attributes.retain(|attribute| own.iter().all(|other| other.name != attribute.name));
    mesh.attributes.extend(own);
    mesh
}

/// What points know of the surface: facet, barycentric coordinates, normal.
pub fn place_attributes(places: &[SurfacePoint]) -> Vec<Attribute> {
    let column = |name: &str, of: &dyn Fn(&SurfacePoint) -> f64| Attribute { name: name.into(), values: places.iter().map(of).collect() };
    vec![
        column("nx", &|place| place.normal[0]),
        column("ny", &|place| place.normal[1]),
        column("nz", &|place| place.normal[2]),
        column("facet", &|place| place.facet as f64),
        column("bary0", &|place| place.barycentric[0]),
        column("bary1", &|place| place.barycentric[1]),
        column("bary2", &|place| place.barycentric[2]),
    ]
}

/// A method on meshes, as it is told.
///
/// # Errors
/// What it does not take, with the names of flags.
pub(crate) fn method_of(method: Method, args: &MethodArgs<OnMeshes>, seed: u64) -> anyhow::Result<LocalMethod> {
    args.refuse_others(&[method])?;
    method.on_meshes(&args.of(method), seed).map_err(by_flag)
}

/// How many points are asked for, by their number or by a length, given with its flag.
pub(crate) fn number_of(surface: &Surface, n: Option<usize>, (flag, length): (&str, Option<f64>)) -> anyhow::Result<Option<usize>> {
    if let Some(length) = length.filter(|&length| !(length > 0.0 && length.is_finite())) {
        bail!("--{flag} is {length}; it must be positive and finite");
    }
    let of_length = |length: f64| (expected_vertices(surface, &vec![length; surface.n_vertices()]).round() as usize).max(4);
    Ok(n.or(length.map(of_length)))
}

/// Points without those that share a place with an earlier one, and how many these are.
fn distinct(mut points: Vec<[f64; 3]>) -> (Vec<[f64; 3]>, usize) {
    let n = points.len();
    let mut seen = HashSet::new();
    points.retain(|p| seen.insert(p.map(|x| (x + 0.0).to_bits())));
    let n_equal = n - points.len();
    (points, n_equal)
}

/// The points that `--points` names, if it does.
///
/// # Errors
/// Files that cannot be read.
pub fn points(wishes: &RemeshWishes) -> anyhow::Result<Vec<[f64; 3]>> {
    let read = wishes.points.as_deref().map(read_triangles_or_points).transpose()?;
    Ok(read.map_or_else(Vec::new, |read| read.mesh.vertices))
}

/// What `--density` says, if anything.
///
/// # Errors
/// Words that mean nothing, and files that cannot be read.
pub fn sizing(density: Option<&str>) -> anyhow::Result<Option<SurfaceSizing>> {
    density.map(sizing_of).transpose()
}

fn sizing_of(words: &str) -> anyhow::Result<SurfaceSizing> {
    if let Some(path) = density_path(Some(words)) {
        return Ok(SurfaceSizing::Given(read_numbers(path).with_context(|| format!("--density {words}"))?));
    }
    let (name, value) = words.split_once(':').map_or((words, None), |(name, value)| (name, Some(value)));
    let number = |text: &str| text.parse::<f64>().map_err(|_| anyhow::anyhow!("--density {words}: {text:?} is no number"));
    Ok(match (name, value) {
        ("curvature", error) => SurfaceSizing::Curvature { error: error.map(number).transpose()? },
        ("lfs", None) => SurfaceSizing::FeatureSize,
        ("linear", Some(value)) => {
            let parts = value.split_once(',').and_then(|(axis, ratio)| Some(("xyz".find(axis).filter(|_| axis.len() == 1)?, ratio)));
            let Some((axis, ratio)) = parts else { bail!("--density {words}: it must be linear:axis,ratio, as linear:z,4") };
            SurfaceSizing::Linear { axis, ratio: number(ratio)? }
        }
        ("attr", Some(name)) => SurfaceSizing::Attribute(name.to_owned()),
        _ => bail!("--density {words}: it must be curvature[:error], lfs, linear:axis,ratio, attr:NAME, or a file"),
    })
}

/// Wishes in the command line's words, as `--n-vertices=1000`.
///
/// # Errors
/// What the command line says of them.
pub fn wishes(words: &[String]) -> anyhow::Result<RemeshWishes> {
    read_words(words)
}
