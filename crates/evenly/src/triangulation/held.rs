//! What holds the points of a mesh with a boundary: rails along which they slide, lines that stay edges, and a spacing that varies.

use std::collections::HashSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

use glam::DVec2;

use super::half_edges::prev;
use super::planar::Planar;
use super::sizing::Sizing;

/// Where a point may go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Track {
    /// Anywhere inside.
    Free,
    /// Along a rail.
    Rail(u32),
    /// It stays.
    Fixed,
}

/// An edge that must be there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    /// Its points; on the boundary with the inside on their left.
    pub ends: [u32; 2],
    /// The rail on which it lies.
    pub rail: u32,
    /// Whether it lies inside, not on the boundary.
    pub is_line: bool,
}

/// The points' bonds, by point.
#[derive(Debug, Clone)]
pub(crate) struct Bonds {
    pub tracks: Vec<Track>,
    /// The two ends of each rail.
    pub rails: Vec<[DVec2; 2]>,
    /// The edges on the boundary and on lines.
    pub edges: Vec<Edge>,
    pub sizing: Arc<Sizing>,
    /// The triangle of the sizing in which each point is, or one nearby.
    pub hints: Vec<u32>,
}

impl Bonds {
    /// The ends of the edges on the boundary, and of those on lines.
    pub fn segments(&self) -> [Vec<[u32; 2]>; 2] {
        [false, true].map(|is_line| self.edges.iter().filter(|edge| edge.is_line == is_line).map(|edge| edge.ends).collect())
    }

    /// The part of a move that a point can make.
    pub fn along(&self, point: u32, by: DVec2) -> DVec2 {
        self.rail(point).map_or(by, |direction| direction * by.dot(direction))
    }

    /// The direction in which alone a point can move; zero for one that stays. `None` for one that moves freely.
    fn rail(&self, point: u32) -> Option<DVec2> {
        match self.tracks[point as usize] {
            Track::Free => None,
            Track::Rail(rail) => {
                let [from, to] = self.rails[rail as usize];
                Some((to - from).normalize_or_zero())
            }
            Track::Fixed => Some(DVec2::ZERO),
        }
    }

    /// The place nearest to `q` where a point that is at `at` may stand.
    fn land(&self, point: u32, at: DVec2, q: DVec2) -> DVec2 {
        match self.tracks[point as usize] {
            Track::Free => q,
            Track::Rail(rail) => {
                let [from, to] = self.rails[rail as usize];
                let way = to - from;
                from + way * ((q - from).dot(way) / way.length_squared()).clamp(0.0, 1.0)
            }
            Track::Fixed => at,
        }
    }
}

/// The bonds of a mesh' vertices, and what each knows of its spacing.
pub(super) struct Held {
    pub bonds: Bonds,
    /// The point that each vertex stands for.
    pub source: Vec<u32>,
    /// The edges that stay, as pairs of vertices, the smaller first.
    lines: HashSet<[u32; 2]>,
    /// How often the cell of a vertex must be taken to go all around it: a corner has only part of one.
    fullness: Vec<f64>,
    sizes: Vec<AtomicU64>,
    /// The median of the spacings at first.
    pub typical_size: f64,
    /// The triangle of the sizing in which each vertex was last.
    hints: Vec<AtomicU32>,
}

impl Held {
    pub fn new(bonds: Bonds, planar: &Planar) -> Self {
        let Planar { positions, source, lines, .. } = planar;
        let mut held = Self {
            typical_size: 0.0,
            fullness: fullness(&bonds, planar),
            sizes: positions.iter().map(|_| AtomicU64::new(0)).collect(),
            hints: source.iter().map(|&point| AtomicU32::new(bonds.hints[point as usize])).collect(),
            source: source.clone(),
            lines: lines.clone(),
            bonds,
        };
        (0..).zip(positions).for_each(|(v, &p)| held.arrive(v, p));
        let mut sizes: Vec<f64> = (0..positions.len() as u32).map(|v| held.size(v)).collect();
        let middle = sizes.len() / 2;
        if middle > 0 {
            held.typical_size = *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
        }
        held
    }

    /// The bonds as they are now, for points in the same order.
    pub fn bonds(&self) -> Bonds {
        let mut bonds = self.bonds.clone();
        for (&point, hint) in self.source.iter().zip(&self.hints) {
            bonds.hints[point as usize] = hint.load(Relaxed);
        }
        bonds
    }

    /// The part of a move that a vertex can make.
    pub fn along(&self, v: u32, by: DVec2) -> DVec2 {
        self.bonds.along(self.source[v as usize], by)
    }

    /// The place nearest to `q` where a vertex that is at `at` may stand.
    pub fn land(&self, v: u32, at: DVec2, q: DVec2) -> DVec2 {
        self.bonds.land(self.source[v as usize], at, q)
    }

    /// The direction in which alone a vertex can move; zero for one that stays. `None` for one that moves freely.
    pub fn rail(&self, v: u32) -> Option<DVec2> {
        self.bonds.rail(self.source[v as usize])
    }

    pub fn is_on_rail(&self, v: u32) -> bool {
        matches!(self.bonds.tracks[self.source[v as usize] as usize], Track::Rail(_))
    }

    /// How often the cell of a vertex must be taken to go all around it.
    pub fn fullness(&self, v: u32) -> f64 {
        self.fullness[v as usize]
    }

    /// Whether the edge between two vertices must stay.
    pub fn is_line(&self, a: u32, b: u32) -> bool {
        !self.lines.is_empty() && self.lines.contains(&[a.min(b), a.max(b)])
    }

    /// The wanted spacing at a vertex.
    #[inline]
    pub fn size(&self, v: u32) -> f64 {
        f64::from_bits(self.sizes[v as usize].load(Relaxed))
    }

    /// Says that a vertex has come to `p`.
    pub fn arrive(&self, v: u32, p: DVec2) {
        let hint = &self.hints[v as usize];
        let mut at = hint.load(Relaxed);
        let size = self.bonds.sizing.at(p, &mut at);
        hint.store(at, Relaxed);
        self.sizes[v as usize].store(size.to_bits(), Relaxed);
    }
}

/// For corners of the boundary half a turn over their angle, as stars there show all twice; 1 for the others.
fn fullness(bonds: &Bonds, planar: &Planar) -> Vec<f64> {
    let Planar { half_edges, positions, source, .. } = planar;
    let is_corner = |v: u32| bonds.tracks[source[v as usize] as usize] == Track::Fixed;
    let mut angles = vec![0.0; positions.len()];
    let mut is_on_boundary = vec![false; positions.len()];
    for h in 0..half_edges.origin.len() as u32 {
        let v = half_edges.origin[h as usize];
        if is_corner(v) {
            let [u, w] =
                [half_edges.target(h), half_edges.origin[prev(h) as usize]].map(|other| positions[other as usize] - positions[v as usize]);
            angles[v as usize] += u.angle_to(w);
            is_on_boundary[v as usize] |= half_edges.is_boundary(h);
        }
    }
    let all = angles.into_iter().zip(is_on_boundary);
    all.map(|(angle, is_on_boundary)| if is_on_boundary { std::f64::consts::PI / angle } else { 1.0 }).collect()
}
