//! [`LiveSurface`]: a mesh on a surface whose vertices move along it, and which is Delaunay where it is looked at.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use glam::DVec3;

use super::cells::Territory;
use crate::surface::{Features, Surface};
use crate::triangulation::{BOUNDARY, HalfEdges, Outside, SharedMesh, Spoke, next};

/// The numbers of a vertex' place: position, the surface's normal there, the wanted spacing there relative to the mean, the triangle that holds it, and its weights there.
pub(super) const NUMBERS: usize = 11;

/// A vertex, as it is shared.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub at: DVec3,
    pub normal: DVec3,
    /// The wanted spacing, relative to the mean.
    pub size: f64,
    pub face: u32,
    pub weights: [f64; 3],
}

impl Vertex {
    fn of([x, y, z, nx, ny, nz, size, face, a, b, c]: [f64; NUMBERS]) -> Self {
        Self { at: DVec3::new(x, y, z), normal: DVec3::new(nx, ny, nz), size, face: face as u32, weights: [a, b, c] }
    }

    pub(super) fn numbers(&self) -> [f64; NUMBERS] {
        let Self { at, normal, size, face, weights: [a, b, c] } = *self;
        [at.x, at.y, at.z, normal.x, normal.y, normal.z, size, f64::from(face), a, b, c]
    }
}

/// What a live mesh begins with.
pub(super) struct Start {
    pub half_edges: HalfEdges,
    pub vertices: Vec<Vertex>,
    /// Which vertices stay where they are: those on creases, boundaries and tips.
    pub fixed: Vec<bool>,
    /// The edges along creases and boundaries, each by its ends in order, sorted.
    pub bonds: Vec<[u32; 2]>,
    /// How many stand where points were given.
    pub n_given: usize,
    /// Those beside creases that stay until most others have found their places.
    pub rows: Vec<u32>,
}

/// A mesh on a surface that the sweep moves.
pub(super) struct LiveSurface<'a> {
    surface: &'a Surface,
    features: &'a Features,
    /// Wanted spacings at the surface's vertices, relative to the mean.
    sizes: &'a [f64],
    pub(super) mesh: SharedMesh<NUMBERS>,
    pub(super) is_uniform: bool,
    pub(super) fixed: Vec<bool>,
    pub(super) n_fixed: usize,
    /// Those of them that have been put where the surface stands out.
    pub(super) anchors: Vec<u32>,
    /// How many that stayed were let go.
    pub(super) n_released: usize,
    pub(super) bonds: Vec<[u32; 2]>,
    /// Beside creases, as long as they stay.
    rows: Vec<u32>,
    /// Triangles that the input's corners force to miss the targets, once the run has ended.
    pub(super) forced: Vec<usize>,
    /// How many others miss them then.
    pub(super) n_missed: usize,
    /// Which vertices are on creases and boundaries.
    is_bound: Vec<bool>,
    /// How often a vertex' moves were blocked.
    blocked: Vec<AtomicU32>,
    /// For each colour, the cell in whose territory each vertex lies.
    pub(super) owners: Vec<Vec<u32>>,
    /// The edge of equilateral triangles, as many, that cover as much.
    pub(super) spacing: f64,
}

impl<'a> LiveSurface<'a> {
    pub fn new(surface: &'a Surface, features: &'a Features, sizes: &'a [f64], start: Start) -> Self {
        let Start { half_edges, vertices, fixed, bonds, rows, .. } = start;
        let mut is_bound = vec![false; vertices.len()];
        bonds.iter().flatten().for_each(|&v| is_bound[v as usize] = true);
        let mut live = Self {
            forced: Vec::new(),
            n_missed: 0,
            is_bound,
            surface,
            features,
            sizes,
            is_uniform: sizes.iter().all(|&size| size == 1.0),
            mesh: SharedMesh::new(&half_edges, vertices.iter().map(Vertex::numbers)),
            blocked: vertices.iter().map(|_| AtomicU32::new(0)).collect(),
            n_fixed: fixed.iter().filter(|&&is_fixed| is_fixed).count(),
            owners: Vec::new(),
            anchors: Vec::new(),
            n_released: 0,
            fixed,
            bonds,
            rows: Vec::new(),
            spacing: 1.0,
        };
        rows.iter().for_each(|&v| live.fix(v));
        live.rows = rows;
        live.renew_spacing();
        live
    }

    pub fn vertex(&self, v: u32) -> Vertex {
        Vertex::of(self.mesh.place(v))
    }

    #[inline]
    pub fn at(&self, v: u32) -> DVec3 {
        self.mesh.part::<3>(v, 0).into()
    }

    /// The surface's normal where a vertex is.
    #[inline]
    pub(super) fn normal(&self, v: u32) -> DVec3 {
        self.mesh.part::<3>(v, 3).into()
    }

    /// The wanted spacing where a vertex is, relative to the mean.
    #[inline]
    pub(super) fn size(&self, v: u32) -> f64 {
        let [size] = self.mesh.part(v, 6);
        size
    }

    #[inline]
    pub fn is_fixed(&self, v: u32) -> bool {
        self.fixed[v as usize]
    }

    /// Whether a vertex is on a crease or a boundary.
    #[inline]
    pub(super) fn is_bound(&self, v: u32) -> bool {
        self.is_bound[v as usize]
    }

    /// Lets a vertex stay where it is.
    pub(super) fn fix(&mut self, v: u32) {
        self.n_fixed += usize::from(!self.is_fixed(v));
        self.fixed[v as usize] = true;
    }

    /// Lets a vertex move again.
    pub(super) fn loosen(&mut self, v: u32) {
        self.n_fixed -= usize::from(self.is_fixed(v));
        self.fixed[v as usize] = false;
        self.anchors.retain(|&anchor| anchor != v);
    }

    /// Lets the rows beside creases move.
    pub(super) fn loosen_rows(&mut self) {
        std::mem::take(&mut self.rows).into_iter().for_each(|v| self.loosen(v));
    }

    /// Lets a vertex go for good.
    pub(super) fn release(&mut self, v: u32) {
        self.n_released += usize::from(self.is_fixed(v));
        self.loosen(v);
    }

    pub(super) fn surface_points(&self) -> &[DVec3] {
        &self.surface.points
    }

    pub fn n_blocked(&self, v: u32) -> u32 {
        self.blocked[v as usize].load(Relaxed)
    }

    pub(super) fn count_blocked(&self, v: u32) {
        self.blocked[v as usize].store(self.n_blocked(v) + 1, Relaxed);
    }

    pub(super) fn is_bond(&self, a: u32, b: u32) -> bool {
        self.fixed[a as usize] && self.fixed[b as usize] && self.bonds.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }

    /// Where a vertex that is at a place may go: the nearest place of the surface to another.
    pub(super) fn land(&self, from: &Vertex, to: DVec3) -> Vertex {
        let place = self.surface.project(self.features, from.face, to);
        let sizes = self.surface.half_edges.triangle(place.face as usize).map(|v| self.sizes[v as usize]);
        let size = if self.is_uniform { 1.0 } else { place.mean(sizes) };
        Vertex { at: place.at, normal: self.features.normal(&place), size, face: place.face, weights: place.weights }
    }

    /// Goes once around `v`, counter-clockwise, for the ways to its neighbours. On a boundary the last spoke has no half-edge.
    pub(super) fn walk(&self, v: u32, territory: Territory, ring: &mut Vec<Spoke<DVec3>>) -> Result<(), Outside> {
        ring.clear();
        let at = self.at(v);
        let first = self.mesh.outgoing(v);
        let (mut vertex, mut half_edge) = (self.mesh.origin(next(first)), first);
        loop {
            if !self.holds(territory, vertex) {
                return Err(Outside);
            }
            ring.push(Spoke { vertex, half_edge, way: self.at(vertex) - at, ..Spoke::default() });
            if half_edge == BOUNDARY {
                return Ok(());
            }
            (vertex, half_edge) = self.mesh.turn(half_edge);
            if half_edge == first {
                return Ok(());
            }
        }
    }

    /// As [`walk`](Self::walk), where one thread works alone.
    pub(super) fn walk_alone(&self, v: u32, ring: &mut Vec<Spoke<DVec3>>) {
        // Nothing lies outside.
        let _ = self.walk(v, Territory::EVERYTHING, ring);
    }

    /// Shows the neighbours of `v` in the order of a walk.
    pub(super) fn each_neighbour(&self, v: u32, mut show: impl FnMut(u32)) {
        let first = self.mesh.outgoing(v);
        let (mut vertex, mut half_edge) = (self.mesh.origin(next(first)), first);
        loop {
            show(vertex);
            if half_edge == BOUNDARY {
                return;
            }
            (vertex, half_edge) = self.mesh.turn(half_edge);
            if half_edge == first {
                return;
            }
        }
    }

    pub(super) fn neighbours(&self, v: u32) -> Vec<u32> {
        let mut neighbours = Vec::new();
        self.each_neighbour(v, |other| neighbours.push(other));
        neighbours
    }

    pub(super) fn soil(&self, v: u32) {
        self.mesh.set_dirty(v, true);
    }

    /// The mesh as plain triangles.
    pub fn half_edges(&self) -> HalfEdges {
        self.mesh.half_edges()
    }

    pub fn vertices(&self) -> Vec<Vertex> {
        (0..self.mesh.n_vertices() as u32).map(|v| self.vertex(v)).collect()
    }
}
