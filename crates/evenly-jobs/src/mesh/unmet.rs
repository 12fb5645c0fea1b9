//! Where a mesh is not as was demanded, and why.

use std::collections::HashSet;

use evenly::{EdgeKind, Mesh, OBTUSE_DEG};
use serde::Serialize;

/// A triangle that does not meet a demand.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UnmetAngle {
    /// What was demanded.
    pub demand: &'static str,
    /// The angle that is too small or too large.
    pub angle_deg: f64,
    /// The vertex at which it is.
    pub at: [f64; 2],
    /// What it comes from.
    pub why: &'static str,
}

impl std::fmt::Display for UnmetAngle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { demand, angle_deg, at, why } = self;
        write!(f, "{demand}: an angle of {angle_deg:.2} degrees at ({}, {}), {why}", at[0], at[1])
    }
}

/// What sharp corners of the polygon force: how many triangles there have an angle below `least`.
pub fn forced(mesh: &Mesh, least: f64) -> Option<String> {
    let smallest = |t: usize| mesh.angles_deg(t).into_iter().fold(f64::INFINITY, f64::min);
    let thin: Vec<usize> = in_corners(mesh).filter(|&t| smallest(t) < least).collect();
    let &worst = thin.iter().min_by(|&&a, &&b| smallest(a).total_cmp(&smallest(b)))?;
    let [x, y] = mesh.vertices[mesh.triangles[worst][0]];
    let (n, deg) = (thin.len(), smallest(worst));
    let s = if n == 1 { "" } else { "s" };
    Some(format!(
        "forced: {n} triangle{s} in sharp corners of the polygon with angles below {least} degrees, the sharpest {deg:.4} at ({x}, {y})"
    ))
}

/// The triangles in sharp corners of the polygon.
fn in_corners(mesh: &Mesh) -> std::ops::Range<usize> {
    mesh.triangles.len() - mesh.n_in_corners..mesh.triangles.len()
}

/// The triangles that have a smaller angle than `least`, in degrees, or an obtuse one, the worst first.
/// Those in corners of the polygon that are sharper themselves are no fault of the mesh.
pub fn unmet(mesh: &Mesh, least: f64, no_obtuse: bool) -> Vec<UnmetAngle> {
    let boundary: HashSet<[usize; 2]> =
        mesh.edges.iter().filter(|edge| matches!(edge.kind, EdgeKind::Boundary { .. })).map(|edge| edge.ends).collect();
    let is_held = |a: usize, b: usize| boundary.contains(&[a, b]) || boundary.contains(&[b, a]);
    let mut found = Vec::new();
    for (t, corners) in mesh.triangles.iter().enumerate() {
        let angles = mesh.angles_deg(t);
        let [smallest, largest] = [0, 1, 2].into_iter().fold([0, 0], |[smallest, largest], k| {
            [if angles[k] < angles[smallest] { k } else { smallest }, if angles[k] > angles[largest] { k } else { largest }]
        });
        let sides = [0, 1, 2].map(|k| is_held(corners[k], corners[(k + 1) % 3]));
        let is_corner = |k: usize| sides[k] && sides[(k + 2) % 3];
        let n_held = sides.iter().filter(|&&is| is).count();
        let why = if n_held > 0 { "where the boundary is detailed or the domain narrow" } else { "near where the boundary is detailed" };
        let mut miss = |demand, k: usize| found.push(UnmetAngle { demand, angle_deg: angles[k], at: mesh.vertices[corners[k]], why });
        if angles[smallest] < least && !is_corner(smallest) && !in_corners(mesh).contains(&t) {
            miss("min angle", smallest);
        }
        if no_obtuse && angles[largest] > OBTUSE_DEG {
            miss("no obtuse", largest);
        }
    }
    let badness = |unmet: &UnmetAngle| if unmet.demand == "min angle" { unmet.angle_deg } else { 180.0 - unmet.angle_deg };
    found.sort_by(|a, b| badness(a).total_cmp(&badness(b)));
    found
}
