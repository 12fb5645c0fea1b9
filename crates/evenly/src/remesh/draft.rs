//! [`Draft`]: a mesh on a surface whose edges are split, flipped and collapsed; no vertex of it ever moves.

use glam::DVec3;

use super::shape::{Guard, is_delaunay};
use crate::surface::{Features, Place, Surface, morton};
use crate::triangulation::{BOUNDARY, HalfEdges, next, prev};

/// A vertex of a draft.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub place: Place,
    /// The surface's normal there.
    pub normal: DVec3,
    /// The wanted spacing there, relative.
    pub size: f64,
    /// Whether it lies on a crease or a boundary.
    pub is_on_crease: bool,
    /// Whether it is never taken away.
    pub is_pinned: bool,
    /// Whether it stands where a given point is.
    pub is_given: bool,
}

pub(super) struct Draft<'a> {
    pub surface: &'a Surface,
    pub features: &'a Features,
    /// Wanted spacings at the surface's vertices.
    pub sizes: &'a [f64],
    pub mesh: HalfEdges,
    pub vertices: Vec<Vertex>,
    /// A half-edge that leaves each vertex; on a boundary that which lies there. `BOUNDARY` for a vertex that is gone.
    pub outgoing: Vec<u32>,
    /// For each half-edge whether it lies on a crease or a boundary.
    pub is_crease: Vec<bool>,
    /// For each triangle that of the surface in which it lies, until edges between two of these are flipped.
    pub hosts: Vec<u32>,
    pub n_live: usize,
    /// Vertices on creases that are to be taken away.
    pub n_loose: usize,
    /// Whether what is given stays.
    pub keeps_given: bool,
    /// By which vertices are told that have been seen in the round at hand.
    pub(super) marks: Vec<u32>,
    pub(super) round: u32,
}

impl<'a> Draft<'a> {
    /// The surface's own triangles.
    pub fn new(surface: &'a Surface, features: &'a Features, sizes: &'a [f64]) -> Self {
        let mesh = surface.half_edges.clone();
        let outgoing = mesh.outgoing(surface.n_vertices());
        let vertices = (0..surface.n_vertices())
            .map(|v| {
                // A vertex without triangles is gone.
                let h = if outgoing[v] == BOUNDARY { 0 } else { outgoing[v] };
                let mut weights = [0.0; 3];
                weights[h as usize % 3] = 1.0;
                Vertex {
                    place: Place::new(surface, h / 3, weights),
                    normal: features.corner_normals[h as usize],
                    size: sizes[v],
                    is_on_crease: false,
                    is_pinned: false,
                    is_given: false,
                }
            })
            .collect();
        let mut draft = Self {
            surface,
            features,
            sizes,
            n_live: outgoing.iter().filter(|&&h| h != BOUNDARY).count(),
            n_loose: 0,
            keeps_given: true,
            marks: vec![0; outgoing.len()],
            round: 0,
            vertices,
            outgoing,
            is_crease: features.is_crease.clone(),
            hosts: (0..mesh.n_triangles() as u32).collect(),
            mesh,
        };
        for h in (0..draft.mesh.origin.len()).filter(|&h| draft.is_crease[h]) {
            for v in [draft.mesh.origin[h], draft.mesh.target(h as u32)] {
                draft.vertices[v as usize].is_on_crease = true;
            }
        }
        draft.n_loose = draft.vertices.iter().filter(|vertex| vertex.is_on_crease).count();
        draft
    }

    pub fn at(&self, v: u32) -> DVec3 {
        self.vertices[v as usize].place.at
    }

    pub fn is_live(&self, v: u32) -> bool {
        self.outgoing[v as usize] != BOUNDARY
    }

    /// Whether it lies on a crease, and is to be taken away.
    pub fn is_loose(&self, v: u32) -> bool {
        let vertex = &self.vertices[v as usize];
        vertex.is_on_crease && !vertex.is_pinned
    }

    /// Lets a vertex stay.
    pub fn pin(&mut self, v: u32) {
        self.n_loose -= usize::from(self.is_loose(v));
        self.vertices[v as usize].is_pinned = true;
    }

    /// The half-edge from one vertex to another.
    pub fn find(&self, from: u32, to: u32) -> Option<u32> {
        self.mesh.around(self.outgoing[from as usize]).find(|&h| self.mesh.target(h) == to)
    }

    /// The edge between two vertices, whichever of its half-edges there is.
    pub fn find_edge(&self, a: u32, b: u32) -> Option<u32> {
        self.find(a, b).or_else(|| self.find(b, a))
    }

    /// An edge's length, relative to the spacing that is wanted there.
    pub fn length(&self, h: u32) -> f64 {
        let [a, b] = [self.mesh.origin[h as usize], self.mesh.target(h)].map(|v| &self.vertices[v as usize]);
        a.place.at.distance(b.place.at) * 2.0 / (a.size + b.size)
    }

    /// Puts a new vertex on an edge, so far along it, and returns it. Only while triangles have hosts.
    pub fn split(&mut self, h: u32, share: f64) -> u32 {
        let [p, q] = [self.mesh.origin[h as usize], self.mesh.target(h)].map(|v| self.at(v));
        self.split_at(h, self.surface.nearest_on(self.hosts[h as usize / 3], p + share * (q - p)))
    }

    /// The same, at a place of the edge.
    pub fn split_at(&mut self, h: u32, place: Place) -> u32 {
        let is_on_crease = self.is_crease[h as usize];
        let m = self.add(place, is_on_crease);
        let t = self.mesh.twin[h as usize];
        // Of (p q r), and of (q p s) across, the half at q, and at p, is a new triangle.
        let half = self.halve(h, m);
        self.mesh.twin[h as usize] = BOUNDARY;
        self.outgoing[m as usize] = half;
        if t != BOUNDARY {
            let other = self.halve(t, m);
            self.join(h, other);
            self.join(t, half);
        }
        m
    }

    /// Splits edges until no two join the same vertices: a flat part whose two sides share their corners has such as soon as its rim has new ones.
    pub fn split_doubles(&mut self) {
        let mut targets = Vec::new();
        for v in 0..self.vertices.len() as u32 {
            while let Some(double) = self.double_of(v, &mut targets) {
                self.split(double, 0.5);
            }
        }
    }

    /// A half-edge that leaves a vertex for where another one goes as well.
    fn double_of(&self, v: u32, targets: &mut Vec<u32>) -> Option<u32> {
        targets.clear();
        let around = (self.is_live(v)).then(|| self.mesh.around(self.outgoing[v as usize]));
        around.into_iter().flatten().find(|&h| {
            let target = self.mesh.target(h);
            let is_double = targets.contains(&target);
            targets.push(target);
            is_double
        })
    }

    /// Puts a new vertex into a triangle, and returns it. Only while triangles have hosts.
    pub fn insert(&mut self, t: u32, place: Place) -> u32 {
        let (m, first) = (self.add(place, false), 3 * t);
        let [a, b, c] = self.mesh.triangle(t as usize);
        // Of (a b c) what lies at the first edge stays, and (b c m) and (c a m) are new.
        let others = [[b, c, m], [c, a, m]].map(|corners| self.push_triangle(corners, self.hosts[t as usize]));
        for (edge, new) in [(first + 1, others[0]), (first + 2, others[1])] {
            let across = self.mesh.twin[edge as usize];
            (self.mesh.twin[new as usize], self.is_crease[new as usize]) = (across, self.is_crease[edge as usize]);
            if across != BOUNDARY {
                self.mesh.twin[across as usize] = new;
            }
            self.is_crease[edge as usize] = false;
        }
        self.mesh.origin[first as usize + 2] = m;
        self.join(first + 1, others[0] + 2);
        self.join(first + 2, others[1] + 1);
        self.join(others[0] + 1, others[1] + 2);
        self.outgoing[m as usize] = first + 2;
        [a, b, c].into_iter().zip([first, others[0], others[1]]).for_each(|(v, h)| {
            self.outgoing[v as usize] = h;
            self.start_at_boundary(v);
        });
        m
    }

    fn add(&mut self, place: Place, is_on_crease: bool) -> u32 {
        let sizes = self.surface.half_edges.triangle(place.face as usize).map(|v| self.sizes[v as usize]);
        let (size, normal) = (place.mean(sizes), self.features.normal(&place));
        self.vertices.push(Vertex { place, normal, size, is_on_crease, is_pinned: false, is_given: false });
        self.outgoing.push(BOUNDARY);
        self.marks.push(0);
        self.n_live += 1;
        self.n_loose += usize::from(is_on_crease);
        self.vertices.len() as u32 - 1
    }

    fn push_triangle(&mut self, corners: [u32; 3], host: u32) -> u32 {
        let first = self.mesh.origin.len() as u32;
        self.mesh.origin.extend(corners);
        self.mesh.twin.extend([BOUNDARY; 3]);
        self.is_crease.extend([false; 3]);
        self.hosts.push(host);
        first
    }

    /// Ends the edge of `h`, and its triangle, at `m`; the rest becomes a new triangle, of which this returns the half-edge from `m`.
    fn halve(&mut self, h: u32, m: u32) -> u32 {
        let (n, q, r) = (next(h), self.mesh.target(h), self.mesh.origin[prev(h) as usize]);
        let (across, was_crease) = (self.mesh.twin[n as usize], self.is_crease[n as usize]);
        let half = self.push_triangle([m, q, r], self.hosts[h as usize / 3]);
        self.is_crease[half as usize] = self.is_crease[h as usize];
        self.is_crease[half as usize + 1] = was_crease;
        self.mesh.twin[half as usize + 1] = across;
        if across != BOUNDARY {
            self.mesh.twin[across as usize] = half + 1;
        }
        self.mesh.origin[n as usize] = m;
        self.is_crease[n as usize] = false;
        self.join(n, half + 2);
        if self.outgoing[q as usize] == n {
            self.outgoing[q as usize] = half + 1;
        }
        half
    }

    fn join(&mut self, a: u32, b: u32) {
        self.mesh.twin[a as usize] = b;
        self.mesh.twin[b as usize] = a;
    }

    /// Lets walks around a vertex begin at its boundary, if it has one.
    pub(super) fn start_at_boundary(&mut self, v: u32) {
        let first = self.outgoing[v as usize];
        let mut h = first;
        while self.mesh.twin[h as usize] != BOUNDARY {
            h = next(self.mesh.twin[h as usize]);
            if h == first {
                break;
            }
        }
        self.outgoing[v as usize] = h;
    }

    /// Lawson's flips from some half-edges on; shows the new edges.
    pub fn legalize(&mut self, suspects: &mut Vec<u32>, show: impl FnMut(&Self, u32)) {
        self.flip_all(suspects, |_, _| true, show);
    }

    /// The same, of edges within triangles of the surface: hosts stay what they are.
    pub fn legalize_within(&mut self, suspects: &mut Vec<u32>, show: impl FnMut(&Self, u32)) {
        let is_within = |draft: &Self, [h, t]: [u32; 2]| draft.hosts[h as usize / 3] == draft.hosts[t as usize / 3];
        self.flip_all(suspects, is_within, show);
    }

    fn flip_all(&mut self, suspects: &mut Vec<u32>, may_flip: impl Fn(&Self, [u32; 2]) -> bool, mut show: impl FnMut(&Self, u32)) {
        while let Some(h) = suspects.pop() {
            let t = self.mesh.twin[h as usize];
            if t == BOUNDARY || self.is_crease[h as usize] || !may_flip(self, [h, t]) || !self.should_flip(h) {
                continue;
            }
            self.flip(h);
            suspects.extend([h, t, next(h), next(t)]);
            show(self, prev(h));
        }
    }

    /// Whether the edge of `h` is not Delaunay, and the other diagonal can be.
    fn should_flip(&self, h: u32) -> bool {
        let corners @ [.., r, s] = self.quadrilateral(h);
        let places = corners.map(|v| self.at(v));
        !is_delaunay(places) && r != s && self.find_edge(r, s).is_none() && Guard::FIRM.allows_flip(places, corners.map(|v| self.normal(v)))
    }

    /// The surface's normal at a vertex; on creases and at tips there is none.
    fn normal(&self, v: u32) -> Option<DVec3> {
        let vertex = &self.vertices[v as usize];
        (!vertex.is_on_crease && !vertex.is_pinned).then_some(vertex.normal)
    }

    /// How well a triangle's normal fits the surface's at its corners, where it has one.
    pub(super) fn fit(&self, normal: DVec3, corners: [u32; 3]) -> f64 {
        Guard::fit(normal, corners.map(|v| self.normal(v)))
    }

    fn quadrilateral(&self, h: u32) -> [u32; 4] {
        let t = self.mesh.twin[h as usize];
        [h, t, prev(h), prev(t)].map(|h| self.mesh.origin[h as usize])
    }

    /// Replaces the edge of `h` by the other diagonal: (p q r) and (q p s) become (s q r) and (r p s).
    fn flip(&mut self, h: u32) {
        let t = self.mesh.twin[h as usize];
        let [p, q, r, s] = self.quadrilateral(h);
        let (r_edge, s_edge) = (prev(h), prev(t));
        let side = |draft: &Self, h: u32| (draft.mesh.twin[h as usize], draft.is_crease[h as usize]);
        let (of_t, of_h) = (side(self, r_edge), side(self, s_edge));
        self.mesh.origin[h as usize] = s;
        self.mesh.origin[t as usize] = r;
        self.join(r_edge, s_edge);
        (self.is_crease[r_edge as usize], self.is_crease[s_edge as usize]) = (false, false);
        for (edge, (across, is_crease)) in [(h, of_h), (t, of_t)] {
            self.mesh.twin[edge as usize] = across;
            self.is_crease[edge as usize] = is_crease;
            if across != BOUNDARY {
                self.mesh.twin[across as usize] = edge;
            }
        }
        for (v, edge) in [(p, next(t)), (q, next(h)), (s, h), (r, t)] {
            self.outgoing[v as usize] = edge;
            self.start_at_boundary(v);
        }
    }

    /// Forgets what is gone, and puts vertices that are near to each other in space near to each other in memory, triangles by their first vertex.
    pub fn tidy(&mut self) {
        let mut order: Vec<u32> = (0..self.vertices.len() as u32).filter(|&v| self.is_live(v)).collect();
        order.sort_by_cached_key(|&v| (morton(self.at(v)), v));
        let mut number = vec![BOUNDARY; self.vertices.len()];
        (0..).zip(&order).for_each(|(new, &v)| number[v as usize] = new);
        let mut live: Vec<usize> = (0..self.mesh.n_triangles()).filter(|&t| self.mesh.origin[3 * t] != BOUNDARY).collect();
        live.sort_by_cached_key(|&t| self.mesh.triangle(t).map(|v| number[v as usize]).into_iter().min());
        let mut slots = vec![BOUNDARY; self.mesh.n_triangles()];
        (0..).zip(&live).for_each(|(new, &t)| slots[t] = new);
        let all = || live.iter().flat_map(|&t| 3 * t..3 * t + 3);
        let twin = |h: usize| {
            let twin = self.mesh.twin[h];
            if twin == BOUNDARY { BOUNDARY } else { 3 * slots[twin as usize / 3] + twin % 3 }
        };
        let mesh = HalfEdges { origin: all().map(|h| number[self.mesh.origin[h] as usize]).collect(), twin: all().map(twin).collect() };
        self.is_crease = all().map(|h| self.is_crease[h]).collect();
        self.hosts = live.iter().map(|&t| self.hosts[t]).collect();
        self.vertices = order.iter().map(|&v| self.vertices[v as usize]).collect();
        self.outgoing = mesh.outgoing(order.len());
        self.marks = vec![0; order.len()];
        self.round = 0;
        self.mesh = mesh;
    }
}
