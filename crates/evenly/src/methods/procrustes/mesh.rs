//! The mesh that Procrustes analysis works on: its three steps, chunk by chunk along the Hilbert curve.

use glam::DVec2;
use rayon::prelude::*;

use super::flips::FlipRule;
use super::model::{Sides, amplitude, triangle_energy, ways_to_targets};
use crate::error::Error;
use crate::space::Domain;
use crate::triangulation::{BOUNDARY, Chunks, Patch, Triangulation, cover};

/// What a vertex's triangles ask of it: the sum of the ways to its targets, and how many there are.
#[derive(Clone, Copy, Default)]
struct Pull {
    sum: DVec2,
    n_targets: f64,
}

impl Pull {
    #[inline]
    fn add(&mut self, way: DVec2) {
        self.sum += way;
        self.n_targets += 1.0;
    }
}

pub(super) struct Mesh {
    triangulation: Triangulation,
    chunks: Chunks,
    sides: Sides,
    /// The last move of each vertex: exact, so that it can be undone.
    velocity: Vec<DVec2>,
    pulls: Vec<Pull>,
    /// |A| of each triangle.
    amplitude: Vec<f64>,
    /// Vertices that slide along an axis (1 where they may move) or stay.
    sliders: Vec<(u32, DVec2)>,
    n_fixed: usize,
    /// Each chunk's pulls on vertices of other chunks.
    strays: Vec<Vec<(u32, DVec2)>>,
    /// Each chunk's triangles that the last move has turned over.
    inverted: Vec<Vec<u32>>,
    /// Each chunk's edges that reach out of it, and flips that would.
    crossing: Vec<Vec<u32>>,
}

/// What a pass over the triangles has found.
pub(super) struct Matched {
    pub n_flips: usize,
    pub energy: f64,
}

impl Mesh {
    /// A mesh in which the caller's first `n_fixed` points stay.
    pub fn new(mut triangulation: Triangulation, sides: Sides, n_fixed: usize) -> Self {
        let n_vertices = triangulation.positions.len();
        let chunks = Chunks::new(&triangulation.half_edges, n_vertices);
        let mut mesh = Self {
            sides,
            velocity: vec![DVec2::ZERO; n_vertices],
            pulls: vec![Pull::default(); n_vertices],
            amplitude: vec![0.0; triangulation.half_edges.n_triangles()],
            sliders: sliders(&triangulation, n_fixed),
            n_fixed,
            strays: vec![Vec::new(); chunks.n_chunks()],
            inverted: vec![Vec::new(); chunks.n_chunks()],
            crossing: chunks.patches(&mut triangulation.half_edges).iter().map(|patch| patch.crossing().collect()).collect(),
            triangulation,
            chunks,
        };
        mesh.measure_triangles();
        mesh
    }

    /// Proves what the triangulation claims to be. Around points that stay its boundary need not be convex, nor in a polygon, nor where gaps stop points.
    fn check(&self) -> Result<(), String> {
        let is_rough = self.n_fixed > 0 || self.triangulation.domain.boundary.is_some() || self.sides.gaps.is_some();
        if is_rough { self.triangulation.check_bounded() } else { self.triangulation.check() }
    }

    pub fn area(&self) -> f64 {
        self.triangulation.domain.area()
    }

    /// Step 3, where asked for: flips each edge where that lowers the energy and leaves both triangles turned the right way. Then step 1:
    /// fits the model triangle to each triangle and gathers the ways to the targets.
    ///
    /// A chunk is matched while it is still in the cache from flipping, so what reaches across chunks is flipped before, in order.
    pub fn flip_and_match(&mut self, is_flipping: bool) -> Matched {
        let Triangulation { half_edges, positions, domain, .. } = &mut self.triangulation;
        let (positions, domain, sides) = (&*positions, &*domain, &self.sides);
        let rule = FlipRule { positions, domain, sides };
        let mut n_flips = 0;
        if is_flipping {
            let mut whole = Patch::whole(half_edges);
            let edges = self.crossing.iter().flatten();
            n_flips += edges.filter(|&&h| rule.visit(&mut whole, &mut self.amplitude, h, &mut Vec::new())).count();
        }
        let chunks = (self.chunks.patches(half_edges), self.chunks.split_triangles(&mut self.amplitude));
        let vertices = (self.chunks.vertices(), self.chunks.split_vertices(&mut self.pulls));
        let found: Vec<Matched> = (chunks.into_par_iter(), vertices.into_par_iter(), &mut self.strays, &mut self.crossing)
            .into_par_iter()
            .map(|((mut patch, amplitude), (vertices, pulls), strays, crossing)| {
                let mut n_flips = 0;
                if is_flipping {
                    crossing.clear();
                    n_flips = rule.visit_all(&mut patch, amplitude, crossing);
                }
                pulls.fill(Pull::default());
                strays.clear();
                let mut energy = 0.0;
                for (t, &a) in patch.origin.chunks_exact(3).zip(&*amplitude) {
                    let at = |v: u32| positions[v as usize];
                    let u = domain.spoke(at(t[0]), at(t[1]));
                    let v = domain.spoke(at(t[0]), at(t[2]));
                    let centroid = at(t[0]) + (u + v) / 3.0;
                    if sides.is_gap(centroid) {
                        continue;
                    }
                    let side = sides.at(centroid);
                    energy += triangle_energy(a, u.perp_dot(v), side);
                    for (&vertex, way) in t.iter().zip(ways_to_targets(u, v, a, side)) {
                        match pulls.get_mut((vertex as usize).wrapping_sub(vertices.start)) {
                            Some(pull) => pull.add(way),
                            None => strays.push((vertex, way)),
                        }
                    }
                }
                Matched { n_flips, energy }
            })
            .collect();
        for &(vertex, way) in self.strays.iter().flatten() {
            self.pulls[vertex as usize].add(way);
        }
        self.unite_copies();
        debug_assert_eq!(self.check(), Ok(()));
        let energy = found.iter().map(|part| part.energy).sum();
        Matched { n_flips: n_flips + found.iter().map(|part| part.n_flips).sum::<usize>(), energy }
    }

    /// On a cover, gives all copies of a vertex the same pull: the energy is then minimised among periodic sets.
    fn unite_copies(&mut self) {
        let n_base = self.triangulation.n_base();
        let (base, copies) = self.pulls.split_at_mut(n_base);
        for copy in copies.chunks_exact(n_base) {
            for (sum, pull) in base.iter_mut().zip(copy) {
                sum.sum += pull.sum;
                sum.n_targets += pull.n_targets;
            }
        }
        for copy in copies.chunks_exact_mut(n_base) {
            copy.copy_from_slice(base);
        }
    }

    /// Step 2: moves each vertex to the mean of its targets, and by `momentum` of its last move beyond.
    pub fn move_vertices(&mut self, momentum: f64) {
        let Triangulation { positions, domain, order, copies, .. } = &mut self.triangulation;
        let sides = &self.sides;
        (self.chunks.split_vertices(positions), self.chunks.split_vertices(&mut self.velocity))
            .into_par_iter()
            .zip(self.chunks.vertices())
            .for_each(|((positions, velocities), range)| {
                for ((position, velocity), pull) in positions.iter_mut().zip(velocities).zip(&self.pulls[range.clone()]) {
                    let before = *position;
                    let by = pull.sum / pull.n_targets.max(1.0) + momentum * *velocity;
                    *position = domain.walk(before, before + sides.out_of_gap(before, by));
                    *velocity = domain.spoke(before, *position);
                }
            });
        for &(vertex, free) in &self.sliders {
            let (position, velocity) = (&mut positions[vertex as usize], &mut self.velocity[vertex as usize]);
            let before = *position - *velocity;
            *velocity *= free;
            *position = before + *velocity;
        }
        // Copies follow their base exactly.
        let n_base = order.len();
        if positions.len() > n_base {
            let moved = cover(&domain.uncovered(*copies), &positions[..n_base], *copies);
            for (position, p) in positions.iter_mut().zip(moved) {
                *position = domain.land(p);
            }
            for copy in 1..positions.len() / n_base {
                self.velocity.copy_within(..n_base, copy * n_base);
            }
        }
        self.measure_triangles();
    }

    /// Puts back the corners of every triangle that the last move has turned over, until there is none. Returns how many were put back.
    ///
    /// The mesh before the move had none; in the worst case every vertex returns there.
    pub fn undo_inverted(&mut self) -> usize {
        let mut inverted: Vec<u32> = self.inverted.iter().flatten().copied().collect();
        let (n_base, n_vertices) = (self.triangulation.n_base(), self.triangulation.positions.len());
        let domain = self.triangulation.domain.clone();
        let mut n_undone = 0;
        while !inverted.is_empty() {
            let mut touched = Vec::new();
            for &t in &inverted {
                for h in 3 * t..3 * t + 3 {
                    let base = self.triangulation.half_edges.origin[h as usize] as usize % n_base;
                    if self.velocity[base] == DVec2::ZERO {
                        continue;
                    }
                    n_undone += 1;
                    for vertex in (base..n_vertices).step_by(n_base) {
                        let position = &mut self.triangulation.positions[vertex];
                        *position = domain.land(*position - self.velocity[vertex]);
                        self.velocity[vertex] = DVec2::ZERO;
                    }
                    touched.push(base as u32);
                }
            }
            inverted = self.remeasure_around(&touched);
        }
        n_undone
    }

    /// Measures all triangles at these vertices and their copies again; returns those that are turned over.
    fn remeasure_around(&mut self, vertices: &[u32]) -> Vec<u32> {
        if vertices.is_empty() {
            return Vec::new();
        }
        let n_base = self.triangulation.n_base() as u32;
        let mut is_touched = vec![false; n_base as usize];
        for &v in vertices {
            is_touched[v as usize] = true;
        }
        let mut inverted = Vec::new();
        for (t, corners) in self.triangulation.half_edges.triangles().enumerate() {
            if corners.iter().any(|&v| is_touched[(v % n_base) as usize]) {
                let (u, v) = self.triangulation.spokes(corners);
                self.amplitude[t] = amplitude(u, v);
                if !self.triangulation.domain.is_upright(u, v) {
                    inverted.push(t as u32);
                }
            }
        }
        inverted
    }

    /// Computes |A| of every triangle; `inverted` then holds those that are turned over.
    fn measure_triangles(&mut self) {
        let Triangulation { half_edges, positions, domain, .. } = &self.triangulation;
        self.chunks.split_triangles(&mut self.amplitude).into_par_iter().zip(self.chunks.triangles()).zip(&mut self.inverted).for_each(
            |((amplitudes, range), inverted)| {
                inverted.clear();
                let corners = half_edges.origin[3 * range.start..3 * range.end].chunks_exact(3);
                for (k, (t, a)) in corners.zip(amplitudes).enumerate() {
                    let at = |v: u32| positions[v as usize];
                    let u = domain.spoke(at(t[0]), at(t[1]));
                    let v = domain.spoke(at(t[0]), at(t[2]));
                    *a = amplitude(u, v);
                    if !domain.is_upright(u, v) {
                        inverted.push((range.start + k) as u32);
                    }
                }
            },
        );
    }

    /// Triangles that are turned over, counted afresh.
    pub fn n_inverted(&self) -> usize {
        let spokes = self.triangulation.half_edges.triangles().map(|t| self.triangulation.spokes(t));
        spokes.filter(|&(u, v)| !self.triangulation.domain.is_upright(u, v)).count()
    }

    /// The mesh with its triangulation rebuilt; its vertices keep their numbers and their momentum.
    pub fn rebuilt(self, n_fixed: usize, rebuild: impl FnOnce(Triangulation) -> Result<Triangulation, Error>) -> Result<Self, Error> {
        let mut mesh = Self::new(rebuild(self.triangulation)?, self.sides, n_fixed);
        mesh.velocity = self.velocity;
        Ok(mesh)
    }

    /// The caller's index and the position of each base vertex.
    pub fn into_positions(self, base_domain: &Domain) -> (Vec<u32>, Vec<DVec2>) {
        let positions = self.positions(base_domain);
        (self.triangulation.order, positions)
    }

    /// Where the points are, in input units and the caller's order.
    pub fn shown(&self, base_domain: &Domain) -> Vec<[f64; 2]> {
        base_domain.restored(&self.triangulation.order, &self.positions(base_domain))
    }

    fn positions(&self, base_domain: &Domain) -> Vec<DVec2> {
        let Triangulation { positions, order, copies, .. } = &self.triangulation;
        let home = |p: DVec2| if *copies == [1, 1] { p } else { base_domain.land(p - (p / base_domain.size).floor() * base_domain.size) };
        positions[..order.len()].iter().map(|&p| home(p)).collect()
    }
}

/// Boundary vertices of a rectangle, with the axes along which they may move, and those that stay.
fn sliders(triangulation: &Triangulation, n_fixed: usize) -> Vec<(u32, DVec2)> {
    let Triangulation { half_edges, positions, domain, order, .. } = triangulation;
    let fixed = (0..).zip(order).filter(|&(_, &index)| (index as usize) < n_fixed).map(|(vertex, _)| (vertex, DVec2::ZERO));
    let boundary = (0..half_edges.origin.len()).filter(|&h| half_edges.twin[h] == BOUNDARY);
    boundary
        .map(|h| half_edges.origin[h])
        .map(|vertex| {
            let p = positions[vertex as usize];
            let is_on_wall = p.cmpeq(DVec2::ZERO) | p.cmpeq(domain.size);
            (vertex, DVec2::select(is_on_wall, DVec2::ZERO, DVec2::ONE))
        })
        .filter(|&(_, free)| free != DVec2::ONE)
        .chain(fixed)
        .collect()
}
