//! [`Draft`]: a mesh on a surface whose edges are split, flipped and collapsed; no vertex of it ever moves.

use glam::DVec3;

use super::shape::{Guard, is_delaunay};
use crate::surface::{Features, Place, Surface};
use crate::triangulation::{BORDER, HalfEdges, next, prev};

/// A vertex of a draft.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub place: Place,
    /// The surface's normal there.
    pub normal: DVec3,
    /// The wanted spacing there, relative.
    pub size: f64,
    /// Whether it lies on a crease or a border.
    pub is_on_crease: bool,
    /// Whether it is never taken away.
    pub is_pinned: bool,
    /// Whether it stands where a given point is.
    pub is_given: bool,
}

/// Vertices have so many neighbours at most.
const MOST_NEIGHBOURS: usize = 12;
/// Collapses that may bend triangles by this, as a cosine, may also leave obtuse triangles between vertices that all stay.
const LAST_TURN: f64 = -0.5;

pub(super) struct Draft<'a> {
    pub surface: &'a Surface,
    pub features: &'a Features,
    /// Wanted spacings at the surface's vertices.
    pub sizes: &'a [f64],
    pub mesh: HalfEdges,
    pub vertices: Vec<Vertex>,
    /// A half-edge that leaves each vertex; on a border that which lies there. `BORDER` for a vertex that is gone.
    pub outgoing: Vec<u32>,
    /// For each half-edge whether it lies on a crease or a border.
    pub is_crease: Vec<bool>,
    /// For each triangle that of the surface in which it lies, until edges between two of these are flipped.
    pub hosts: Vec<u32>,
    pub n_live: usize,
    /// Vertices on creases that are to be taken away.
    pub n_loose: usize,
    /// Whether what is given stays.
    pub keeps_given: bool,
    /// By which vertices are told that have been seen in the round at hand.
    marks: Vec<u32>,
    round: u32,
}

impl<'a> Draft<'a> {
    /// The surface's own triangles.
    pub fn new(surface: &'a Surface, features: &'a Features, sizes: &'a [f64]) -> Self {
        let mesh = surface.half_edges.clone();
        let outgoing = mesh.outgoing(surface.n_vertices());
        let vertices = (0..surface.n_vertices())
            .map(|v| {
                // A vertex without triangles is gone.
                let h = if outgoing[v] == BORDER { 0 } else { outgoing[v] };
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
            n_live: outgoing.iter().filter(|&&h| h != BORDER).count(),
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
        self.outgoing[v as usize] != BORDER
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
        self.mesh.twin[h as usize] = BORDER;
        self.outgoing[m as usize] = half;
        if t != BORDER {
            let other = self.halve(t, m);
            self.join(h, other);
            self.join(t, half);
        }
        m
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
            if across != BORDER {
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
            self.start_at_border(v);
        });
        m
    }

    fn add(&mut self, place: Place, is_on_crease: bool) -> u32 {
        let sizes = self.surface.half_edges.triangle(place.face as usize).map(|v| self.sizes[v as usize]);
        let (size, normal) = (place.mean(sizes), self.features.normal(&place));
        self.vertices.push(Vertex { place, normal, size, is_on_crease, is_pinned: false, is_given: false });
        self.outgoing.push(BORDER);
        self.marks.push(0);
        self.n_live += 1;
        self.n_loose += usize::from(is_on_crease);
        self.vertices.len() as u32 - 1
    }

    fn push_triangle(&mut self, corners: [u32; 3], host: u32) -> u32 {
        let first = self.mesh.origin.len() as u32;
        self.mesh.origin.extend(corners);
        self.mesh.twin.extend([BORDER; 3]);
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
        if across != BORDER {
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

    /// Lets walks around a vertex begin at its border, if it has one.
    fn start_at_border(&mut self, v: u32) {
        let first = self.outgoing[v as usize];
        let mut h = first;
        while self.mesh.twin[h as usize] != BORDER {
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
    pub fn legalize_within(&mut self, suspects: &mut Vec<u32>) {
        let is_within = |draft: &Self, [h, t]: [u32; 2]| draft.hosts[h as usize / 3] == draft.hosts[t as usize / 3];
        self.flip_all(suspects, is_within, |_, _| {});
    }

    fn flip_all(&mut self, suspects: &mut Vec<u32>, may_flip: impl Fn(&Self, [u32; 2]) -> bool, mut show: impl FnMut(&Self, u32)) {
        while let Some(h) = suspects.pop() {
            let t = self.mesh.twin[h as usize];
            if t == BORDER || self.is_crease[h as usize] || !may_flip(self, [h, t]) || !self.should_flip(h) {
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
    fn fit(&self, normal: DVec3, corners: [u32; 3]) -> f64 {
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
            if across != BORDER {
                self.mesh.twin[across as usize] = edge;
            }
        }
        for (v, edge) in [(p, next(t)), (q, next(h)), (s, h), (r, t)] {
            self.outgoing[v as usize] = edge;
            self.start_at_border(v);
        }
    }

    /// Takes an end of the edge of `h` away, so that its triangles go to the other end, if that leaves a mesh whose triangles bend by less than `least_turn`, a cosine.
    pub fn collapse(&mut self, h: u32, v: u32, least_turn: f64) -> bool {
        let u = if v == self.mesh.origin[h as usize] { self.mesh.target(h) } else { self.mesh.origin[h as usize] };
        if !self.can_collapse(h, v, u, least_turn) {
            return false;
        }
        let t = self.mesh.twin[h as usize];
        let ring: Vec<u32> = self.mesh.around(self.outgoing[v as usize]).collect();
        ring.iter().for_each(|&h| self.mesh.origin[h as usize] = u);
        let mut touched = vec![u];
        // In place of each triangle at the edge its two other sides become one.
        for h in [h, t].into_iter().filter(|&h| h != BORDER) {
            let (n, p) = (next(h), prev(h));
            let apex = self.mesh.origin[p as usize];
            let [x, y] = [n, p].map(|side| self.mesh.twin[side as usize]);
            let is_crease = self.is_crease[n as usize] || self.is_crease[p as usize];
            for (one, other) in [(x, y), (y, x)] {
                if one != BORDER {
                    self.mesh.twin[one as usize] = other;
                    self.is_crease[one as usize] = is_crease;
                }
            }
            // One of the two sides has a neighbour, or the triangle would have been alone.
            let leaves_apex = |side: u32| if self.mesh.origin[side as usize] == apex { side } else { next(side) };
            let inner = if x != BORDER { x } else { y };
            self.outgoing[apex as usize] = leaves_apex(inner);
            self.outgoing[u as usize] = if self.mesh.origin[inner as usize] == u { inner } else { next(inner) };
            touched.push(apex);
            for k in 3 * (h / 3)..3 * (h / 3) + 3 {
                self.mesh.origin[k as usize] = BORDER;
                self.mesh.twin[k as usize] = BORDER;
            }
        }
        self.outgoing[v as usize] = BORDER;
        self.n_live -= 1;
        self.n_loose -= usize::from(self.is_loose(v));
        touched.into_iter().for_each(|v| self.start_at_border(v));
        true
    }

    fn is_on_border(&self, v: u32) -> bool {
        self.mesh.twin[self.outgoing[v as usize] as usize] == BORDER
    }

    fn can_collapse(&mut self, h: u32, v: u32, u: u32, least_turn: f64) -> bool {
        let vertex = &self.vertices[v as usize];
        // A crease is left only along it.
        let stays = vertex.is_pinned || vertex.is_given && self.keeps_given;
        if stays || vertex.is_on_crease && !self.is_crease[h as usize] {
            return false;
        }
        let t = self.mesh.twin[h as usize];
        let apexes = [h, t].map(|h| if h == BORDER { BORDER } else { self.mesh.origin[prev(h) as usize] });
        // The only common neighbours are the apexes.
        self.round += 1;
        let (mut n_neighbours, mut n_common) = ([0, 0], 0);
        for (k, at) in [v, u].into_iter().enumerate() {
            let first = self.outgoing[at as usize];
            let mut mark = |draft: &mut Self, other: u32| {
                n_neighbours[k] += 1;
                if k == 0 {
                    draft.marks[other as usize] = draft.round;
                } else if draft.marks[other as usize] == draft.round {
                    n_common += 1;
                }
            };
            let mut h = first;
            loop {
                let other = self.mesh.target(h);
                mark(self, other);
                let turned = self.mesh.twin[prev(h) as usize];
                if turned == BORDER {
                    let last = self.mesh.origin[prev(h) as usize];
                    mark(self, last);
                    break;
                }
                if turned == first {
                    break;
                }
                h = turned;
            }
        }
        let n_apexes = apexes.iter().filter(|&&apex| apex != BORDER).count();
        let is_border_edge = n_apexes == 1;
        if n_common != n_apexes || n_neighbours[0] + n_neighbours[1] > MOST_NEIGHBOURS + 4 {
            return false;
        }
        if self.is_on_border(v) && (!is_border_edge || n_neighbours[0] + n_neighbours[1] < 6)
            || n_neighbours[0] + n_neighbours[1] < 7 - 2 * usize::from(is_border_edge)
        {
            return false;
        }
        // An apex loses a neighbour, and two creases never become one.
        let first_side = [h, t].into_iter().filter(|&h| h != BORDER);
        for h in first_side {
            let apex = self.mesh.origin[prev(h) as usize];
            let n = self.mesh.around(self.outgoing[apex as usize]).count();
            if n < if self.is_on_border(apex) { 2 } else { 4 } || self.is_crease[next(h) as usize] && self.is_crease[prev(h) as usize] {
                return false;
            }
        }
        let (from, to) = (self.at(v), self.at(u));
        let is_spared = !self.vertices[v as usize].is_on_crease && least_turn > LAST_TURN;
        self.mesh.around(self.outgoing[v as usize]).all(|h| {
            let [x, y] = [self.mesh.target(h), self.mesh.origin[prev(h) as usize]];
            if x == u || y == u {
                return true;
            }
            let [b, c] = [x, y].map(|v| self.at(v));
            let (old, new) = ((b - from).cross(c - from), (b - to).cross(c - to));
            let is_turned = new.dot(old) <= least_turn * new.length() * old.length();
            let is_bad = is_turned || is_spared && self.is_wedged([u, x, y]);
            !is_bad && Guard::FIRM.allows(self.fit(old, [v, x, y]), self.fit(new, [u, x, y]))
        })
    }

    /// Whether a triangle would be obtuse for good.
    fn is_wedged(&self, corners: [u32; 3]) -> bool {
        let [a, b, c] = corners.map(|v| self.at(v));
        let is_obtuse = |at: DVec3, one: DVec3, other: DVec3| (one - at).dot(other - at) < 0.0;
        corners.iter().all(|&v| self.vertices[v as usize].is_pinned) && (is_obtuse(a, b, c) || is_obtuse(b, c, a) || is_obtuse(c, a, b))
    }

    /// What is left, numbered anew in a given order of the vertices.
    pub fn compact(&self, order: &[u32]) -> HalfEdges {
        let mut number = vec![BORDER; self.vertices.len()];
        for (new, &v) in (0..).zip(order) {
            number[v as usize] = new;
        }
        let mut live: Vec<usize> = (0..self.mesh.n_triangles()).filter(|&t| self.mesh.origin[3 * t] != BORDER).collect();
        live.sort_by_cached_key(|&t| self.mesh.triangle(t).map(|v| number[v as usize]).into_iter().min());
        let mut slots = vec![BORDER; self.mesh.n_triangles()];
        for (new, &t) in (0..).zip(&live) {
            slots[t] = new;
        }
        let all = || live.iter().flat_map(|&t| 3 * t..3 * t + 3);
        let twin = |h: usize| {
            let twin = self.mesh.twin[h];
            if twin == BORDER { BORDER } else { 3 * slots[twin as usize / 3] + twin % 3 }
        };
        HalfEdges { origin: all().map(|h| number[self.mesh.origin[h] as usize]).collect(), twin: all().map(twin).collect() }
    }
}
