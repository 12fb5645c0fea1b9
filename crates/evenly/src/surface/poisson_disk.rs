//! Maximal Poisson-disk sampling of a surface: no two points nearer than a spacing, and no room for another.
//!
//! Corsini, Cignoni and Scopigno, "Efficient and Flexible Sampling with Blue Noise Properties of Triangular Meshes", IEEE Transactions on Visualization and Computer
//! Graphics 18(6), 2012, doi 10.1109/TVCG.2012.34; Guo, Yan, Jia, Zhang, Peng and Wonka, "Efficient Triangulation of Poisson-disk Sampled Surfaces", Visual Computer 31,
//! 2015, for the division of what is not covered yet.
//!
//! A disk is what of the ball around its point hangs together with it along the surface, so that points on two sides of a thin part do not see each other.
//!
//! Cost: O(n) in the points times the triangles in a disk. What is left uncovered is smaller than a thousandth of the spacing.

use glam::DVec3;

use super::Surface;
use super::walk::{Place, nearest_in_triangle};
use crate::points::Random;
use crate::triangulation::BORDER;

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

/// Points on a surface with a spacing of the units inside.
pub(crate) fn poisson_disk(surface: &Surface, spacing: f64, seed: u64) -> Vec<Place> {
    let mut disks = Disks {
        surface,
        spacing,
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
        let room = sum / (0.7 * spacing * spacing);
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
            if disks.cover(piece.face, corners) {
                continue;
            }
            let size = corners[0].distance(corners[1]).max(corners[1].distance(corners[2])).max(corners[2].distance(corners[0]));
            if size < SMALLEST * spacing {
                disks.try_put(Place::new(surface, piece.face, piece.inside([1.0 / 3.0; 3])));
            } else {
                left.extend(piece.quarters().into_iter().filter(|quarter| {
                    let corners = quarter.corners.map(|weights| Place::new(surface, quarter.face, weights).at);
                    !disks.cover(quarter.face, corners)
                }));
            }
        }
        pieces = left;
    }
    disks.points
}

struct Disks<'a> {
    surface: &'a Surface,
    spacing: f64,
    points: Vec<Place>,
    /// For each triangle the points whose disks reach into it.
    near: Vec<Vec<u32>>,
    /// The last point whose disk was seen to reach into a triangle.
    seen: Vec<u32>,
}

impl Disks<'_> {
    fn try_put(&mut self, place: Place) {
        let is_far = |&other: &u32| self.points[other as usize].at.distance_squared(place.at) >= self.spacing * self.spacing;
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
                if twin == BORDER || self.seen[twin as usize / 3] == number {
                    continue;
                }
                self.seen[twin as usize / 3] = number;
                let (nearest, _) = nearest_in_triangle(self.surface.corners(twin as usize / 3), place.at);
                if nearest.distance_squared(place.at) < self.spacing * self.spacing {
                    stack.push(twin / 3);
                }
            }
        }
        self.points.push(place);
    }

    /// Whether one disk holds all of a piece.
    fn cover(&self, face: u32, corners: [DVec3; 3]) -> bool {
        let holds = |&point: &u32| {
            corners.iter().all(|corner| corner.distance_squared(self.points[point as usize].at) < self.spacing * self.spacing)
        };
        self.near[face as usize].iter().any(holds)
    }
}

/// Independent uniform points.
pub(crate) fn white(surface: &Surface, n_points: usize, seed: u64) -> Vec<Place> {
    let mut sum = 0.0;
    let areas: Vec<f64> = (0..surface.n_triangles())
        .map(|t| {
            let [a, b, c] = surface.corners(t);
            sum += 0.5 * (b - a).cross(c - a).length();
            sum
        })
        .collect();
    let mut random = Random::new(seed, 0);
    let place = |_| {
        let at = random.unit() * sum;
        let face = areas.partition_point(|&area| area <= at).min(areas.len() - 1) as u32;
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        Place::new(surface, face, [1.0 - u - v, u, v])
    };
    (0..n_points).map(place).collect()
}
