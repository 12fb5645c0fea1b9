//! [`MeshRegion`]: parts of the domain that a mesh keeps apart, as parcels and materials are.

use std::collections::{HashMap, HashSet};

use serde::Serialize;

use super::{EdgeKind, Mesh};
use crate::polygon::Polygon;

/// A part of the domain, by name. Its outline becomes edges, and its triangles carry its number.
#[derive(Debug, Clone, Serialize)]
pub struct MeshRegion {
    /// Its name, in files that have names.
    pub name: String,
    /// What it covers; where regions overlap the first of them has the place.
    #[serde(skip)]
    pub polygon: Polygon,
}

/// The region of triangles that lie in none.
const NONE: u32 = u32::MAX;

/// Says for each triangle of a mesh in which region it lies, and keeps of the regions' outlines, which are
/// the lines from number `first` on, what lies between two.
pub(super) fn mark(mesh: &mut Mesh, regions: &[MeshRegion], first: usize) {
    if regions.is_empty() {
        return;
    }
    let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let mut at_side: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
    for (t, corners) in mesh.triangles.iter().enumerate() {
        for k in 0..3 {
            at_side.entry(sorted([corners[k], corners[(k + 1) % 3]])).or_default().push(t);
        }
    }
    let walls: HashSet<[usize; 2]> = mesh.edges.iter().map(|edge| sorted(edge.ends)).collect();
    // From triangle to triangle where no edge stands between them: all lie in the same region.
    mesh.regions = vec![NONE; mesh.triangles.len()];
    let mut is_seen = vec![false; mesh.triangles.len()];
    for start in 0..mesh.triangles.len() {
        if is_seen[start] {
            continue;
        }
        is_seen[start] = true;
        let mut together = vec![start];
        let mut k = 0;
        while k < together.len() {
            let corners = mesh.triangles[together[k]];
            for side in [0, 1, 2].map(|k| sorted([corners[k], corners[(k + 1) % 3]])) {
                for &next in at_side[&side].iter().filter(|_| !walls.contains(&side)) {
                    if !std::mem::replace(&mut is_seen[next], true) {
                        together.push(next);
                    }
                }
            }
            k += 1;
        }
        let twice_area = |t: usize| {
            let [a, b, c] = mesh.triangles[t].map(|v| mesh.vertices[v]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let Some(&largest) = together.iter().max_by(|&&s, &&t| twice_area(s).total_cmp(&twice_area(t))) else { continue };
        let [a, b, c] = mesh.triangles[largest].map(|v| mesh.vertices[v]);
        let middle = [0, 1].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0);
        let region = regions.iter().position(|region| region.polygon.holds(middle)).map_or(NONE, |region| region as u32);
        together.iter().for_each(|&t| mesh.regions[t] = region);
    }
    let Mesh { edges, regions: of, region_names, .. } = mesh;
    edges.retain_mut(|edge| match edge.kind {
        EdgeKind::Line { line } if line >= first => {
            edge.kind = EdgeKind::Between;
            let beside = &at_side[&sorted(edge.ends)];
            beside.windows(2).any(|pair| of[pair[0]] != of[pair[1]])
        }
        _ => true,
    });
    *region_names = regions.iter().map(|region| region.name.clone()).collect();
}
