//! Which lengths of a new mesh are not what was asked for, and where the worst of them is.

use std::collections::HashSet;
use std::fmt;

use evenly::{Attribute, CertificateBreach, RemeshMethod, TriangleMesh};
use serde::Serialize;

/// How many lengths miss a target.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Missed {
    /// Which lengths.
    pub what: &'static str,
    /// The least or the most that was asked for, in wanted lengths of edges.
    pub wanted: f64,
    /// How many miss it.
    pub n: usize,
    /// The worst, in the same unit.
    pub worst: f64,
    /// Where that is, in input units.
    pub at: [f64; 3],
}

impl fmt::Display for Missed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { what, wanted, n, worst, at: [x, y, z] } = self;
        write!(f, "{n} {what} {wanted} of the wanted length, the worst with {worst:.3} at ({x}, {y}, {z})")
    }
}

/// The attribute that tells the wanted length at each vertex.
const SIZE: &str = "edge_length";
/// Lengths that are off by this part hold.
const ROUNDING: f64 = 1e-6;

/// What a mesh misses of the targets by which it was made.
pub fn missed(mesh: &TriangleMesh, method: &RemeshMethod) -> Vec<Missed> {
    let (shortest, largest) = match method {
        RemeshMethod::PushPull(params) => (params.min_distance, params.coverage_radius),
        _ => (None, None),
    };
    let Some(Attribute { values: sizes, .. }) = mesh.attributes.iter().find(|attribute| attribute.name == SIZE) else { return Vec::new() };
    let mut seen = HashSet::new();
    let mut edges = Worst::default();
    let mut radii = Worst::default();
    for &corners in &mesh.triangles {
        let p = corners.map(|v| mesh.vertices[v]);
        let sides = [0, 1, 2].map(|k| length(p[k], p[(k + 1) % 3]));
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let share = 2.0 * sides[k] / (sizes[a] + sizes[b]);
            let is_short = |&wanted: &f64| share < wanted * (1.0 - ROUNDING);
            if let Some(wanted) = shortest.filter(|wanted| is_short(wanted) && seen.insert([a.min(b), a.max(b)])) {
                edges.add(share, wanted / share, [0, 1, 2].map(|axis| 0.5 * (p[k][axis] + p[(k + 1) % 3][axis])));
            }
        }
        let [a, b, c] = sides;
        let s = 0.5 * (a + b + c);
        let radius = a * b * c / (4.0 * (s * (s - a) * (s - b) * (s - c)).max(0.0).sqrt());
        let share = 3.0 * radius / corners.iter().map(|&v| sizes[v]).sum::<f64>();
        if let Some(wanted) = largest.filter(|&wanted| share > wanted * (1.0 + ROUNDING)) {
            radii.add(share, share / wanted, [0, 1, 2].map(|axis| p.iter().map(|p| p[axis]).sum::<f64>() / 3.0));
        }
    }
    let told = |what, wanted: Option<f64>, Worst { n, share, at, .. }: Worst| {
        wanted.filter(|_| n > 0).map(|wanted| Missed { what, wanted, n, worst: share, at })
    };
    [told("edges are shorter than", shortest, edges), told("circumradii are larger than", largest, radii)].into_iter().flatten().collect()
}

#[derive(Default)]
struct Worst {
    n: usize,
    share: f64,
    /// By how much it misses.
    excess: f64,
    at: [f64; 3],
}

impl Worst {
    fn add(&mut self, share: f64, excess: f64, at: [f64; 3]) {
        self.n += 1;
        if excess > self.excess {
            (self.share, self.excess, self.at) = (share, excess, at);
        }
    }
}

fn length(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum::<f64>().sqrt()
}

/// Puts the worst triangles first: those with the smallest angles, or the largest.
pub fn worst_first(breaches: &mut [CertificateBreach]) {
    let worst = |breach: &CertificateBreach| breach.min_angle_deg.min(0.5 * (180.0 - breach.max_angle_deg));
    breaches.sort_by(|a, b| worst(a).total_cmp(&worst(b)).then(a.triangle.cmp(&b.triangle)));
}
