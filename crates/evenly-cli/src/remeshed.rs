//! [`remeshed`]: a surface's new mesh as it is wished for, whoever wishes it.

use std::collections::HashSet;
use std::path::Path;

use anyhow::{Context as _, bail};
use evenly::{
    Attribute, CertificateBreach, DistMeshParams, LloydParams, MissedLengths, OptBetaParams, Outcome, PushPullParams, RemeshMethod,
    RemeshParams, Remeshed, Report, RunContext, Surface, SurfaceDistance, SurfacePoint, SurfaceQuality, SurfaceSizing, TriangleMesh,
    WellSpacedParams, certificate, expected_vertices, hexagonal_spacing, missed_lengths, remesh, self_intersections, surface_distance,
    surface_quality, surface_sizes,
};
use evenly_io::{read_numbers, read_triangles_or_points};
use serde_json::Value;

use crate::measured::told;
use crate::memory;
use crate::method_args::set;
use crate::parse::read_words;
use crate::remesh_args::RemeshRule;
pub use crate::remesh_args::RemeshWishes;

/// Parameters, and the flags that hold them.
const FLAGS: [(&str, &str); 11] = [
    ("n_points", "n-points"),
    ("features_deg", "features"),
    ("error", "density curvature"),
    ("sizes", "density"),
    ("points", "points"),
    ("linear", "density linear"),
    ("attr", "density attr"),
    ("min_distance", "min-distance"),
    ("coverage_radius", "coverage-radius"),
    ("capacity_tolerance", "capacity-tolerance"),
    ("max_passes", "iterations"),
];

/// The distance at which vertices are put on what stands out where sizes vary, in spacings: who varies them wants a mesh that is near.
const SIZED_TOLERANCE: f64 = 0.35;

/// Sweeps of opt-beta on a mesh, unless others are asked for.
pub(crate) const OPT_BETA_SWEEPS: usize = 200;

/// A new mesh, and how it came about.
pub struct Made {
    /// The mesh, and where its vertices lie on the one that was given.
    pub remeshed: Remeshed,
    /// How it came about.
    pub report: Report,
    /// What was asked for.
    pub parameters: Value,
    method: RemeshMethod,
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
    if let Some(n) = of_points.filter(|&n| n < 4 && wishes.n_points.is_none()) {
        bail!("--points has {n} in different places; it must have 4 or more");
    }
    let mut n_points = number_of(surface, wishes.n_points, wishes.spacing)?.or(of_points);
    let mut sizes = Vec::new();
    if let Some(sizing) = sizing {
        sizes = surface_sizes(surface, sizing, n_points).map_err(told)?;
        n_points = n_points.or(Some((expected_vertices(surface, &sizes).round() as usize).max(4)));
    }
    let Some(n_points) = n_points else { bail!("--n-points or --spacing is missing: how many vertices?") };
    memory::require_vertices(n_points)?;
    let spacing = hexagonal_spacing(surface.area(), n_points as f64);
    refuse_others_flags(wishes)?;
    let method = method(wishes);
    if let Some(length) = wishes.tolerance.and_then(|target| target.0).filter(|&length| !(length > 0.0 && length.is_finite())) {
        bail!("--tolerance is {length}; it must be positive and finite, or off");
    }
    let default = if sizes.is_empty() { RemeshParams::default().tolerance } else { Some(SIZED_TOLERANCE) };
    let tolerance = wishes.tolerance.map_or(default, |target| target.0.map(|length| length / spacing));
    let params = RemeshParams { n_points, method, features_deg: wishes.features.0, tolerance, sizes, points, seed: wishes.seed };
    let (mut remeshed, mut report) = remesh(surface, &params, run).map_err(told)?;
    round(&mut remeshed.mesh);
    if n_equal > 0 {
        report.notes.push(format!("points in the place of an earlier one, left out: {n_equal}"));
    }
    Ok(Made { remeshed, report, parameters: serde_json::json!(params), method })
}

impl Made {
    /// Measures the mesh, which was made of a surface.
    ///
    /// # Errors
    /// As [`Surface::repaired`].
    pub fn measured(&self, surface: &Surface) -> anyhow::Result<Measured> {
        // What has no area, or touches itself, is mended for the measures alone.
        let made = Surface::repaired(&self.remeshed.mesh)?;
        let mut breaches = targets(&self.method).map_or_else(Vec::new, |beta| certificate(&made, beta));
        worst_first(&mut breaches);
        let missed = match self.method {
            RemeshMethod::PushPull(params) if self.report.outcome == Outcome::IterationLimit => {
                missed_lengths(&made, params.min_distance, params.coverage_radius)
            }
            _ => Vec::new(),
        };
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

/// The ratio of both radii that a method aims at.
fn targets(method: &RemeshMethod) -> Option<f64> {
    match method {
        RemeshMethod::PushPull(params) => Some(params.coverage_radius? / params.min_distance?),
        RemeshMethod::WellSpaced(params) => Some(params.beta),
        _ => None,
    }
}

/// That what belongs to one method is not given for another.
fn refuse_others_flags(wishes: &RemeshWishes) -> anyhow::Result<()> {
    let RemeshWishes { method, preset, min_distance, coverage_radius, capacity_tolerance, beta, iterations, tolerance, .. } = wishes;
    let has_beta = matches!(method, RemeshRule::WellSpaced | RemeshRule::OptBeta);
    let flags = [
        ("preset", preset.is_some(), "push-pull", *method == RemeshRule::PushPull),
        ("min-distance", min_distance.is_some(), "push-pull", *method == RemeshRule::PushPull),
        ("coverage-radius", coverage_radius.is_some(), "push-pull", *method == RemeshRule::PushPull),
        ("capacity-tolerance", capacity_tolerance.is_some(), "push-pull", *method == RemeshRule::PushPull),
        ("beta", beta.is_some(), "well-spaced and opt-beta", has_beta),
        ("iterations", iterations.is_some(), "all methods but eliminate", *method != RemeshRule::Eliminate),
        ("tolerance", tolerance.is_some(), "all methods but eliminate", *method != RemeshRule::Eliminate),
    ];
    match flags.iter().find(|(_, is_given, _, is_taken)| *is_given && !is_taken) {
        Some((name, _, takers, _)) => bail!("--{name} is for --method {takers}"),
        None => Ok(()),
    }
}

fn method(wishes: &RemeshWishes) -> RemeshMethod {
    let RemeshWishes { seed, iterations, beta, .. } = *wishes;
    match wishes.method {
        RemeshRule::PushPull => {
            let default = match RemeshMethod::default() {
                RemeshMethod::PushPull(params) => params,
                _ => PushPullParams::default(),
            };
            let mut params = wishes.preset.map_or(default, |preset| PushPullParams::preset(preset.into()));
            set(&mut params.min_distance, wishes.min_distance.map(|target| target.0));
            set(&mut params.coverage_radius, wishes.coverage_radius.map(|target| target.0));
            set(&mut params.capacity_tolerance, wishes.capacity_tolerance.map(|target| target.0));
            RemeshMethod::PushPull(PushPullParams { max_passes: iterations, seed, ..params })
        }
        RemeshRule::WellSpaced => {
            let mut params = WellSpacedParams { max_passes: iterations, seed, ..WellSpacedParams::default() };
            set(&mut params.beta, beta);
            RemeshMethod::WellSpaced(params)
        }
        RemeshRule::OptBeta => {
            let iterations = iterations.unwrap_or(OPT_BETA_SWEEPS);
            RemeshMethod::OptBeta(OptBetaParams { beta: Some(beta.unwrap_or(0.75)), iterations, ..OptBetaParams::default() })
        }
        RemeshRule::Eliminate => RemeshMethod::Eliminate,
        RemeshRule::Lloyd => {
            let mut params = LloydParams { seed, ..LloydParams::default() };
            set(&mut params.iterations, iterations);
            RemeshMethod::Lloyd(params)
        }
        RemeshRule::DistMesh => {
            let mut params = DistMeshParams { seed, ..DistMeshParams::default() };
            set(&mut params.iterations, iterations);
            RemeshMethod::DistMesh(params)
        }
    }
}

/// How many vertices are asked for, by their number or by a spacing.
pub(crate) fn number_of(surface: &Surface, n_points: Option<usize>, spacing: Option<f64>) -> anyhow::Result<Option<usize>> {
    if let Some(spacing) = spacing.filter(|&spacing| !(spacing > 0.0 && spacing.is_finite())) {
        bail!("--spacing is {spacing}; it must be positive and finite");
    }
    let of_spacing = |spacing: f64| (expected_vertices(surface, &vec![spacing; surface.n_vertices()]).round() as usize).max(4);
    Ok(n_points.or(spacing.map(of_spacing)))
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
pub fn sizing(wishes: &RemeshWishes) -> anyhow::Result<Option<SurfaceSizing>> {
    wishes.density.as_deref().map(|words| sizing_of(words, wishes)).transpose()
}

fn sizing_of(words: &str, wishes: &RemeshWishes) -> anyhow::Result<SurfaceSizing> {
    if let Some(path) = wishes.density_path() {
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

/// Wishes in the command line's words, as `--n-points=1000`.
///
/// # Errors
/// What the command line says of them.
pub fn wishes(words: &[String]) -> anyhow::Result<RemeshWishes> {
    read_words(words)
}
