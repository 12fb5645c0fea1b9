//! [`LiveSurface`]: a mesh on a surface whose vertices move along it, and which is Delaunay where it is looked at.

use std::collections::HashSet;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use glam::{DVec2, DVec3};

use super::shape::{Guard, is_delaunay};
use crate::error::Error;
use crate::optimize::PushPullParams;
use crate::star::{Senses, Star};
use crate::surface::{Features, Surface};
use crate::sweep::{Buffer, Cells, Ground, Reading};
use crate::triangulation::{BORDER, HalfEdges, Outside, SharedMesh, Spoke, Territory, next, prev};

/// The numbers of a vertex' place: position, the surface's normal there, the wanted spacing there relative to the mean, the triangle that holds it, and its weights there.
const NUMBERS: usize = 11;
/// A flip turns no triangle by more than this: the cosine.
const LEAST_TURN: f64 = 0.1;

/// Lengths that are off by less than this, in spacings, are as wanted.
const ROUNDING: f64 = 1e-9;

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
    /// Which vertices stay where they are: those on creases and borders.
    pub fixed: Vec<bool>,
    /// The edges along creases and borders, each by its ends in order, sorted.
    pub bonds: Vec<[u32; 2]>,
}

/// A mesh on a surface that the sweep moves.
pub(super) struct LiveSurface<'a> {
    surface: &'a Surface,
    features: &'a Features,
    /// Wanted spacings at the surface's vertices, relative to the mean.
    sizes: &'a [f64],
    is_uniform: bool,
    pub(super) mesh: SharedMesh<NUMBERS>,
    fixed: Vec<bool>,
    bonds: Vec<[u32; 2]>,
    /// How often a vertex' moves were blocked.
    blocked: Vec<AtomicU32>,
    /// The edge of equilateral triangles, as many, that cover as much.
    spacing: f64,
}

/// All that is needed to come back.
#[derive(Clone)]
pub(super) struct State {
    half_edges: HalfEdges,
    places: Vec<[f64; NUMBERS]>,
}

/// What a star is read into.
#[derive(Default)]
pub(super) struct SurfaceBuffer {
    pub star: Star,
    senses: Senses,
    spokes: Vec<Spoke<DVec3>>,
    moves: Vec<(u32, DVec3)>,
    pub(super) n_flips: usize,
    /// The spokes of a vertex that moves.
    pub(super) moving: Vec<Spoke<DVec3>>,
}

impl Buffer<DVec3> for SurfaceBuffer {
    fn sensing(senses: Senses) -> Self {
        Self { senses, ..Self::default() }
    }

    fn reading(&mut self) -> Reading<'_, DVec3> {
        let Self { star, spokes, moves, .. } = self;
        Reading { star, spokes, moves }
    }

    fn n_flips(&self) -> usize {
        self.n_flips
    }
}

impl<'a> LiveSurface<'a> {
    pub fn new(surface: &'a Surface, features: &'a Features, sizes: &'a [f64], start: Start) -> Self {
        let Start { half_edges, vertices, fixed, bonds } = start;
        let mut live = Self {
            surface,
            features,
            sizes,
            is_uniform: sizes.iter().all(|&size| size == 1.0),
            mesh: SharedMesh::new(&half_edges, vertices.iter().map(Vertex::numbers)),
            blocked: vertices.iter().map(|_| AtomicU32::new(0)).collect(),
            fixed,
            bonds,
            spacing: 1.0,
        };
        live.renew_spacing();
        live
    }

    /// Takes the spacing from the triangles as they are.
    pub fn renew_spacing(&mut self) {
        let n = self.mesh.n_half_edges() / 3;
        let of_triangle = |t: usize| {
            let corners = [0, 1, 2].map(|k| self.vertex(self.mesh.origin(3 * t as u32 + k)));
            let [a, b, c] = corners.map(|corner| corner.at);
            let scale = corners.iter().map(|corner| 1.0 / corner.size).sum::<f64>() / 3.0;
            0.5 * (b - a).cross(c - a).length() * scale * scale
        };
        let area: f64 = (0..n).map(of_triangle).sum();
        self.spacing = (4.0 * area / (3f64.sqrt() * n as f64)).sqrt();
    }

    /// Whether each edge of each triangle is at least as long as is wanted there, and each circumradius at most as large.
    pub fn meets(&mut self, targets: &PushPullParams) -> bool {
        self.legalize();
        self.half_edges().triangles().all(|corners| self.is_met(corners, targets))
    }

    fn is_met(&self, corners: [u32; 3], targets: &PushPullParams) -> bool {
        let corners = corners.map(|v| self.vertex(v));
        let [a, b, c] = corners.map(|corner| corner.at);
        let scale = corners.iter().map(|corner| 1.0 / corner.size).sum::<f64>() / (3.0 * self.spacing);
        let edges = [a.distance(b), b.distance(c), c.distance(a)];
        let radius = edges.iter().product::<f64>() / (2.0 * (b - a).cross(c - a).length());
        let shortest = edges.into_iter().fold(f64::INFINITY, f64::min);
        targets.min_distance.is_none_or(|wanted| shortest * scale >= wanted - ROUNDING)
            && targets.coverage_radius.is_none_or(|wanted| radius * scale <= wanted + ROUNDING)
    }

    /// Lets go what stays off the creases, and is a corner of a triangle that does not meet the targets. Returns how many.
    pub fn release(&mut self, targets: &PushPullParams) -> usize {
        let missing: Vec<[u32; 3]> = self.half_edges().triangles().filter(|&corners| !self.is_met(corners, targets)).collect();
        let on_creases: HashSet<u32> = self.bonds.iter().flatten().copied().collect();
        let held: HashSet<u32> = missing.into_iter().flatten().filter(|v| self.fixed[*v as usize] && !on_creases.contains(v)).collect();
        held.iter().for_each(|&v| self.fixed[v as usize] = false);
        held.len()
    }

    /// The largest circumradius over the shortest edge, once all edges are Delaunay.
    pub fn beta(&mut self) -> f64 {
        self.legalize();
        let (mut shortest, mut largest) = (f64::INFINITY, 0f64);
        for corners in self.half_edges().triangles() {
            let [a, b, c] = corners.map(|v| self.at(v));
            let edges = [a.distance(b), b.distance(c), c.distance(a)];
            shortest = edges.into_iter().fold(shortest, f64::min);
            largest = largest.max(edges.iter().product::<f64>() / (2.0 * (b - a).cross(c - a).length()));
        }
        largest / shortest
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

    /// Lets a vertex stay where it is.
    pub(super) fn fix(&mut self, v: u32) {
        self.fixed[v as usize] = true;
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

    /// How well a triangle fits the surface.
    pub(super) fn fit(&self, normal: DVec3, corners: [u32; 3]) -> f64 {
        Guard::fit(normal, corners.map(|v| (!self.is_fixed(v)).then(|| self.normal(v))))
    }

    /// Goes once around `v`, counter-clockwise. On a border the last spoke has no half-edge.
    pub(super) fn walk(&self, v: u32, ring: &mut Vec<Spoke<DVec3>>) {
        ring.clear();
        let at = self.at(v);
        let first = self.mesh.outgoing(v);
        let (mut vertex, mut half_edge) = (self.mesh.origin(next(first)), first);
        let mut way = self.at(vertex) - at;
        loop {
            let (after, turned) = self.mesh.turn(half_edge);
            let way_after = self.at(after) - at;
            let (dot, cross) = (way.dot(way_after), way.cross(way_after).length());
            ring.push(Spoke { vertex, half_edge, is_echo: false, way, length: 0.0, squared: way.length_squared(), dot, cross });
            (vertex, half_edge, way) = (after, turned, way_after);
            if half_edge == first {
                return;
            }
            if half_edge == BORDER {
                ring.push(Spoke {
                    vertex,
                    half_edge,
                    is_echo: false,
                    way,
                    length: 0.0,
                    squared: way.length_squared(),
                    dot: 0.0,
                    cross: 0.0,
                });
                return;
            }
        }
    }

    /// Goes around `v`, and flips its spokes until none is to be.
    pub(super) fn restore(&self, v: u32, ring: &mut Vec<Spoke<DVec3>>, n_flips: &mut usize) {
        loop {
            self.walk(v, ring);
            let Some(h) = self.find_illegal(ring) else { return };
            self.flip(h);
            *n_flips += 1;
        }
    }

    /// A spoke that is to be flipped.
    fn find_illegal(&self, ring: &[Spoke<DVec3>]) -> Option<u32> {
        let mut before = &ring[ring.len() - 1];
        for (k, spoke) in ring.iter().enumerate() {
            let after = ring.get(k + 1).unwrap_or(&ring[0]);
            // The sine of the sum of both angles across, up to a factor.
            let sine = (after.squared - spoke.dot) * before.cross + (before.squared - before.dot) * spoke.cross;
            if sine < 0.0 && spoke.half_edge != BORDER && before.half_edge != BORDER && self.should_flip(spoke.half_edge) {
                return Some(spoke.half_edge);
            }
            before = spoke;
        }
        None
    }

    /// Whether the edge of `h` is not Delaunay, and the other diagonal can be.
    fn should_flip(&self, h: u32) -> bool {
        if self.mesh.twin(h) == BORDER {
            return false;
        }
        let [p, q, r, s] = self.mesh.quadrilateral(h);
        let [a, b, c, d] = [p, q, r, s].map(|v| self.at(v));
        !is_delaunay([a, b, c, d]) && self.can_flip([p, q, r, s])
    }

    /// Whether the edge between the first two corners may become that between the last two.
    pub(super) fn can_flip(&self, [p, q, r, s]: [u32; 4]) -> bool {
        if r == s || self.is_bond(p, q) || self.are_neighbours(r, s) {
            return false;
        }
        let [a, b, c, d] = [p, q, r, s].map(|v| self.at(v));
        let normal = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a);
        let (left, right, new) = (normal(a, b, c), normal(b, a, d), [normal(d, b, c), normal(c, a, d)]);
        let old = left + right;
        if !new.iter().all(|n| n.dot(old) > LEAST_TURN * n.length() * old.length()) {
            return false;
        }
        let before = self.fit(left, [p, q, r]).min(self.fit(right, [q, p, s]));
        let after = self.fit(new[0], [s, q, r]).min(self.fit(new[1], [r, p, s]));
        let n_blocked = [p, q, r, s].map(|v| self.n_blocked(v)).into_iter().max();
        Guard::after(n_blocked.unwrap_or(0)).allows(before, after)
    }

    fn are_neighbours(&self, a: u32, b: u32) -> bool {
        let first = self.mesh.outgoing(a);
        let mut h = first;
        loop {
            let (after, turned) = self.mesh.turn(h);
            if self.mesh.origin(next(h)) == b || after == b {
                return true;
            }
            if turned == first || turned == BORDER {
                return false;
            }
            h = turned;
        }
    }

    pub(super) fn flip(&self, h: u32) {
        self.mesh.quadrilateral(h).into_iter().for_each(|v| self.soil(v));
        self.mesh.flip(h);
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

impl Ground for LiveSurface<'_> {
    type Way = DVec3;
    type Buffer = SurfaceBuffer;
    type State = State;

    fn n_points(&self) -> usize {
        self.mesh.n_vertices()
    }

    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn local_spacing(&self, point: u32) -> f64 {
        self.spacing * self.size(point)
    }

    fn has_density(&self) -> bool {
        !self.is_uniform
    }

    fn holds_points(&self) -> bool {
        self.fixed.contains(&true)
    }

    fn sees_beyond(&self) -> bool {
        false
    }

    fn point(&self, v: u32) -> u32 {
        v
    }

    fn is_dirty(&self, point: u32) -> bool {
        self.mesh.is_dirty(point)
    }

    fn clean(&self, point: u32) {
        self.mesh.set_dirty(point, false);
    }

    fn soil_all(&self) {
        (0..self.n_points() as u32).for_each(|v| self.soil(v));
    }

    fn read(&self, v: u32, _: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        let SurfaceBuffer { star, senses, spokes, n_flips, .. } = buffer;
        self.restore(v, spokes, n_flips);
        self.fill(v, senses, star, spokes);
        Ok(())
    }

    fn look_around(&self, v: u32, _: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        self.lay_out(v, buffer);
        Ok(())
    }

    fn unfolded(&self, v: u32, by: DVec2) -> DVec3 {
        let [x, y] = self.tangents(v);
        by.x * x + by.y * y
    }

    fn along(&self, point: u32, by: DVec3) -> DVec3 {
        if self.is_fixed(point) { DVec3::ZERO } else { by }
    }

    fn relocate(&self, point: u32, by: DVec3, _: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        self.go(point, by, buffer);
        Ok(())
    }

    fn legalize(&mut self) -> usize {
        let mut n_flips = 0;
        let mut suspects: Vec<u32> = (0..self.mesh.n_half_edges() as u32).collect();
        while let Some(h) = suspects.pop() {
            if self.should_flip(h) {
                let t = self.mesh.twin(h);
                self.flip(h);
                suspects.extend([h, t, next(h), next(t), prev(h), prev(t)]);
                n_flips += 1;
            }
        }
        n_flips
    }

    fn mend(&mut self) -> Result<bool, Error> {
        Ok(false)
    }

    fn check(&self) -> Result<(), String> {
        self.half_edges().check_manifold(self.n_points())
    }

    fn cells(&mut self) -> Cells {
        Cells::one(self.n_points())
    }

    fn sort_by_rows(&self, points: &mut [u32], height: f64) {
        let at = |v: u32| self.at(v);
        let row = |v: u32| (at(v).y / (height * self.spacing)).floor();
        points.sort_by(|&a, &b| row(a).total_cmp(&row(b)).then(at(a).x.total_cmp(&at(b).x)).then(a.cmp(&b)));
    }

    fn state(&self) -> State {
        State { half_edges: self.half_edges(), places: (0..self.n_points() as u32).map(|v| self.mesh.place(v)).collect() }
    }

    fn restore(&mut self, state: State) -> Result<(), Error> {
        self.mesh = SharedMesh::new(&state.half_edges, state.places.into_iter());
        Ok(())
    }
}
