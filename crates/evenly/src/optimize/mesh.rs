//! The mesh that Procrustes analysis works on: its three steps, chunk by chunk along the Hilbert curve.
//!
//! For a triangle with spokes u and v from its first corner, A = -(3/2) c + (sqrt(3)/2) J (v - u), with c = (u + v) / 3 and J the quarter
//! turn, is the first Fourier coefficient of its centred corners. The model triangle of side d fits best when it is
//! turned to A, and the energy is E = (2/3) (|A| - (sqrt(3)/2) d)^2 + d^2 / 2 - (4/sqrt(3)) area. |A| is kept for every triangle.

use glam::DVec2;
use rayon::prelude::*;

use crate::Error;
use crate::space::Domain;
use crate::triangulation::{BORDER, Chunks, HalfEdges, Triangulation, cover, next, prev};

/// sqrt(3) / 2.
const H: f64 = 0.866_025_403_784_438_6;

/// What a vertex's triangles ask of it: the sum of the ways to its targets, and how many there are.
#[derive(Clone, Copy, Default)]
struct Pull {
    sum: DVec2,
    n_targets: f64,
}

pub(super) struct Mesh {
    triangulation: Triangulation,
    chunks: Chunks,
    side: f64,
    /// The last move of each vertex: exact, so that it can be undone.
    velocity: Vec<DVec2>,
    pulls: Vec<Pull>,
    /// |A| of each triangle.
    amplitude: Vec<f64>,
    /// Vertices that slide along an axis (1 where they may move) or stay.
    sliders: Vec<(u32, DVec2)>,
    /// Each chunk's pulls on vertices of other chunks.
    strays: Vec<Vec<(u32, DVec2)>>,
    /// Each chunk's edges for the serial pass, or its inverted triangles.
    leftovers: Vec<Vec<u32>>,
}

impl Mesh {
    pub fn new(triangulation: Triangulation, side: f64) -> Self {
        let n_vertices = triangulation.positions.len();
        let chunks = Chunks::new(&triangulation.half_edges, n_vertices);
        let mut mesh = Self {
            side,
            velocity: vec![DVec2::ZERO; n_vertices],
            pulls: vec![Pull::default(); n_vertices],
            amplitude: vec![0.0; triangulation.half_edges.n_triangles()],
            sliders: sliders(&triangulation),
            strays: vec![Vec::new(); chunks.n_chunks()],
            leftovers: vec![Vec::new(); chunks.n_chunks()],
            triangulation,
            chunks,
        };
        mesh.measure_triangles();
        mesh
    }

    pub fn area(&self) -> f64 {
        self.triangulation.domain.area()
    }

    /// Step 1: fits the model triangle to each triangle and gathers the ways to the targets. Returns the energy.
    pub fn match_triangles(&mut self) -> f64 {
        let Triangulation { half_edges, positions, domain, .. } = &self.triangulation;
        let (side, amplitude) = (self.side, &self.amplitude);
        let energies: Vec<f64> = (self.chunks.vertices(), self.chunks.triangles())
            .into_par_iter()
            .zip(self.chunks.split_vertices(&mut self.pulls, 1))
            .zip(&mut self.strays)
            .map(|(((vertices, triangles), pulls), strays)| {
                pulls.fill(Pull::default());
                strays.clear();
                let first = vertices.start as u32;
                let mut energy = 0.0;
                let corners = half_edges.origin[3 * triangles.start..3 * triangles.end].chunks_exact(3);
                for (t, &a) in corners.zip(&amplitude[triangles.clone()]) {
                    let at = |v: u32| positions[v as usize];
                    let u = domain.spoke(at(t[0]), at(t[1]));
                    let v = domain.spoke(at(t[0]), at(t[2]));
                    energy += triangle_energy(a, u.perp_dot(v), side);
                    for (&vertex, way) in t.iter().zip(ways_to_targets(u, v, a, side)) {
                        if let Some(pull) = pulls.get_mut(vertex.wrapping_sub(first) as usize) {
                            pull.sum += way;
                            pull.n_targets += 1.0;
                        } else {
                            strays.push((vertex, way));
                        }
                    }
                }
                energy
            })
            .collect();
        for &(vertex, way) in self.strays.iter().flatten() {
            let pull = &mut self.pulls[vertex as usize];
            pull.sum += way;
            pull.n_targets += 1.0;
        }
        self.unite_copies();
        energies.iter().sum()
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
        (self.chunks.split_vertices(positions, 1), self.chunks.split_vertices(&mut self.velocity, 1))
            .into_par_iter()
            .zip(self.chunks.vertices())
            .for_each(|((positions, velocities), range)| {
                for ((position, velocity), pull) in positions.iter_mut().zip(velocities).zip(&self.pulls[range.clone()]) {
                    let before = *position;
                    *position = domain.land(before + pull.sum / pull.n_targets.max(1.0) + momentum * *velocity);
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
        let mut inverted: Vec<u32> = self.leftovers.iter().flatten().copied().collect();
        let (n_base, n_vertices) = (self.triangulation.n_base(), self.triangulation.positions.len());
        let domain = self.triangulation.domain;
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

    /// Computes |A| of every triangle; `leftovers` then holds those that are turned over.
    fn measure_triangles(&mut self) {
        let Triangulation { half_edges, positions, domain, .. } = &self.triangulation;
        self.chunks.split_triangles(&mut self.amplitude, 1).into_par_iter().zip(self.chunks.triangles()).zip(&mut self.leftovers).for_each(
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

    /// Step 3: flips each edge where that lowers the energy and leaves both triangles turned the right way. Returns the number of flips.
    pub fn flip_edges(&mut self) -> usize {
        let Triangulation { half_edges, positions, domain, .. } = &mut self.triangulation;
        let rule = FlipRule { positions, domain, side: self.side };
        let patches = self.chunks.split_triangles(&mut half_edges.origin, 3).into_par_iter();
        let n_flips: usize = patches
            .zip(self.chunks.split_triangles(&mut half_edges.twin, 3))
            .zip(self.chunks.split_triangles(&mut self.amplitude, 1))
            .zip(self.chunks.triangles())
            .zip(&mut self.leftovers)
            .map(|((((origin, twin), amplitude), range), leftovers)| {
                leftovers.clear();
                rule.visit_all(&mut Patch { first: 3 * range.start as u32, origin, twin, amplitude }, leftovers)
            })
            .sum();
        // What reaches across chunks comes last, in order.
        let HalfEdges { origin, twin } = half_edges;
        let mut whole = Patch { first: 0, origin, twin, amplitude: &mut self.amplitude };
        let mut none_left = Vec::new();
        let crossing = self.leftovers.iter().flatten();
        let n_crossing = crossing.filter(|&&h| rule.visit(&mut whole, h, &mut none_left)).count();
        debug_assert_eq!(self.triangulation.check(), Ok(()));
        n_flips + n_crossing
    }

    /// Triangles that are turned over, counted afresh.
    pub fn n_inverted(&self) -> usize {
        let spokes = self.triangulation.half_edges.triangles().map(|t| self.triangulation.spokes(t));
        spokes.filter(|&(u, v)| !self.triangulation.domain.is_upright(u, v)).count()
    }

    /// The mesh with its triangulation built anew; its vertices keep their numbers and their momentum.
    pub fn rebuilt(self, rebuild: impl FnOnce(Triangulation) -> Result<Triangulation, Error>) -> Result<Self, Error> {
        let mut mesh = Self::new(rebuild(self.triangulation)?, self.side);
        mesh.velocity = self.velocity;
        Ok(mesh)
    }

    /// The caller's index and the position of each base vertex.
    pub fn into_positions(self, base_domain: &Domain) -> (Vec<u32>, Vec<DVec2>) {
        let Triangulation { mut positions, order, copies, .. } = self.triangulation;
        positions.truncate(order.len());
        if copies != [1, 1] {
            for p in &mut positions {
                *p = base_domain.land(*p - (*p / base_domain.size).floor() * base_domain.size);
            }
        }
        (order, positions)
    }
}

/// Border vertices of a rectangle, with the axes along which they may move.
fn sliders(triangulation: &Triangulation) -> Vec<(u32, DVec2)> {
    let Triangulation { half_edges, positions, domain, .. } = triangulation;
    let border = (0..half_edges.origin.len()).filter(|&h| half_edges.twin[h] == BORDER);
    border
        .map(|h| half_edges.origin[h])
        .map(|vertex| {
            let p = positions[vertex as usize];
            let is_on_wall = p.cmpeq(DVec2::ZERO) | p.cmpeq(domain.size);
            (vertex, DVec2::select(is_on_wall, DVec2::ZERO, DVec2::ONE))
        })
        .filter(|&(_, free)| free != DVec2::ONE)
        .collect()
}

/// |A|, from the triangle's spokes.
#[inline]
fn amplitude(u: DVec2, v: DVec2) -> f64 {
    let edges = u.length_squared() + v.length_squared() + (v - u).length_squared();
    (0.5 * edges + 2.0 * H * u.perp_dot(v)).max(0.0).sqrt()
}

/// E(T) of equation (3), from |A| and twice the signed area.
#[inline]
fn triangle_energy(amplitude: f64, twice_area: f64, side: f64) -> f64 {
    let excess = amplitude - H * side;
    excess * excess / 1.5 + 0.5 * side * side - twice_area / H
}

/// The ways from the corners to the targets of equation (1).
#[inline]
fn ways_to_targets(u: DVec2, v: DVec2, amplitude: f64, side: f64) -> [DVec2; 3] {
    let (centre, edge) = ((u + v) / 3.0, v - u);
    let a = -1.5 * centre + H * edge.perp();
    // An inverted equilateral triangle has no best rotation: any will do.
    let radius = side / (2.0 * H);
    let model = if amplitude > 0.0 { a * (radius / amplitude) } else { DVec2::new(radius, 0.0) };
    let (half, turned) = (-0.5 * model, H * model.perp());
    [centre + model, centre + half + turned - u, centre + half - turned - v]
}

/// The half-edges of a range of triangles.
struct Patch<'a> {
    first: u32,
    origin: &'a mut [u32],
    twin: &'a mut [u32],
    amplitude: &'a mut [f64],
}

impl Patch<'_> {
    #[inline]
    fn local(&self, h: u32) -> Option<usize> {
        let local = h.wrapping_sub(self.first) as usize;
        (local < self.origin.len()).then_some(local)
    }
}

struct FlipRule<'a> {
    positions: &'a [DVec2],
    domain: &'a Domain,
    side: f64,
}

impl FlipRule<'_> {
    /// Visits each edge of a patch once. Edges, and wanted flips, that reach out of it go to `leftovers`.
    ///
    /// Block by block the edges are listed and sifted without a branch, since nearly all of them stay.
    fn visit_all(&self, patch: &mut Patch, leftovers: &mut Vec<u32>) -> usize {
        const BLOCK: usize = 1 << 10;
        let mut listed = [0; BLOCK + 1];
        let (first, end) = (patch.first, patch.first + patch.origin.len() as u32);
        let mut n_flips = 0;
        for start in (first..end).step_by(BLOCK) {
            let mut n_listed = 0;
            for h in start..end.min(start + BLOCK as u32) {
                listed[n_listed] = h;
                // An edge is visited from its smaller half; BORDER wraps to 0.
                n_listed += usize::from(patch.twin[(h - first) as usize].wrapping_add(1) > h);
            }
            let mut n_left = 0;
            for i in 0..n_listed {
                let h = listed[i];
                listed[n_left] = h;
                n_left += usize::from(self.may_pay(patch, h, leftovers));
            }
            n_flips += listed[..n_left].iter().filter(|&&h| self.visit(patch, h, leftovers)).count();
        }
        n_flips
    }

    /// Whether flipping the edge of `h` could lower the energy, by a bound that needs no root: most edges are settled here.
    ///
    /// The areas' sum stays, so the energy falls with the sum of (|A| - c)^2, c = (sqrt(3)/2) d. The sum of |A|^2 changes by the
    /// diagonals' squares, and by Cauchy-Schwarz the sum of |A| is at most the root of twice that.
    #[inline]
    fn may_pay(&self, patch: &Patch, h: u32, leftovers: &mut Vec<u32>) -> bool {
        let i = (h - patch.first) as usize;
        let Some(j) = patch.local(patch.twin[i]) else {
            leftovers.push(h);
            return false;
        };
        let at = |i: usize| self.positions[patch.origin[i] as usize];
        let kept = self.domain.spoke(at(i), at(j)).length_squared();
        let other = self.domain.spoke(at(prev(i as u32) as usize), at(prev(j as u32) as usize)).length_squared();
        let (a, b) = (patch.amplitude[i / 3], patch.amplitude[j / 3]);
        let c = H * self.side;
        let squares = a * a + b * b + other - kept;
        let needed = other - kept + 2.0 * c * (a + b);
        needed < 0.0 || needed * needed < 8.0 * c * c * squares
    }

    /// Flips the edge of half-edge `h` if that pays, or hands it on where it reaches out of the patch.
    fn visit(&self, patch: &mut Patch, h: u32, leftovers: &mut Vec<u32>) -> bool {
        let i = (h - patch.first) as usize;
        let t = patch.twin[i];
        if t == BORDER {
            return false;
        }
        let Some(j) = patch.local(t) else {
            leftovers.push(h);
            return false;
        };
        let (hn, hp, tp) = (next(h) - patch.first, prev(h) - patch.first, prev(t) - patch.first);
        let [p, q, r, s] = [patch.origin[i], patch.origin[hn as usize], patch.origin[hp as usize], patch.origin[tp as usize]];
        let amplitudes = [patch.amplitude[i / 3], patch.amplitude[j / 3]];
        let Some(flipped) = self.flipped_amplitudes([p, q, r, s], amplitudes) else { return false };
        let (across_h, across_t) = (patch.twin[tp as usize], patch.twin[hp as usize]);
        let neighbours = [across_h, across_t].map(|n| if n == BORDER { Some(i) } else { patch.local(n) });
        let [Some(n_h), Some(n_t)] = neighbours else {
            leftovers.push(h);
            return false;
        };
        // (p q r) and (q p s) become (s q r) and (r p s).
        patch.origin[i] = s;
        patch.origin[j] = r;
        patch.twin[hp as usize] = tp + patch.first;
        patch.twin[tp as usize] = hp + patch.first;
        patch.twin[i] = across_h;
        patch.twin[j] = across_t;
        if across_h != BORDER {
            patch.twin[n_h] = h;
        }
        if across_t != BORDER {
            patch.twin[n_t] = t;
        }
        [patch.amplitude[i / 3], patch.amplitude[j / 3]] = flipped;
        true
    }

    /// The new |A| of the triangles (s q r) and (r p s), if replacing (p q r) and (q p s) by them lowers the energy and turns none over.
    fn flipped_amplitudes(&self, [p, q, r, s]: [u32; 4], [a, b]: [f64; 2]) -> Option<[f64; 2]> {
        let at = |v: u32| self.positions[v as usize];
        let spoke = |v: u32| self.domain.spoke(at(p), at(v));
        let (pq, pr, ps) = (spoke(q), spoke(r), spoke(s));
        let c = H * self.side;
        let (sq, sr) = (pq - ps, pr - ps);
        let (new_a, new_b) = (amplitude(sq, sr), amplitude(ps, pr));
        let excess = |a: f64, b: f64| (a - c) * (a - c) + (b - c) * (b - c);
        let gain = excess(a, b) - excess(new_a, new_b);
        // A gain within rounding could be taken back and forth for ever.
        let pays = gain > 1e-12 * c * c;
        let stand = self.domain.is_upright(ps, pr) && self.domain.is_upright(sq, sr);
        (pays && stand).then_some([new_a, new_b])
    }
}
