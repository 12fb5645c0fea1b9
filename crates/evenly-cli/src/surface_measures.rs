//! What `analyze` finds of a mesh in space, and of points on one.

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use evenly::{
    CertificateBreach, RadialSpectrum, Surface, SurfaceDistance, SurfaceMeasures, SurfaceQuality, certificate, measure_on_surface,
    self_intersections, surface_distance, surface_quality, surface_spectrum,
};
use evenly_io::{Draw, Subject, Target, TrianglesRead, read_triangles, read_triangles_or_points, write_figure, write_triangles_figure};
use serde::Serialize;
use serde_json::Value;

use crate::measuring_args::Analyze;
use crate::talk::say;
use crate::{files, measured, record, session};

/// The ratio by which angles are certified, if none is given: that of push-pull's targets {0.90, 0.63}.
const BETA: f64 = 0.63 / 0.90;
/// So many triangles are named that cross others.
const NAMED: usize = 20;

/// All that is found of a mesh.
#[derive(Serialize)]
struct Found {
    #[serde(flatten)]
    quality: SurfaceQuality,
    /// Whether each edge has two triangles that agree, and each vertex one fan.
    is_manifold: bool,
    self_intersections: usize,
    /// Some of the pairs of triangles that cross each other.
    crossing_triangles: Vec<[usize; 2]>,
    #[serde(flatten)]
    distance: Option<SurfaceDistance>,
    /// The ratio by which angles are certified, and between which it has them.
    certified_beta: f64,
    certified_angles_deg: [f64; 2],
    /// The triangles whose angles are not between these.
    n_breaches: usize,
    breaches: Vec<CertificateBreach>,
    #[serde(flatten)]
    spectrum: Option<RadialSpectrum>,
    notes: Vec<String>,
}

/// What is found of points on a mesh.
#[derive(Serialize)]
struct FoundPoints {
    #[serde(flatten)]
    measures: SurfaceMeasures,
    #[serde(flatten)]
    spectrum: Option<RadialSpectrum>,
    notes: Vec<String>,
}

/// Measures one mesh, or points on one.
pub fn analyze(args: &Analyze) -> anyhow::Result<u8> {
    let [path] = &args.inputs[..] else { bail!("meshes and points in space are measured one at a time") };
    if args.density.is_given() {
        bail!("--density is for points in the plane");
    }
    if args.local && !args.spectrum && args.plot.is_none() {
        bail!("--local is for --spectrum and --plot");
    }
    let plot = args.plot.as_ref().map(|path| Target::figure(path, args.measured.force)).transpose()?;
    files::require_one_stdin([Some(path), args.reference.as_ref()].into_iter().flatten())?;
    let pool = session::pool(args.measured.threads, false)?;
    let read = read_triangles_or_points(path)?;
    let mut notes = Vec::new();
    let mut reference_of = |path: &PathBuf| {
        let read = read_triangles(path)?;
        let reference = Surface::repaired(&read.mesh).with_context(|| path.display().to_string())?;
        notes.extend(read.notes.iter().chain(reference.notes()).map(|note| format!("{}: {note}", path.display())));
        anyhow::Ok(reference)
    };
    let reference = args.reference.as_ref().map(&mut reference_of).transpose()?;
    pool.install(|| match (read.mesh.triangles.is_empty(), &reference) {
        (true, None) => bail!("{}: these are points alone; --reference names the mesh on which they lie", path.display()),
        (true, Some(surface)) => analyze_points(args, &read.mesh.vertices, surface, plot.as_ref(), notes),
        (false, _) => analyze_mesh(args, read, reference.as_ref(), plot.as_ref(), notes),
    })
}

/// The spectrum of points, if it is asked for or to be drawn.
fn spectrum(args: &Analyze, points: &[[f64; 3]], surface: &Surface, is_drawn: bool) -> anyhow::Result<Option<RadialSpectrum>> {
    let name = || args.inputs[0].display().to_string();
    let is_wanted = args.spectrum || is_drawn;
    is_wanted.then(|| surface_spectrum(surface, points, args.local).with_context(name)).transpose()
}

fn draw(spectrum: &RadialSpectrum, plot: &Target) -> anyhow::Result<()> {
    let subject = Subject { sets: &[], name: "", is_local: true, most_points: None, radial: Some(spectrum), power: None };
    Ok(write_figure(&subject, &[Draw::RadialPower, Draw::PairCorrelation], &record::recipe(None), plot)?)
}

fn analyze_points(
    args: &Analyze,
    points: &[[f64; 3]],
    surface: &Surface,
    plot: Option<&Target>,
    mut notes: Vec<String>,
) -> anyhow::Result<u8> {
    if args.certify.is_some() {
        bail!("--certify is for a mesh with triangles");
    }
    let measures = measure_on_surface(surface, points).with_context(|| args.inputs[0].display().to_string())?;
    if measures.off_surface > measures.spacing {
        notes.push(format!("the farthest point is {:.3e} from the mesh, more than a spacing; are the units right?", measures.off_surface));
    }
    let found = FoundPoints { measures, spectrum: spectrum(args, points, surface, plot.is_some())?, notes };
    if let (Some(plot), Some(spectrum)) = (plot, &found.spectrum) {
        draw(spectrum, plot)?;
    }
    for note in &found.notes {
        say(format_args!("note: {note}"));
    }
    let json = serde_json::json!(found);
    measured::print(&json, args.measured.json, || measured::table(&without_lists(&json)))
}

/// The fields that are no lists, but places and ranges.
fn without_lists(json: &Value) -> Value {
    let mut fields = measured::fields(json.clone());
    let is_short = |list: &Vec<Value>| (1..=3).contains(&list.len()) && list.iter().all(Value::is_number);
    fields.retain(|_, value| value.as_array().is_none_or(is_short));
    Value::Object(fields)
}

fn analyze_mesh(
    args: &Analyze,
    read: TrianglesRead,
    reference: Option<&Surface>,
    plot: Option<&Target>,
    of_reference: Vec<String>,
) -> anyhow::Result<u8> {
    let path = &args.inputs[0];
    if args.local && !args.spectrum {
        bail!("--local is for --spectrum; of a mesh --plot alone shows its triangles");
    }
    let beta = args.certify.unwrap_or(BETA);
    if !(beta >= 0.5 && beta.is_finite()) {
        bail!("--certify is {beta}; it must be 0.5 or more, and finite");
    }
    let TrianglesRead { mesh, mut notes } = read;
    let manifold = Surface::new(&mesh);
    // What is no manifold is told, and measured as far as it can be.
    let is_manifold = manifold.is_ok();
    let surface = match manifold {
        Ok(surface) => surface,
        Err(error) => {
            let Ok(surface) = Surface::repaired(&mesh) else { bail!("{}: {error}", path.display()) };
            notes.push(format!("{}: {error}; measured as repaired", path.display()));
            surface
        }
    };
    notes.extend(surface.notes().iter().cloned());
    notes.extend(of_reference);
    let crossing = self_intersections(&surface);
    let breaches = certificate(&surface, beta);
    let least = (0.5 / beta).min(1.0).asin().to_degrees();
    let found = Found {
        quality: surface_quality(&surface),
        is_manifold,
        self_intersections: crossing.len(),
        crossing_triangles: crossing.into_iter().take(NAMED).collect(),
        distance: reference.map(|reference| surface_distance(&surface, reference)),
        certified_beta: beta,
        certified_angles_deg: [least, 180.0 - 2.0 * least],
        n_breaches: breaches.len(),
        breaches,
        spectrum: spectrum(args, &surface.to_mesh().vertices, reference.unwrap_or(&surface), false)?,
        notes,
    };
    match (plot, &found.spectrum) {
        (Some(plot), Some(spectrum)) => draw(spectrum, plot)?,
        (Some(plot), None) => write_triangles_figure(&[("", &mesh)], &record::recipe(None), plot)?,
        (None, _) => {}
    }
    for note in &found.notes {
        say(format_args!("note: {note}"));
    }
    let json = serde_json::json!(found);
    measured::print(&json, args.measured.json, || {
        let mut text = measured::table(&without_lists(&json));
        for CertificateBreach { triangle, at: [x, y, z], min_angle_deg, max_angle_deg } in found.breaches.iter().take(NAMED) {
            text += &format!("not certified: triangle {triangle} at ({x}, {y}, {z}), {min_angle_deg:.2} to {max_angle_deg:.2} degrees\n");
        }
        if found.breaches.len() > NAMED {
            text += &format!("not certified: {} more, which --json has\n", found.breaches.len() - NAMED);
        }
        for [a, b] in &found.crossing_triangles {
            text += &format!("crossing: triangles {a} and {b}\n");
        }
        text
    })
}
