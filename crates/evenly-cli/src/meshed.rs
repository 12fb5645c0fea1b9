//! [`meshed`]: a mesh as it is wished for, whoever wishes it.

use std::path::Path;

use evenly::{
    Density, Error, Mesh, MeshParams, MeshQuality, MeshRegion, Outcome, Polygon, Report, RunContext, expected_triangles, mesh,
    mesh_quality, triangle_count, triangle_side,
};
use serde_json::Value;

use crate::details;
use crate::measured;
use crate::mesh_args::MeshWishes;
use crate::parse::read_words;
use crate::sizes::Sizes;
use crate::unmet::{Unmet, forced, unmet};

/// Parameters, and the flags that hold them.
const FLAGS: [(&str, &str); 5] = [
    ("simplify", "simplify"),
    ("edge_length", "edge-length"),
    ("growth", "grade"),
    ("max_edge_length", "max-edge-length"),
    ("min_angle_deg", "min-angle"),
];
/// No angle is to be smaller, if nothing else is said, in degrees.
const LEAST_ANGLE_DEG: f64 = 25.0;
/// The spacing for so many triangles is no more than so many times that without details.
const LARGEST: f64 = 3.0;
/// Corners nearer to each other than this part of the spacing are joined.
const WELDED: f64 = 1e-6;
/// A spacing for so many triangles is found in so many steps.
const ESTIMATES: usize = 4;
/// Or until a step changes it by less than this part.
const SETTLED: f64 = 1e-3;

/// What files are called in what is said of them.
#[derive(Clone, Copy)]
pub struct Names<'a> {
    /// The polygon's.
    pub polygon: &'a Path,
    /// That of points that become vertices.
    pub fixed: &'a Path,
    /// That of lines.
    pub lines: &'a Path,
}

impl Names<'_> {
    /// The error with the name of the file, or the flag, that is to blame.
    fn told(&self, error: Error) -> anyhow::Error {
        let name = match error {
            Error::NotInside { what: "fixed point", .. } => self.fixed,
            Error::NotInside { .. } => self.lines,
            _ => self.polygon,
        };
        measured::told(error, name, &FLAGS)
    }
}

/// What a mesh must keep or follow.
pub struct Given {
    /// Points that become vertices.
    pub fixed: Vec<[f64; 2]>,
    /// Lines that become edges.
    pub lines: Vec<Vec<[f64; 2]>>,
    /// Parts that are kept apart.
    pub regions: Vec<MeshRegion>,
    /// Places and the wanted lengths of edges there.
    pub sizes: Option<Vec<[f64; 3]>>,
    /// How many vertices are wanted where, in proportion.
    pub density: Option<Density>,
}

/// A mesh, and how it came about.
pub struct Meshed {
    /// The mesh.
    pub mesh: Mesh,
    /// How it came about.
    pub report: Report,
    /// What was asked for.
    pub parameters: Value,
    /// The smallest angle that the method's targets imply, if they were asked for.
    implied_angle_deg: Option<f64>,
}

/// The measures of a mesh.
pub struct Measured {
    /// What its triangles are worth.
    pub quality: MeshQuality,
    /// Where demands were not met.
    pub unmet: Vec<Unmet>,
    /// What the polygon forces.
    pub notes: Vec<String>,
}

impl Meshed {
    /// Measures the mesh, and looks where it is not as wished for.
    pub fn measured(&self, wishes: &MeshWishes) -> Measured {
        let least = wishes.min_angle.or(self.implied_angle_deg).unwrap_or(LEAST_ANGLE_DEG);
        Measured {
            quality: mesh_quality(&self.mesh),
            unmet: unmet(&self.mesh, least, wishes.no_obtuse),
            notes: forced(&self.mesh, least).into_iter().collect(),
        }
    }
}

/// Makes a mesh; of wishes in words see [`wishes`].
///
/// # Errors
/// As [`mesh`], with the names of files and flags.
pub fn meshed(polygon: &Polygon, names: Names, wishes: &MeshWishes, given: Given, run: &mut RunContext) -> anyhow::Result<Meshed> {
    let method = wishes.mesh_method()?;
    let implied_angle_deg = wishes.implied_angle_deg(method.as_ref());
    let of_triangles = |n: usize| triangle_side(polygon.area(), n as f64);
    let mut spacing = wishes.edge_length.unwrap_or_else(|| of_triangles(wishes.n_triangles.unwrap_or(1)));
    let n_repairs = polygon.repairs().len();
    let corners = |polygon: &Polygon| polygon.rings().iter().map(Vec::len).sum::<usize>();
    let mut notes = Vec::new();
    let mut own = polygon.clone();
    if let Some(tolerance) = wishes.simplify {
        own = own.simplified(tolerance).map_err(|e| names.told(e))?;
        notes.push(format!("simplified: {} corners instead of {}", corners(&own), corners(polygon)));
    }
    if spacing > 0.0 && spacing.is_finite() {
        own = own.welded(WELDED * spacing).map_err(|e| names.told(e))?;
    }
    notes.extend(own.repairs()[n_repairs..].iter().cloned());
    let polygon = &own;
    let growth = wishes.grade.unwrap_or(MeshParams::new(spacing).growth);
    let Given { fixed, lines, regions, sizes, density } = given;
    let sizes = Sizes::new(sizes, density, polygon, growth)?;
    let wanted = |spacing: f64| sizes.as_ref().map(|sizes| move |place: [f64; 2]| sizes.at(place, spacing));
    let told = |e| names.told(e);
    let params_of = |spacing: f64| MeshParams {
        growth,
        max_edge_length: match (wishes.grade, wishes.max_edge_length) {
            (None, _) => sizes.as_ref().map(|sizes| sizes.largest(spacing).max(spacing)),
            (Some(_), Some(largest)) => Some(largest),
            // As far as it grows.
            (Some(_), None) => Some(spacing.max(polygon.area().sqrt())),
        },
        method: method.clone(),
        is_non_obtuse: wishes.no_obtuse,
        min_angle_deg: wishes.min_angle,
        fixed: fixed.clone(),
        lines: lines.clone(),
        regions: regions.clone(),
        seed: wishes.seed,
        ..MeshParams::new(spacing)
    };
    params_of(spacing).validate().map_err(told)?;
    if let Some(n_triangles) = wishes.n_triangles {
        for _ in 0..ESTIMATES {
            let wanted = wanted(spacing);
            let params = MeshParams { wanted: wanted.as_ref().map(|wanted| wanted as _), ..params_of(spacing) };
            let expected = expected_triangles(polygon, &params).map_err(told)?;
            // Where details take most of them, larger triangles elsewhere save little.
            let before = spacing;
            spacing = (spacing * (expected / n_triangles as f64).sqrt()).min(LARGEST * of_triangles(n_triangles));
            if (spacing / before - 1.0).abs() < SETTLED {
                break;
            }
        }
    }
    let wanted = wanted(spacing);
    let params = MeshParams { wanted: wanted.as_ref().map(|wanted| wanted as _), ..params_of(spacing) };
    let (mesh, mut report) = mesh(polygon, &params, run).map_err(told)?;
    report.notes.splice(0..0, notes);
    if wishes.grade.is_none() && params.wanted.is_none() && report.outcome != Outcome::Cancelled {
        let wanted = wishes.n_triangles.map_or_else(|| triangle_count(polygon.area(), spacing), |n| n as f64);
        report.notes.extend(details::told(polygon, &params, mesh.triangles.len() - mesh.n_in_corners, wanted));
    }
    Ok(Meshed { parameters: serde_json::json!(params), mesh, report, implied_angle_deg })
}

/// Wishes in the command line's words, as `--edge-length=0.1`.
///
/// # Errors
/// What the command line says of them.
pub fn wishes(words: &[String]) -> anyhow::Result<MeshWishes> {
    read_words(words)
}
