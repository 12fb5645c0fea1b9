//! Delaunay triangulations of points in the plane, brought into flat half-edges.

use delaunator::EMPTY;
use glam::DVec2;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation as _};

use super::half_edges::{BOUNDARY, HalfEdges};
use crate::error::Error;
use crate::points::Random;
use crate::space::Domain;

/// A point for `spade`, and its index.
pub(super) struct Site {
    position: Point2<f64>,
    pub index: u32,
}

impl HasPosition for Site {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// Points as sites.
pub(super) fn sites(points: impl Iterator<Item = DVec2>) -> Vec<Site> {
    points.zip(0..).map(|(p, index)| Site { position: Point2::new(p.x, p.y), index }).collect()
}

/// The exact Delaunay triangulation of distinct points, by crate `spade`; vertex `i` is point `i`. Points on one line give no triangles.
pub(super) fn delaunay(points: impl Iterator<Item = DVec2>) -> Result<HalfEdges, Error> {
    let sites = sites(points);
    let n_sites = sites.len();
    let mesh = DelaunayTriangulation::<Site>::bulk_load(sites).map_err(|e| Error::Degenerate(e.to_string()))?;
    if mesh.num_vertices() != n_sites {
        let n_lost = n_sites - mesh.num_vertices();
        return Err(Error::Degenerate(format!("{n_lost} points share their place with another")));
    }
    Ok(brought_in(&mesh).0)
}

/// What `spade` has made as flat half-edges, and for each of its directed edges which of them it is.
pub(super) fn brought_in(mesh: &impl spade::Triangulation<Vertex = Site>) -> (HalfEdges, Vec<u32>) {
    let mut slot = vec![BOUNDARY; mesh.num_directed_edges()];
    let mut origin = Vec::with_capacity(3 * mesh.num_inner_faces());
    for face in mesh.inner_faces() {
        for edge in face.adjacent_edges() {
            slot[edge.fix().index()] = origin.len() as u32;
            origin.push(edge.from().data().index);
        }
    }
    let mut twin = vec![BOUNDARY; origin.len()];
    for edge in mesh.directed_edges() {
        let h = slot[edge.fix().index()];
        if h != BOUNDARY {
            twin[h as usize] = slot[edge.rev().fix().index()];
        }
    }
    (HalfEdges { origin, twin }, slot)
}

/// How far points are shaken for `delaunator`, in mean spacings.
const SHAKE: f64 = 1e-6;

/// Points shaken for [`nearly_delaunay`]; on a wall of a bounded domain only along it.
pub(super) fn shaken(domain: &Domain, points: &[DVec2]) -> Vec<DVec2> {
    let mut random = Random::new(0, 4);
    let amount = SHAKE * (domain.area() / points.len() as f64).sqrt();
    let mut shake = |p: DVec2| {
        let x = random.signed();
        let moved = p + amount * DVec2::new(x, random.signed());
        let is_free = p.cmpgt(DVec2::ZERO) & p.cmplt(domain.size);
        if domain.is_periodic { moved } else { DVec2::select(is_free, moved, p) }
    };
    points.iter().map(|&p| shake(p)).collect()
}

/// A triangulation of shaken points that is nearly Delaunay, by crate `delaunator`: faster, but not exact. It may leave out points and
/// choose wrong diagonals; whoever calls it must prove and mend what comes back. It decides by plain f64, and points on one
/// circle can send it round for ever: hence the shaking.
pub(super) fn nearly_delaunay(points: impl Iterator<Item = DVec2>) -> HalfEdges {
    let points: Vec<delaunator::Point> = points.map(|p| delaunator::Point { x: p.x, y: p.y }).collect();
    let delaunator::Triangulation { triangles, halfedges, .. } = delaunator::triangulate(&points);
    // Its triangles run clockwise: ours are those read backwards, half-edge k being the reverse of its half-edge 2 - k.
    let mirrored = |h: usize| if h == EMPTY { BOUNDARY } else { (h - h % 3 + 2 - h % 3) as u32 };
    let origin = triangles.chunks_exact(3).flat_map(|t| [t[0], t[2], t[1]]).map(|v| v as u32).collect();
    let twin = halfedges.chunks_exact(3).flat_map(|t| [t[2], t[1], t[0]]).map(mirrored).collect();
    HalfEdges { origin, twin }
}
