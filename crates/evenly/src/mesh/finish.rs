//! From settled points to a [`Mesh`](super::Mesh): what is still thin is refined, caps come back, and all is in input units.

use std::collections::HashMap;

use glam::DVec2;

use super::caps::Cap;
use super::coarsen::{Coarse, Coarsening};
use super::outline::{Of, Outline};
use super::settled::Settled;
use super::{EdgeKind, Mesh, MeshEdge};
use crate::space::Domain;
use crate::triangulation::{BOUNDARY, HalfEdges, Planar, Refinement, Refining, Sizing, Triangulation, prev};

/// Angles below this are refined; or below what is wanted, as far as refinement ends in practice.
pub(super) const REFINED_DEG: f64 = 25.5;
const MOST_REFINED_DEG: f64 = 30.0;
/// Refinement adds no more points than so many times those that are there, and so many.
const MOST_ADDED: usize = 3;
const LEAST_ADDED: usize = 100_000;

/// The angle below which triangles are refined, where this one is wanted.
pub(super) fn refined_deg(min_angle_deg: Option<f64>) -> f64 {
    (min_angle_deg.unwrap_or(0.0) + 0.1).clamp(REFINED_DEG, MOST_REFINED_DEG)
}

/// The mesh of settled points, refined where angles are below `refined_deg`, and how many points that
/// took. Segments are halved down to the first of two lengths; where that takes too many points, as
/// between walls that nearly touch, to the second.
pub(super) fn finish(
    settled: Settled,
    outline: &Outline,
    caps: &[Cap],
    domain: &Domain,
    refined_deg: f64,
    floors: [f64; 2],
) -> (Mesh, usize) {
    let Settled { triangulation, mut corners, edges, sizes, sizing, hints, .. } = settled;
    let Triangulation { half_edges, positions, .. } = triangulation;
    let n_settled = positions.len();
    let aspect = 0.5 / libm::sin(refined_deg.to_radians());
    let planar = Planar { half_edges, positions, ..Planar::default() };
    let refined = |floor: f64, max_vertices: usize| {
        let refining = Refining { longest: f64::INFINITY, aspect, floor, halves_all: false, is_sparing: true, max_vertices, largest: None };
        Refinement::run(planar.clone(), edges.iter().copied().collect(), refining)
    };
    let most = MOST_ADDED * n_settled + LEAST_ADDED;
    let mut refinement = refined(floors[0], most);
    if refinement.positions.len() >= most {
        refinement = refined(floors[1], 2 * most);
    }
    let Refinement { half_edges, positions, segments, .. } = refinement;
    corners.resize(positions.len(), BOUNDARY);
    let sizes = sizes_of_all(sizes, hints, &sizing, &half_edges, &positions);
    let refined = Coarse { half_edges, source: (0..positions.len() as u32).collect(), positions, segments };
    let coarse = if refined.positions.len() == n_settled {
        refined
    } else {
        let mut coarsening = Coarsening::new(refined, outline.rails(), refined_deg);
        coarsening.run(n_settled, |v| corners[v as usize] != BOUNDARY, |v| sizes[v as usize]);
        coarsening.finish()
    };
    let Coarse { half_edges, positions, segments, source } = coarse;
    let corners: Vec<u32> = source.iter().map(|&v| corners[v as usize]).collect();
    let sizes: Vec<f64> = source.iter().map(|&v| sizes[v as usize]).collect();

    // Vertices of one corner are one; those as they were given keep their bits.
    let mut mesh = Mesh::default();
    let mut numbers = HashMap::new();
    let mut vertices = Vec::with_capacity(positions.len());
    for ((&corner, &p), &size) in corners.iter().zip(&positions).zip(&sizes) {
        let number = if corner == BOUNDARY { mesh.vertices.len() } else { *numbers.entry(corner).or_insert(mesh.vertices.len()) };
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
            Of::Boundary(segment) => mesh.edges.push(MeshEdge { ends, kind: EdgeKind::Boundary { segment: segment as usize } }),
            Of::Line(line) => mesh.edges.push(MeshEdge { ends, kind: EdgeKind::Line { line: line as usize } }),
            Of::Base => bases.entry(number).or_default().push(ends),
        }
    }
    let n_triangles = mesh.triangles.len();
    for cap in caps {
        let [tip, p, q] = cap.corners;
        let size = mesh.sizes[numbers[&p]];
        let mut number = |v: u32| {
            *numbers.entry(v).or_insert_with(|| {
                let place = outline.given.get(v as usize).copied().unwrap_or_else(|| domain.restore(outline.points[v as usize]));
                mesh.vertices.push(place);
                mesh.sizes.push(size);
                mesh.vertices.len() - 1
            })
        };
        // From the corner on, rung by rung: the ends on the leg from it and on that to it.
        let tip = number(tip);
        let rungs: Vec<[usize; 2]> = cap.rungs.iter().map(|&rung| rung.map(&mut number)).collect();
        let base = [p, q].map(&mut number);
        let mut last: Option<[usize; 2]> = None;
        for &[on, to] in &rungs {
            match last {
                None => mesh.triangles.push([tip, on, to]),
                Some([from, back]) => mesh.triangles.extend([[from, on, to], [from, to, back]]),
            }
            last = Some([on, to]);
        }
        let sides = bases.get(&cap.base).map(Vec::as_slice).unwrap_or_default();
        let apex = last.map_or(tip, |[from, _]| from);
        mesh.triangles.extend(sides.iter().map(|&[from, to]| [apex, to, from]));
        mesh.triangles.extend(last.map(|[from, back]| [from, base[1], back]));
        for (k, leg) in [(1, cap.legs[0]), (0, cap.legs[1])] {
            let Of::Boundary(segment) = leg else { continue };
            let kind = EdgeKind::Boundary { segment: segment as usize };
            let along: Vec<usize> = [tip].into_iter().chain(rungs.iter().chain([&base]).map(|ends| ends[k])).collect();
            mesh.edges.extend(along.windows(2).map(|w| MeshEdge { ends: if k == 0 { [w[0], w[1]] } else { [w[1], w[0]] }, kind }));
        }
    }
    mesh.n_in_corners = mesh.triangles.len() - n_triangles;
    (mesh, positions.len().saturating_sub(n_settled))
}

/// The wanted spacing at all vertices: of those that refinement has added by a walk from where a neighbour is.
fn sizes_of_all(mut sizes: Vec<f64>, mut hints: Vec<u32>, sizing: &Sizing, half_edges: &HalfEdges, positions: &[DVec2]) -> Vec<f64> {
    let n_settled = sizes.len();
    sizes.resize(positions.len(), f64::NAN);
    hints.resize(positions.len(), BOUNDARY);
    let outgoing = half_edges.outgoing(positions.len());
    for v in n_settled..positions.len() {
        let around = half_edges.around(outgoing[v]).flat_map(|h| [half_edges.target(h), half_edges.origin[prev(h) as usize]]);
        let mut hint = around.map(|other| hints[other as usize]).find(|&hint| hint != BOUNDARY).unwrap_or(0);
        sizes[v] = sizing.at(positions[v], &mut hint);
        hints[v] = hint;
    }
    sizes
}
