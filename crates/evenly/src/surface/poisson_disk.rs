//! Maximal Poisson-disk sampling of a surface: no two points nearer than a spacing, and no room for another.
//!
//! Corsini, Cignoni and Scopigno, "Efficient and Flexible Sampling with Blue Noise Properties of Triangular Meshes", IEEE Transactions on Visualization and Computer
//! Graphics 18(6), 2012, doi 10.1109/TVCG.2012.34; Guo, Yan, Jia, Zhang, Peng and Wonka, "Efficient Triangulation of Poisson-disk Sampled Surfaces", Visual Computer 31,
//! 2015, for the division of what is not covered yet.
//!
//! Where sizes vary, so do the spacings of points, and two of them are as far apart as the smaller of theirs (Ebeida, Mitchell, Awad, Park, Swiler and Manocha's
//! "smaller-disk criterion"; Mitchell, Rand, Ebeida and Bajaj, "Variable Radii Poisson-Disk Sampling", 2012).
//!
//! A disk is what of the ball around its point hangs together with it along the surface, so that points on two sides of a thin part do not see each other.
//!
//! Cost: O(n) in the points times the triangles in a disk. What is left uncovered is smaller than a thousandth of the spacing.

use glam::DVec3;

use super::Surface;
use super::walk::{Place, nearest_in_triangle};
use crate::points::Random;
use crate::triangulation::BOUNDARY;

/// A piece smaller than this, in spacings, is settled by its middle.
const SMALLEST: f64 = 1e-3;
/// Darts a piece and a round.
const DARTS: f64 = 0.5;

/// A piece of a triangle in which a point may still have room, by the weights of its corners.
struct Piece {
    face: u32,
    corners: [[f64; 3]; 3],
}

impl Piece {
    fn inside(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| a * self.corners[0][k] + b * self.corners[1][k] + c * self.corners[2][k])
    }

    fn quarters(&self) -> [Self; 4] {
        let [a, b, c] = self.corners;
        let [ab, bc, ca] = [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]].map(|weights| self.inside(weights));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].map(|corners| Self { face: self.face, corners })
    }
}

/// Points on a surface with a spacing of the units inside, times the sizes at its vertices.
pub(crate) fn poisson_disk(surface: &Surface, sizes: &[f64], spacing: f64, seed: u64) -> Vec<Place> {
    let mut disks = Disks {
        surface,
        sizes,
        spacing,
        radii: Vec::new(),
        points: Vec::new(),
        near: vec![Vec::new(); surface.n_triangles()],
        seen: vec![u32::MAX; surface.n_triangles()],
    };
    let mut random = Random::new(seed, 0);
    let whole = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut pieces: Vec<Piece> = (0..surface.n_triangles() as u32).map(|face| Piece { face, corners: whole }).collect();
    while !pieces.is_empty() {
        // 1. Darts, by area.
        let mut sum = 0.0;
        let areas: Vec<f64> = { pieces.iter() }
            .map(|piece| {
                let [a, b, c] = piece.corners.map(|weights| Place::new(surface, piece.face, weights).at);
                sum += 0.5 * (b - a).cross(c - a).length();
                sum
            })
            .collect();
        let room = pieces.iter().zip(gaps(&areas)).map(|(piece, area)| area / (0.7 * disks.least(piece).powi(2))).sum::<f64>();
        let n_darts = (DARTS * pieces.len() as f64).max(room).ceil() as usize;
        for _ in 0..n_darts {
            let at = random.unit() * sum;
            let piece = &pieces[areas.partition_point(|&area| area <= at).min(pieces.len() - 1)];
            let (u, v) = (random.unit(), random.unit());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            disks.try_put(Place::new(surface, piece.face, piece.inside([1.0 - u - v, u, v])));
        }
        // 2. What is not covered is divided.
        let mut left = Vec::new();
        for piece in pieces {
            let corners = piece.corners.map(|weights| Place::new(surface, piece.face, weights).at);
            if disks.cover(&piece, corners) {
                continue;
            }
            let size = corners[0].distance(corners[1]).max(corners[1].distance(corners[2])).max(corners[2].distance(corners[0]));
            if size < SMALLEST * disks.least(&piece) {
                disks.try_put(Place::new(surface, piece.face, piece.inside([1.0 / 3.0; 3])));
            } else {
                left.extend(piece.quarters().into_iter().filter(|quarter| {
                    let corners = quarter.corners.map(|weights| Place::new(surface, quarter.face, weights).at);
                    !disks.cover(quarter, corners)
                }));
            }
        }
        pieces = left;
    }
    disks.points
}

struct Disks<'a> {
    surface: &'a Surface,
    sizes: &'a [f64],
    spacing: f64,
    points: Vec<Place>,
    /// The spacing at each point.
    radii: Vec<f64>,
    /// For each triangle the points whose disks reach into it.
    near: Vec<Vec<u32>>,
    /// The last point whose disk was seen to reach into a triangle.
    seen: Vec<u32>,
}

/// The lengths of intervals that end at these.
fn gaps(ends: &[f64]) -> impl Iterator<Item = f64> {
    ends.iter().scan(0.0, |last, &end| Some(end - std::mem::replace(last, end)))
}

impl Disks<'_> {
    /// The spacing at a place of a triangle.
    fn spacing_at(&self, face: u32, weights: [f64; 3]) -> f64 {
        self.spacing * size_at(self.surface, self.sizes, face, weights)
    }

    /// The smallest spacing in a piece.
    fn least(&self, piece: &Piece) -> f64 {
        piece.corners.iter().map(|&weights| self.spacing_at(piece.face, weights)).fold(f64::INFINITY, f64::min)
    }

    fn try_put(&mut self, place: Place) {
        let own = self.spacing_at(place.face, place.weights);
        let is_far = |&other: &u32| {
            let least = own.min(self.radii[other as usize]);
            self.points[other as usize].at.distance_squared(place.at) >= least * least
        };
        if !self.near[place.face as usize].iter().all(is_far) {
            return;
        }
        let number = self.points.len() as u32;
        let mut stack = vec![place.face];
        self.seen[place.face as usize] = number;
        while let Some(face) = stack.pop() {
            self.near[face as usize].push(number);
            for h in 3 * face..3 * face + 3 {
                let twin = self.surface.half_edges.twin[h as usize];
                if twin == BOUNDARY || self.seen[twin as usize / 3] == number {
                    continue;
                }
                self.seen[twin as usize / 3] = number;
                let (nearest, _) = nearest_in_triangle(self.surface.corners(twin as usize / 3), place.at);
                if nearest.distance_squared(place.at) < own * own {
                    stack.push(twin / 3);
                }
            }
        }
        self.points.push(place);
        self.radii.push(own);
    }

    /// Whether one disk holds all of a piece.
    fn cover(&self, piece: &Piece, corners: [DVec3; 3]) -> bool {
        let least = self.least(piece);
        let holds = |&point: &u32| {
            let reach = least.min(self.radii[point as usize]);
            corners.iter().all(|corner| corner.distance_squared(self.points[point as usize].at) < reach * reach)
        };
        self.near[piece.face as usize].iter().any(holds)
    }
}

/// The size at a place of a triangle, linear between those at its corners.
fn size_at(surface: &Surface, sizes: &[f64], face: u32, weights: [f64; 3]) -> f64 {
    let corners = surface.half_edges.triangle(face as usize);
    (0..3).map(|k| weights[k] * sizes[corners[k] as usize]).sum()
}

/// Independent points, as many per area as the inverse square of the sizes at the surface's vertices wants.
pub(crate) fn white(surface: &Surface, sizes: &[f64], n_points: usize, seed: u64) -> Vec<Place> {
    let mut sum = 0.0;
    let least: Vec<f64> = surface
        .half_edges
        .triangles()
        .map(|corners| corners.map(|v| sizes[v as usize]).into_iter().fold(f64::INFINITY, f64::min))
        .collect();
    let masses: Vec<f64> = (0..surface.n_triangles())
        .map(|t| {
            let [a, b, c] = surface.corners(t);
            sum += 0.5 * (b - a).cross(c - a).length() / (least[t] * least[t]);
            sum
        })
        .collect();
    let mut random = Random::new(seed, 0);
    let mut place = |_| loop {
        let at = random.unit() * sum;
        let face = masses.partition_point(|&mass| mass <= at).min(masses.len() - 1) as u32;
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        let weights = [1.0 - u - v, u, v];
        let share = least[face as usize] / size_at(surface, sizes, face, weights);
        if share >= 1.0 || random.unit() < share * share {
            return Place::new(surface, face, weights);
        }
    };
    (0..n_points).map(&mut place).collect()
}
