//! What `analyze` finds of a mesh in space.

use std::path::Path;

use anyhow::bail;
use evenly::{
    CertificateBreach, Surface, SurfaceDistance, SurfaceQuality, certificate, self_intersections, surface_distance, surface_quality,
};
use evenly_io::{Target, TrianglesRead, read_triangles, write_triangles_figure};
use serde::Serialize;

use crate::measuring_args::Analyze;
use crate::remeshed::surface_of;
use crate::talk::say;
use crate::{input, measured, record, session};

/// The ratio by which angles are certified, if none is given: that of push-pull's targets {0.90, 0.63}.
const BETA: f64 = 0.63 / 0.90;
/// So many triangles are named that cross others.
const NAMED: usize = 20;

/// Whether a file is a mesh by its name.
pub fn is_mesh(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    ["ply", "obj", "off", "stl", "gltf", "glb"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

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
    notes: Vec<String>,
}

/// Measures one mesh.
pub fn analyze(args: &Analyze) -> anyhow::Result<u8> {
    let [path] = &args.inputs[..] else { bail!("meshes are measured one at a time") };
    if args.local || args.spectrum || args.density.is_given() {
        bail!("--spectrum, --local and --density are for points");
    }
    let beta = args.certify.unwrap_or(BETA);
    if !(beta >= 0.5 && beta.is_finite()) {
        bail!("--certify is {beta}; it must be 0.5 or more, and finite");
    }
    let plot = args.plot.as_ref().map(|path| Target::figure(path, args.measured.force)).transpose()?;
    input::require_one_stdin([Some(path), args.reference.as_ref()].into_iter().flatten())?;
    let pool = session::pool(args.measured.threads)?;
    let TrianglesRead { mesh, mut notes } = read_triangles(path)?;
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
    let reference = args.reference.as_ref().map(|path| surface_of(&read_triangles(path)?.mesh, path, true)).transpose()?;
    let found = pool.install(|| {
        let crossing = self_intersections(&surface);
        let breaches = certificate(&surface, beta);
        let least = (0.5 / beta).min(1.0).asin().to_degrees();
        Found {
            quality: surface_quality(&surface),
            is_manifold,
            self_intersections: crossing.len(),
            crossing_triangles: crossing.into_iter().take(NAMED).collect(),
            distance: reference.as_ref().map(|reference| surface_distance(&surface, reference)),
            certified_beta: beta,
            certified_angles_deg: [least, 180.0 - 2.0 * least],
            n_breaches: breaches.len(),
            breaches,
            notes,
        }
    });
    if let Some(plot) = &plot {
        write_triangles_figure(&[("", &mesh)], &record::recipe(None), plot)?;
    }
    for note in &found.notes {
        say(format_args!("note: {note}"));
    }
    let json = serde_json::json!(found);
    measured::print(&json, args.measured.json, || {
        let mut fields = measured::fields(json.clone());
        ["notes", "breaches", "crossing_triangles"].iter().for_each(|name| drop(fields.remove(*name)));
        let mut text = measured::table(&serde_json::Value::Object(fields));
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
