//! Cells that the walls of a bounded domain clip: a wall acts as the vertex' own mirror image behind it would.

use glam::DVec2;

use super::spoke::{MIRROR, Spoke};
use crate::space::GRID;
use crate::star::{Star, Wedge};

/// A cell clipped by walls, everything relative to its vertex: a polygon, counter-clockwise.
#[derive(Default)]
pub(crate) struct WallCell {
    pub(super) sides: Vec<Side>,
    clipped: Vec<Side>,
}

/// A side of the cell, and the corner with which it begins.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub corner: DVec2,
    /// On whose bisector it lies, and the way there; never zero, also where the vertex is on a wall.
    pub vertex: u32,
    pub way: DVec2,
    /// The unit vector there.
    pub direction: DVec2,
}

impl WallCell {
    /// Cuts the cell of a vertex at `at` out of the domain [0, size], by the bisectors with its neighbours.
    pub fn clip(&mut self, at: DVec2, size: DVec2, neighbours: impl Iterator<Item = (u32, DVec2)>) {
        self.begin(at, size);
        for (vertex, way) in neighbours {
            self.cut(vertex, way);
        }
    }

    /// Makes the cell all of the domain [0, size].
    pub fn begin(&mut self, at: DVec2, size: DVec2) {
        self.begin_in(-at, size - at);
    }

    /// Makes the cell a box around the vertex, given relative to it.
    pub fn begin_in(&mut self, low: DVec2, high: DVec2) {
        let wall = |corner: DVec2, direction: DVec2, distance: f64| Side {
            corner,
            vertex: MIRROR,
            way: 2.0 * distance.max(GRID) * direction,
            direction,
        };
        self.sides.clear();
        self.sides.extend([
            wall(low, DVec2::NEG_Y, -low.y),
            wall(DVec2::new(high.x, low.y), DVec2::X, high.x),
            wall(high, DVec2::Y, high.y),
            wall(DVec2::new(low.x, high.y), DVec2::NEG_X, -low.x),
        ]);
    }

    /// Whether some of the cell is nearer to a neighbour.
    pub fn is_cut_by(&self, way: DVec2) -> bool {
        let half = 0.5 * way.length_squared();
        self.sides.iter().any(|side| side.corner.dot(way) > half)
    }

    /// Cuts off what is nearer to a neighbour.
    pub fn cut(&mut self, vertex: u32, way: DVec2) {
        let half = 0.5 * way.length_squared();
        let excess = |corner: DVec2| corner.dot(way) - half;
        self.clipped.clear();
        for (k, &side) in self.sides.iter().enumerate() {
            let to = self.sides[(k + 1) % self.sides.len()].corner;
            let (at_start, at_end) = (excess(side.corner), excess(to));
            let crossing = || side.corner + (to - side.corner) * (at_start / (at_start - at_end));
            if at_start <= 0.0 {
                self.clipped.push(side);
                if at_end > 0.0 {
                    // The cell goes on along the bisector.
                    self.clipped.push(Side { corner: crossing(), vertex, way, direction: way.normalize() });
                }
            } else if at_end < 0.0 {
                self.clipped.push(Side { corner: crossing(), ..side });
            }
        }
        std::mem::swap(&mut self.sides, &mut self.clipped);
    }

    /// The cell as a star, lengths multiplied by `scale`.
    pub fn fill(&self, star: &mut Star, spokes: &mut Vec<Spoke>, scale: f64) {
        star.clear();
        spokes.clear();
        for (k, side) in self.sides.iter().enumerate() {
            let after = self.sides[(k + 1) % self.sides.len()].direction;
            let length = side.way.length() * scale;
            star.lengths.push(length);
            star.is_mirror.push(side.vertex == MIRROR);
            let sin = side.direction.perp_dot(after);
            star.wedges.push(Wedge { cos: side.direction.dot(after), sin, cosecant: 1.0 / sin });
            spokes.push(Spoke { vertex: side.vertex, way: side.way, length, ..Spoke::default() });
        }
    }
}
