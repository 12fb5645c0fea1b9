//! Mesh data that several threads may change at once, in safe Rust: relaxed atomics, plain loads and stores on today's machines.
//!
//! Who may touch what is not settled here but by [`Territory`]: no two threads ever meet at one number, so relaxed order is enough, and
//! the result does not depend on them.

use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

use glam::DVec2;

use super::half_edges::{BOUNDARY, HalfEdges, next, prev};

/// Half-edges and vertices, as in [`HalfEdges`], but shared. Of each vertex there are `N` numbers: where it is, and what belongs to the place.
pub(crate) struct SharedMesh<const N: usize> {
    /// What follows a half-edge counter-clockwise: the apex of its triangle, and above it the next half-edge around its origin.
    ///
    /// These are origin and twin of the half-edge before it, so a walk around a vertex takes one load a step.
    turns: Vec<AtomicU64>,
    vertices: Vec<Vertex<N>>,
}

/// All that belongs to a vertex, side by side.
struct Vertex<const N: usize> {
    place: [AtomicU64; N],
    /// A half-edge that leaves it; on a boundary that which lies there.
    outgoing: AtomicU32,
    /// Its block, and whether it is dirty.
    mark: AtomicU32,
}

/// The bits of a mark between its two fields; one of them says that the vertex is dirty.
const GUARD: u32 = 0x8000_8000;
const DIRTY: u32 = 0x0000_8000;

/// The vertices that one thread may touch: those of some blocks of the plane. Blocks are numbered along both axes, in fields of a mark.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Territory {
    /// The mark of its first block.
    pub first: u32,
    /// The bits that differ from 0, relative to the first block, outside of it.
    pub outside: u32,
}

impl Territory {
    /// All vertices.
    pub const EVERYTHING: Self = Self { first: 0, outside: 0 };

    #[inline]
    fn holds(self, mark: u32) -> bool {
        // The guards keep one field from borrowing from the other.
        ((mark | GUARD) - self.first) & self.outside == 0
    }
}

fn pair(apex: u32, turned: u32) -> u64 {
    u64::from(turned) << 32 | u64::from(apex)
}

impl<const N: usize> SharedMesh<N> {
    pub fn new(half_edges: &HalfEdges, places: impl ExactSizeIterator<Item = [f64; N]>) -> Self {
        let outgoing = half_edges.outgoing(places.len());
        let before = (0..half_edges.origin.len() as u32).map(|h| prev(h) as usize);
        let turns = before.map(|h| AtomicU64::new(pair(half_edges.origin[h], half_edges.twin[h])));
        let vertices = places.zip(outgoing).map(|(place, outgoing)| Vertex {
            place: place.map(|number| AtomicU64::new(number.to_bits())),
            outgoing: AtomicU32::new(outgoing),
            mark: AtomicU32::new(DIRTY),
        });
        Self { turns: turns.collect(), vertices: vertices.collect() }
    }

    pub fn half_edges(&self) -> HalfEdges {
        let all = 0..self.n_half_edges() as u32;
        HalfEdges { origin: all.clone().map(|h| self.origin(h)).collect(), twin: all.map(|h| self.twin(h)).collect() }
    }

    pub fn n_vertices(&self) -> usize {
        self.vertices.len()
    }

    pub fn n_half_edges(&self) -> usize {
        self.turns.len()
    }

    /// The apex of a half-edge's triangle, and the half-edge that leaves its origin there, on the other side of that edge.
    #[inline]
    pub fn turn(&self, h: u32) -> (u32, u32) {
        let turn = self.turns[h as usize].load(Relaxed);
        (turn as u32, (turn >> 32) as u32)
    }

    #[inline]
    pub fn origin(&self, h: u32) -> u32 {
        self.turn(next(h)).0
    }

    #[inline]
    pub fn twin(&self, h: u32) -> u32 {
        self.turn(next(h)).1
    }

    /// Makes `origin` and `twin` those of `h`.
    fn set(&self, h: u32, origin: u32, twin: u32) {
        self.turns[next(h) as usize].store(pair(origin, twin), Relaxed);
    }

    /// Makes a triangle of three edges, each given by its origin and the half-edge across.
    pub fn make_triangle(&self, t: u32, rims: [(u32, u32); 3]) {
        for (h, (origin, twin)) in (3 * t..).zip(rims) {
            self.set(h, origin, twin);
            self.vertices[origin as usize].outgoing.store(h, Relaxed);
        }
        for (h, (_, across)) in (3 * t..).zip(rims) {
            if across != BOUNDARY {
                self.set(across, self.origin(across), h);
            }
        }
    }

    /// Makes one triangle of the three around a vertex, and returns it with the two that are no part of the mesh then.
    pub fn unite(&self, v: u32) -> [u32; 3] {
        let first = self.outgoing(v);
        let second = self.turn(first).1;
        let third = self.turn(second).1;
        debug_assert_eq!(self.turn(third).1, first);
        let rims = [first, second, third].map(|h| (self.origin(next(h)), self.twin(next(h))));
        let triangles = [first / 3, second / 3, third / 3];
        self.replace(triangles, rims.map(|(corner, _)| corner), &[(triangles[0], rims)]);
        triangles
    }

    /// Makes three triangles around a vertex of the first one, and of two that are no part of the mesh.
    pub fn divide(&self, v: u32, triangles: [u32; 3]) {
        let first = 3 * triangles[0];
        let (corners, across) = ([0, 1, 2].map(|k| self.origin(first + k)), [0, 1, 2].map(|k| self.twin(first + k)));
        // (a b v): its second edge meets the next triangle's third.
        let made = [0, 1, 2].map(|k| {
            let [after, before] = [triangles[(k + 1) % 3], triangles[(k + 2) % 3]];
            (triangles[k], [(corners[k], across[k]), (corners[(k + 1) % 3], 3 * after + 2), (v, 3 * before + 1)])
        });
        self.replace(triangles, corners, &made);
    }

    /// Makes triangles in the place of others. Walks around corners on a boundary still begin there.
    fn replace(&self, old: [u32; 3], corners: [u32; 3], made: &[(u32, [(u32, u32); 3])]) {
        let starts = corners.map(|v| self.outgoing(v));
        let are_on_boundary = starts.map(|h| self.twin(h) == BOUNDARY);
        made.iter().for_each(|&(t, rims)| self.make_triangle(t, rims));
        for ((v, start), _) in corners.into_iter().zip(starts).zip(are_on_boundary).filter(|&(_, is_on_boundary)| is_on_boundary) {
            let rims = || made.iter().flat_map(|(t, rims)| (3 * t..).zip(*rims));
            let moved = || rims().find(|&(_, (origin, twin))| origin == v && twin == BOUNDARY).map(|(h, _)| h);
            let start = if old.contains(&(start / 3)) { moved() } else { Some(start) };
            start.into_iter().for_each(|h| self.vertices[v as usize].outgoing.store(h, Relaxed));
        }
    }

    /// A half-edge that leaves `v`; on a boundary that which lies there, the first counter-clockwise.
    #[inline]
    pub fn outgoing(&self, v: u32) -> u32 {
        self.vertices[v as usize].outgoing.load(Relaxed)
    }

    #[inline]
    pub fn place(&self, v: u32) -> [f64; N] {
        let Vertex { place, .. } = &self.vertices[v as usize];
        std::array::from_fn(|k| f64::from_bits(place[k].load(Relaxed)))
    }

    /// Some of the numbers, from the one at `first` on.
    #[inline]
    pub fn part<const M: usize>(&self, v: u32, first: usize) -> [f64; M] {
        let Vertex { place, .. } = &self.vertices[v as usize];
        std::array::from_fn(|k| f64::from_bits(place[first + k].load(Relaxed)))
    }

    #[inline]
    pub fn set_place(&self, v: u32, place: [f64; N]) {
        for (number, new) in self.vertices[v as usize].place.iter().zip(place) {
            number.store(new.to_bits(), Relaxed);
        }
    }

    /// Whether `v` lies in `territory`.
    #[inline]
    pub fn is_within(&self, v: u32, territory: Territory) -> bool {
        territory.holds(self.vertices[v as usize].mark.load(Relaxed))
    }

    pub fn set_block(&self, v: u32, block: u32) {
        let mark = &self.vertices[v as usize].mark;
        mark.store(block | mark.load(Relaxed) & DIRTY, Relaxed);
    }

    #[inline]
    pub fn is_dirty(&self, v: u32) -> bool {
        self.vertices[v as usize].mark.load(Relaxed) & DIRTY != 0
    }

    #[inline]
    pub fn set_dirty(&self, v: u32, is_dirty: bool) {
        let mark = &self.vertices[v as usize].mark;
        let block = mark.load(Relaxed) & !DIRTY;
        mark.store(if is_dirty { block | DIRTY } else { block }, Relaxed);
    }

    /// The corners around the edge of `h`, which is on no boundary: its ends p and q, its apex r, and the apex s across.
    pub fn quadrilateral(&self, h: u32) -> [u32; 4] {
        let t = self.twin(h);
        [self.origin(h), self.origin(t), self.turn(h).0, self.turn(t).0]
    }

    /// Replaces the edge of `h` by the other diagonal of its quadrilateral: (p q r) and (q p s) become (s q r) and (r p s).
    pub fn flip(&self, h: u32) {
        let t = self.twin(h);
        let [p, q, r, s] = self.quadrilateral(h);
        let (r_edge, s_edge) = (prev(h), prev(t));
        let (across_t, across_h) = (self.twin(r_edge), self.twin(s_edge));
        // On a boundary walks begin there, and half-edges on it may come to another place.
        let ends_on_boundary = [p, q].map(|v| self.twin(self.outgoing(v)) == BOUNDARY);
        self.set(h, s, across_h);
        self.set(t, r, across_t);
        self.set(r_edge, r, s_edge);
        self.set(s_edge, s, r_edge);
        for (across, edge) in [(across_h, h), (across_t, t)] {
            if across != BOUNDARY {
                self.set(across, self.origin(across), edge);
            }
        }
        for (v, is_on_boundary, edge) in [(p, ends_on_boundary[0], next(t)), (q, ends_on_boundary[1], next(h))] {
            if !is_on_boundary {
                self.vertices[v as usize].outgoing.store(edge, Relaxed);
            }
        }
        for (v, twin, moved) in [(s, across_h, h), (r, across_t, t)] {
            if twin == BOUNDARY {
                self.vertices[v as usize].outgoing.store(moved, Relaxed);
            }
        }
    }
}

impl SharedMesh<2> {
    #[inline]
    pub fn position(&self, v: u32) -> DVec2 {
        self.place(v).into()
    }

    #[inline]
    pub fn set_position(&self, v: u32, p: DVec2) {
        self.set_place(v, p.to_array());
    }
}
