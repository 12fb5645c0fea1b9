//! The ratio of a cell's outradius to the distance of the nearest other point, wherever its point may be put.

use glam::DVec2;

use crate::star::{Star, Wall};
use crate::triangulation::circumcentre;

/// Corners that a cell may have. One with more counts as none: a point that has it stays where it is until its neighbours have moved.
const MOST: usize = 16;
/// Half the side of the square that cells are cut out of, in spacings.
const FAR: f64 = 64.0;

/// The ratio r_c / r_f of the cell that the star's vertex would have at `at` (the paper's local beta), in wanted lengths where these vary; infinite where it would have none.
pub(super) fn local_ratio(star: &Star, at: DVec2) -> f64 {
    if star.walls.iter().any(|wall| wall.normal.dot(at) > wall.distance) {
        return f64::INFINITY;
    }
    ratio_with_ring(star, at).unwrap_or_else(|| ratio_of_cut_cell(star, at))
}

/// The ratio, if the neighbours at `at` are still those of the ring: then the cell's corners are the circumcentres in between.
fn ratio_with_ring(star: &Star, at: DVec2) -> Option<f64> {
    let n = star.ring.len();
    if n > MOST {
        return None;
    }
    let mut corners = [DVec2::ZERO; MOST];
    let mut before = *star.ring.last()? - at;
    let (mut nearest, mut farthest, mut is_around) = (f64::INFINITY, 0f64, true);
    for (corner, &place) in corners.iter_mut().zip(&star.ring) {
        let way = place - at;
        *corner = circumcentre(before, way);
        is_around &= before.perp_dot(way) > 0.0;
        nearest = nearest.min(way.length_squared());
        farthest = farthest.max(corner.length_squared());
        before = way;
    }
    // Each side of the cell must lead on around it.
    for (k, &place) in star.ring.iter().enumerate() {
        let after = if k + 1 == n { 0 } else { k + 1 };
        is_around &= (place - at).perp_dot(corners[after] - corners[k]) >= 0.0;
    }
    if !is_around || star.walls.iter().any(|wall| (wall.distance - wall.normal.dot(at)).powi(2) < farthest) {
        return None;
    }
    for &place in &star.beyond {
        let way = place - at;
        let squared = way.length_squared();
        if squared < 4.0 * farthest && corners[..n].iter().any(|corner| 2.0 * corner.dot(way) > squared) {
            return None;
        }
    }
    Some(if star.slope == DVec2::ZERO { (farthest / nearest).sqrt() } else { sized_ratio(star, at, star.ring.iter(), &corners[..n]) })
}

/// Lengths that are extrapolated are no less than this part of the vertex' own.
const LEAST_SIZE: f64 = 0.2;

/// The ratio with both radii in the lengths that are wanted where they are: the one at the cell's corners, the other halfway to the places around.
fn sized_ratio<'a>(star: &Star, at: DVec2, places: impl Iterator<Item = &'a DVec2>, corners: &[DVec2]) -> f64 {
    let size = |place: DVec2| (1.0 + star.slope.dot(place)).max(LEAST_SIZE);
    let farthest = corners.iter().map(|&corner| corner.length() / size(at + corner)).fold(0.0, f64::max);
    let nearest = places.map(|&place| place.distance(at) / size(0.5 * (at + place))).fold(f64::INFINITY, f64::min);
    farthest / nearest
}

/// The ratio of the cell that all places around, and the walls, cut out of the plane.
fn ratio_of_cut_cell(star: &Star, at: DVec2) -> f64 {
    let mut cell = Cell::square();
    for &Wall { normal, distance } in &star.walls {
        cell.cut(normal, distance - normal.dot(at));
    }
    let mut nearest = f64::INFINITY;
    for &place in star.ring.iter().chain(&star.beyond) {
        let way = place - at;
        let squared = way.length_squared();
        nearest = nearest.min(squared);
        // What is twice as far as the farthest corner cuts nothing off.
        if squared < 4.0 * cell.farthest {
            cell.cut(way, 0.5 * squared);
        }
    }
    match () {
        () if cell.n == 0 || nearest == 0.0 => f64::INFINITY,
        () if star.slope == DVec2::ZERO => (cell.farthest / nearest).sqrt(),
        () => sized_ratio(star, at, star.ring.iter().chain(&star.beyond), cell.corners()),
    }
}

/// A convex polygon, counter-clockwise, around the origin.
struct Cell {
    /// The corners, and room for those of the next cut.
    corners: [[DVec2; MOST]; 2],
    /// Which of the two it is.
    now: usize,
    n: usize,
    /// The squared distance of the farthest corner.
    farthest: f64,
}

impl Cell {
    fn square() -> Self {
        let mut corners = [[DVec2::ZERO; MOST]; 2];
        for (corner, (x, y)) in corners[0].iter_mut().zip([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]) {
            *corner = FAR * DVec2::new(x, y);
        }
        Self { corners, now: 0, n: 4, farthest: 2.0 * FAR * FAR }
    }

    fn corners(&self) -> &[DVec2] {
        &self.corners[self.now][..self.n]
    }

    /// Cuts off the places p with p . normal > most.
    fn cut(&mut self, normal: DVec2, most: f64) {
        let [first, second] = &mut self.corners;
        let (from, to) = if self.now == 0 { (&first[..self.n], second) } else { (&second[..self.n], first) };
        let Some(&last) = from.last() else { return };
        let excess = |corner: DVec2| corner.dot(normal) - most;
        let (mut n, mut farthest, mut is_cut) = (0, 0f64, false);
        let mut push = |corner: DVec2| {
            if n < MOST {
                to[n] = corner;
            }
            n += 1;
            farthest = farthest.max(corner.length_squared());
        };
        let (mut before, mut excess_before) = (last, excess(last));
        for &corner in from {
            let excess = excess(corner);
            if (excess > 0.0) != (excess_before > 0.0) {
                push(before + (corner - before) * (excess_before / (excess_before - excess)));
            }
            if excess <= 0.0 {
                push(corner);
            } else {
                is_cut = true;
            }
            (before, excess_before) = (corner, excess);
        }
        if is_cut {
            (self.n, self.farthest, self.now) = (if n > MOST { 0 } else { n }, farthest, 1 - self.now);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Random;

    fn hexagon() -> Star {
        let around =
            |length: f64, turn: f64| (0..6).map(move |k| length * DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_3 + turn));
        Star {
            ring: around(1.0, 0.0).collect(),
            beyond: around(3f64.sqrt(), std::f64::consts::FRAC_PI_6).chain(around(2.0, 0.0)).collect(),
            ..Star::default()
        }
    }

    #[test]
    fn the_hexagonal_lattice_has_the_least_ratio() {
        let star = hexagon();
        let least = local_ratio(&star, DVec2::ZERO);
        assert!((least - 1.0 / 3f64.sqrt()).abs() < 1e-14);
        for k in 0..8 {
            assert!(local_ratio(&star, 0.1 * DVec2::from_angle(f64::from(k))) > least);
        }
    }

    #[test]
    fn both_ways_to_a_cell_agree() {
        let (mut random, mut n_with_ring) = (Random::new(3, 0), 0);
        for _ in 0..2000 {
            let mut star = hexagon();
            for place in star.ring.iter_mut().chain(&mut star.beyond) {
                *place += 0.2 * DVec2::new(random.signed(), random.signed());
            }
            let at = 0.4 * DVec2::new(random.signed(), random.signed());
            if let Some(ratio) = ratio_with_ring(&star, at) {
                n_with_ring += 1;
                assert!((ratio / ratio_of_cut_cell(&star, at) - 1.0).abs() < 1e-12);
            }
        }
        assert!((500..2000).contains(&n_with_ring), "{n_with_ring}");
    }

    #[test]
    fn walls_end_cells() {
        let walls = [(DVec2::NEG_X, 0.5), (DVec2::X, 9.0), (DVec2::Y, 0.5), (DVec2::NEG_Y, 0.5)];
        let walls = walls.map(|(normal, distance)| Wall { normal, distance }).to_vec();
        let star = Star { ring: vec![DVec2::new(1.0, 0.0)], walls, ..Star::default() };
        assert!((local_ratio(&star, DVec2::ZERO) - 0.5f64.sqrt()).abs() < 1e-13);
        assert_eq!(local_ratio(&star, DVec2::new(1.0, 0.0)), f64::INFINITY);
        // Outside there is no cell.
        assert_eq!(local_ratio(&star, DVec2::new(-0.6, 0.0)), f64::INFINITY);
    }
}
