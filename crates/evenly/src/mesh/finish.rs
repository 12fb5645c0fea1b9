//! From settled points to a [`Mesh`](super::Mesh): what is still thin is refined, caps come back, and all is in input units.

use std::collections::HashMap;

use glam::DVec2;

use super::caps::Cap;
use super::outline::{Of, Outline};
use super::settled::Settled;
use super::{EdgeKind, Mesh, MeshEdge};
use crate::space::Domain;
use crate::triangulation::{BORDER, HalfEdges, Planar, Refinement, Refining, Sizing, Triangulation, prev};

/// Angles below this are refined; or below what is wanted, as far as refinement ends in practice.
const REFINED_DEG: f64 = 25.5;
const MOST_REFINED_DEG: f64 = 30.0;

/// The angle below which triangles are refined, where this one is wanted.
pub(super) fn refined_deg(min_angle_deg: Option<f64>) -> f64 {
    (min_angle_deg.unwrap_or(0.0) + 0.1).clamp(REFINED_DEG, MOST_REFINED_DEG)
}

/// The mesh of settled points, refined where angles are below `refined_deg` and segments not shorter than `floor`; and how many points that took.
pub(super) fn finish(settled: Settled, outline: &Outline, caps: &[Cap], domain: &Domain, refined_deg: f64, floor: f64) -> (Mesh, usize) {
    let Settled { triangulation, mut corners, edges, sizes, sizing, hints, .. } = settled;
    let Triangulation { half_edges, positions, .. } = triangulation;
    let n_settled = positions.len();
    let aspect = 0.5 / refined_deg.to_radians().sin();
    let planar = Planar { half_edges, positions, ..Planar::default() };
    let refining = Refining { longest: f64::INFINITY, aspect, floor, halves_all: false, max_vertices: 2 * n_settled + 1000, largest: None };
    let Refinement { half_edges, positions, segments, .. } = Refinement::run(planar, edges.into_iter().collect(), refining);
    corners.resize(positions.len(), BORDER);

    let sizes = sizes_of_all(sizes, hints, &sizing, &half_edges, &positions);

    // Vertices of one corner are one; those as they were given keep their bits.
    let mut mesh = Mesh::default();
    let mut numbers = HashMap::new();
    let mut vertices = Vec::with_capacity(positions.len());
    for ((&corner, &p), &size) in corners.iter().zip(&positions).zip(&sizes) {
        let number = if corner == BORDER { mesh.vertices.len() } else { *numbers.entry(corner).or_insert(mesh.vertices.len()) };
        vertices.push(number);
        if number == mesh.vertices.len() {
            mesh.vertices.push(outline.given.get(corner as usize).copied().unwrap_or_else(|| domain.restore(p)));
            mesh.sizes.push(domain.restore_length(size));
        }
    }
    mesh.triangles = half_edges.triangles().map(|t| t.map(|v| vertices[v as usize])).collect();

    // In the order of half-edges, so that it is always the same.
    let mut bases: HashMap<u32, Vec<[usize; 2]>> = HashMap::new();
    for h in 0..half_edges.origin.len() as u32 {
        let ends = [half_edges.origin[h as usize], half_edges.target(h)];
        let Some(&number) = segments.get(&ends) else { continue };
        let ends = ends.map(|v| vertices[v as usize]);
        match outline.segments[number as usize].of {
            Of::Border(segment) => mesh.edges.push(MeshEdge { ends, kind: EdgeKind::Border { segment: segment as usize } }),
            Of::Line(line) => mesh.edges.push(MeshEdge { ends, kind: EdgeKind::Line { line: line as usize } }),
            Of::Base => bases.entry(number).or_default().push(ends),
        }
    }
    for cap in caps {
        let corner = cap.corners[0];
        let tip = *numbers.entry(corner).or_insert(mesh.vertices.len());
        if tip == mesh.vertices.len() {
            mesh.vertices.push(outline.given[corner as usize]);
            mesh.sizes.push(mesh.sizes[numbers[&cap.corners[1]]]);
        }
        let sides = bases.get(&cap.base).map(Vec::as_slice).unwrap_or_default();
        mesh.triangles.extend(sides.iter().map(|&[from, to]| [tip, to, from]));
        let [p, q] = [cap.corners[1], cap.corners[2]].map(|end| numbers[&end]);
        for (ends, leg) in [([q, tip], cap.legs[0]), ([tip, p], cap.legs[1])] {
            if let Of::Border(segment) = leg {
                mesh.edges.push(MeshEdge { ends, kind: EdgeKind::Border { segment: segment as usize } });
            }
        }
    }
    (mesh, positions.len() - n_settled)
}

/// The wanted spacing at all vertices: of those that refinement has added by a walk from where a neighbour is.
fn sizes_of_all(mut sizes: Vec<f64>, mut hints: Vec<u32>, sizing: &Sizing, half_edges: &HalfEdges, positions: &[DVec2]) -> Vec<f64> {
    let n_settled = sizes.len();
    sizes.resize(positions.len(), f64::NAN);
    hints.resize(positions.len(), BORDER);
    let outgoing = half_edges.outgoing(positions.len());
    for v in n_settled..positions.len() {
        let around = half_edges.around(outgoing[v]).flat_map(|h| [half_edges.target(h), half_edges.origin[prev(h) as usize]]);
        let mut hint = around.map(|other| hints[other as usize]).find(|&hint| hint != BORDER).unwrap_or(0);
        sizes[v] = sizing.at(positions[v], &mut hint);
        hints[v] = hint;
    }
    sizes
}
