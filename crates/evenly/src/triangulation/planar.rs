//! The constrained Delaunay triangulation of what rings of segments enclose, by crate `spade`. Nothing stands outside, so nothing is seen across a boundary.

use std::collections::HashSet;

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Intersection, LineIntersectionIterator, Triangulation as _};

use super::half_edges::{BOUNDARY, HalfEdges, prev, smallest};
use super::plane::{Site, brought_in, sites};

/// Distinct points, and segments between them, by their indices.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Graph<'a> {
    pub points: &'a [DVec2],
    /// Rings: what an odd number of them enclose is inside. A segment that is there twice is no boundary.
    pub boundary: &'a [[u32; 2]],
    /// Segments inside that must be edges.
    pub lines: &'a [[u32; 2]],
}

/// A triangulation with a boundary.
#[derive(Debug, Clone, Default)]
pub(crate) struct Planar {
    pub half_edges: HalfEdges,
    pub positions: Vec<DVec2>,
    /// The point that each vertex stands for. Where parts of the inside touch in a point, each has a vertex of its own there.
    pub source: Vec<u32>,
    /// The edges inside that must stay, as pairs of vertices, the smaller first.
    pub lines: HashSet<[u32; 2]>,
}

/// Segments that cannot be there: each would cross another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Crossing(pub Vec<[u32; 2]>);

/// Triangulates what the boundary encloses; points outside are left out.
///
/// # Errors
/// [`Crossing`] where segments cross.
pub(crate) fn planar(graph: Graph) -> Result<Planar, Crossing> {
    let all = || graph.boundary.iter().chain(graph.lines);
    let segments = all().map(|segment| segment.map(|v| v as usize)).collect();
    let mut crossing = Vec::new();
    let on_conflict = |[a, b]: [usize; 2]| crossing.push([a as u32, b as u32]);
    let loaded = ConstrainedDelaunayTriangulation::<Site>::try_bulk_load_cdt(sites(graph.points.iter().copied()), segments, on_conflict);
    // The grid has no place that is not finite, so nothing else can be wrong.
    let Ok(cdt) = loaded else { return Ok(Planar::default()) };
    if !crossing.is_empty() {
        return Err(Crossing(crossing));
    }

    // How often the boundary runs along each half-edge, and which are lines.
    let (mut half_edges, slot) = brought_in(&cdt);
    let mut handles = vec![None; graph.points.len()];
    cdt.vertices().for_each(|vertex| handles[vertex.data().index as usize] = Some(vertex.fix()));
    let mut n_boundaries = vec![0u32; half_edges.origin.len()];
    let mut is_line = vec![false; half_edges.origin.len()];
    for (number, &segment) in all().enumerate() {
        let [Some(from), Some(to)] = segment.map(|v| handles[v as usize]) else { return Err(Crossing(vec![segment])) };
        let pieces: Vec<_> = match cdt.get_edge_from_neighbors(from, to) {
            Some(edge) => vec![edge],
            None => LineIntersectionIterator::new_from_handles(&cdt, from, to)
                .filter_map(|met| if let Intersection::EdgeOverlap(edge) = met { Some(edge) } else { None })
                .collect(),
        };
        if pieces.last().is_none_or(|last| last.to().fix() != to) {
            return Err(Crossing(vec![segment]));
        }
        let is_boundary = number < graph.boundary.len();
        for piece in pieces {
            for h in [piece, piece.rev()].map(|edge| slot[edge.fix().index()]).into_iter().filter(|&h| h != BOUNDARY) {
                n_boundaries[h as usize] += u32::from(is_boundary);
                is_line[h as usize] |= !is_boundary;
            }
        }
    }

    // What is inside, cut open along the boundary.
    let is_boundary = |h: u32| n_boundaries[h as usize] % 2 == 1;
    let is_inside = flood(&half_edges, is_boundary);
    let pair = |half_edges: &HalfEdges, h: u32| {
        let (a, b) = (half_edges.origin[h as usize], half_edges.target(h));
        [a.min(b), a.max(b)]
    };
    let all = 0..half_edges.origin.len() as u32;
    let line_points: HashSet<[u32; 2]> = all.clone().filter(|&h| is_line[h as usize]).map(|h| pair(&half_edges, h)).collect();
    all.filter(|&h| is_boundary(h)).for_each(|h| half_edges.twin[h as usize] = BOUNDARY);
    let mut half_edges = half_edges.filtered(|t, corners| is_inside[t].then(|| smallest(corners)));
    let source = separate_fans(&mut half_edges, graph.points.len());
    let of_points = |[a, b]: [u32; 2]| {
        let (a, b) = (source[a as usize], source[b as usize]);
        [a.min(b), a.max(b)]
    };
    let mut lines = HashSet::new();
    if !line_points.is_empty() {
        let inner = (0..half_edges.origin.len() as u32).filter(|&h| !half_edges.is_boundary(h)).map(|h| pair(&half_edges, h));
        lines.extend(inner.filter(|&ends| line_points.contains(&of_points(ends))));
    }
    let positions = source.iter().map(|&point| graph.points[point as usize]).collect();
    Ok(Planar { half_edges, positions, source, lines })
}

/// Renumbers the vertices, so that each has triangles, all in one fan. Returns the point that each stands for.
fn separate_fans(half_edges: &mut HalfEdges, n_points: usize) -> Vec<u32> {
    let is_used = half_edges.outgoing(n_points);
    let mut source: Vec<u32> = (0..n_points as u32).filter(|&v| is_used[v as usize] != BOUNDARY).collect();
    let mut number = vec![BOUNDARY; n_points];
    source.iter().zip(0..).for_each(|(&point, v)| number[point as usize] = v);
    half_edges.origin.iter_mut().for_each(|v| *v = number[*v as usize]);
    let mut has_fan = vec![false; source.len()];
    for start in 0..half_edges.origin.len() as u32 {
        if !half_edges.is_boundary(start) {
            continue;
        }
        let v = half_edges.origin[start as usize];
        if !std::mem::replace(&mut has_fan[v as usize], true) {
            continue;
        }
        // A further fan of the same point.
        let another = source.len() as u32;
        source.push(source[v as usize]);
        has_fan.push(true);
        let mut h = start;
        while h != BOUNDARY {
            half_edges.origin[h as usize] = another;
            h = half_edges.twin[prev(h) as usize];
        }
    }
    source
}

/// Which triangles lie inside: those that are reached from outside across an odd number of boundaries.
fn flood(half_edges: &HalfEdges, is_boundary: impl Fn(u32) -> bool) -> Vec<bool> {
    let mut is_inside: Vec<Option<bool>> = vec![None; half_edges.n_triangles()];
    let hull = (0..half_edges.origin.len() as u32).filter(|&h| half_edges.is_boundary(h));
    let mut stack: Vec<(u32, bool)> = hull.map(|h| (h / 3, is_boundary(h))).collect();
    while let Some((t, is)) = stack.pop() {
        if is_inside[t as usize].is_some() {
            continue;
        }
        is_inside[t as usize] = Some(is);
        let across = (3 * t..3 * t + 3).map(|h| (half_edges.twin[h as usize], is != is_boundary(h)));
        stack.extend(across.filter(|&(twin, _)| twin != BOUNDARY).map(|(twin, is)| (twin / 3, is)));
    }
    is_inside.into_iter().map(|is| is == Some(true)).collect()
}
