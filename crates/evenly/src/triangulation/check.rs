//! Proofs: what a triangulation claims to be, verified from scratch with exact predicates.

use std::collections::HashMap;

use super::half_edges::BOUNDARY;
use super::mesh::Triangulation;
use crate::predicates::is_left_turn;

impl Triangulation {
    /// Proves that the torus, or the points' convex hull, is triangulated: twins, orientation, Euler's formula, and on a torus that the
    /// areas sum to the domain's, elsewhere that the boundary is one convex ring.
    pub fn check(&self) -> Result<(), String> {
        self.check_twins()?;
        self.check_orientation()?;
        self.check_euler()?;
        self.check_hull()
    }

    /// Proves that what a boundary encloses is triangulated, as long as the boundary does not cross itself: twins and orientation.
    pub fn check_bounded(&self) -> Result<(), String> {
        self.check_twins()?;
        self.check_orientation()
    }

    /// Proves [`Self::check`] and the Delaunay property: no vertex opposite an edge lies inside its circumcircle.
    pub fn check_delaunay(&self) -> Result<(), String> {
        self.check()?;
        match (0..self.half_edges.origin.len() as u32).find(|&h| self.is_illegal(h)) {
            Some(h) => Err(format!("the vertex across half-edge {h} lies in its triangle's circumcircle")),
            None => Ok(()),
        }
    }

    fn check_twins(&self) -> Result<(), String> {
        let mesh = &self.half_edges;
        for h in 0..mesh.origin.len() as u32 {
            let t = mesh.twin[h as usize];
            if t == BOUNDARY && !self.domain.is_periodic {
                continue;
            }
            let is_pair = mesh.twin.get(t as usize) == Some(&h)
                && mesh.origin[h as usize] == mesh.target(t)
                && mesh.origin[t as usize] == mesh.target(h);
            if !is_pair {
                return Err(format!("half-edges {h} and {t} are no twins"));
            }
        }
        Ok(())
    }

    fn check_orientation(&self) -> Result<(), String> {
        let mut area = 0.0;
        for (t, corners) in self.half_edges.triangles().enumerate() {
            let (u, v) = self.spokes(corners);
            if !self.domain.is_upright(u, v) {
                return Err(format!("triangle {t}, {corners:?}, is turned over"));
            }
            area += 0.5 * u.perp_dot(v);
        }
        let domain = self.domain.area();
        if self.domain.is_periodic && (area - domain).abs() > 1e-9 * domain {
            return Err(format!("the triangles cover {area} of {domain}"));
        }
        Ok(())
    }

    /// An upright disc whose boundary turns to the left all the way, or runs straight on, is its own convex hull.
    fn check_hull(&self) -> Result<(), String> {
        let mesh = &self.half_edges;
        let boundary: Vec<u32> = (0..mesh.origin.len() as u32).filter(|&h| mesh.is_boundary(h)).collect();
        let leaving: HashMap<u32, u32> = boundary.iter().map(|&h| (mesh.origin[h as usize], h)).collect();
        let Some(&start) = boundary.first().filter(|_| !self.domain.is_periodic) else { return Ok(()) };
        let (mut h, mut n_seen) = (start, 0);
        loop {
            n_seen += 1;
            let Some(&after) = leaving.get(&mesh.target(h)) else { return Err(format!("the boundary ends after half-edge {h}")) };
            let [a, b, c] = [mesh.origin[h as usize], mesh.target(h), mesh.target(after)].map(|v| self.positions[v as usize]);
            let is_right_turn = is_left_turn(c - b, b - a);
            if is_right_turn || (b - a).dot(c - b) < 0.0 && !is_left_turn(b - a, c - b) {
                return Err(format!("the boundary is not convex after half-edge {h}"));
            }
            h = after;
            if h == start || n_seen > boundary.len() {
                break;
            }
        }
        if n_seen != boundary.len() {
            return Err("the boundary is more than one ring".into());
        }
        Ok(())
    }

    fn check_euler(&self) -> Result<(), String> {
        let n_vertices = self.positions.len() as i64;
        let n_triangles = self.half_edges.n_triangles() as i64;
        let n_boundary = self.half_edges.twin.iter().filter(|&&t| t == BOUNDARY).count() as i64;
        let n_edges = (3 * n_triangles + n_boundary) / 2;
        let expected = if self.domain.is_periodic { 0 } else { 1 };
        let euler = n_vertices - n_edges + n_triangles;
        if euler != expected {
            return Err(format!("V - E + F is {euler}, not {expected}"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use proptest::prelude::*;

    use super::super::delaunay::delaunay;
    use super::super::patch::Patch;
    use super::*;
    use crate::error::Error;
    use crate::points::{hilbert_order, separate};
    use crate::space::GRID;
    use crate::{PointSet, Rectangle, Space, Torus, jittered, white};

    const SPACES: fn() -> [Space; 4] = || {
        [
            Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(),
            Torus::new([-3.0, 7.0], [100.0, 1.0]).unwrap().into(),
            Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(),
            Rectangle::new([1e6, 0.0], [0.5, 50.0]).unwrap().into(),
        ]
    };

    fn sorted(points: &[DVec2], order: &[u32]) -> Vec<DVec2> {
        order.iter().map(|&index| points[index as usize]).collect()
    }

    /// The proof of the triangulation of points given as fractions of the domain's sides.
    fn prove(space: &Space, fractions: impl IntoIterator<Item = [f64; 2]>) -> Result<Triangulation, Error> {
        let domain = space.domain();
        let points: Vec<DVec2> = fractions.into_iter().map(|p| domain.land(DVec2::from(p) * domain.size)).collect();
        let order = hilbert_order(&points, domain.size);
        let triangulation = delaunay(&domain, sorted(&points, &order), order)?;
        assert_eq!(triangulation.check_delaunay(), Ok(()));
        let copies = triangulation.copies[0] * triangulation.copies[1];
        assert_eq!(triangulation.positions.len(), points.len() * copies as usize);
        Ok(triangulation)
    }

    #[test]
    fn random_sets_of_every_size_are_proved() {
        for space in SPACES() {
            for n in [3, 4, 5, 7, 20, 100, 1000, 20_011] {
                let points = white(&space, n, n as u64).unwrap();
                let fractions = points.positions().iter().map(|p| [0, 1].map(|k| (p[k] - space.origin()[k]) / space.size()[k]));
                prove(&space, fractions).unwrap();
            }
        }
    }

    #[test]
    fn a_large_even_set_needs_no_cover() {
        let points = jittered(&SPACES()[0], 5000, 3).unwrap();
        assert_eq!(prove(&SPACES()[0], points.positions().iter().copied()).unwrap().copies, [1, 1]);
    }

    #[test]
    fn square_grids_are_cut_alike_on_both_sides_of_the_seam() {
        for space in SPACES() {
            for n in [2, 3, 10, 64] {
                let grid = (0..n * n).map(|i| [(i % n) as f64 / n as f64, (i / n) as f64 / n as f64]);
                prove(&space, grid).unwrap();
            }
        }
    }

    #[test]
    fn big_voids_are_bridged() {
        let some = white(&SPACES()[0], 300, 5).unwrap();
        let squeezed = |low: f64, width: f64| some.positions().iter().map(move |p| [low + width * p[0], low + width * p[1]]);
        for space in SPACES() {
            prove(&space, some.positions().iter().map(|p| [0.5 * p[0], p[1]])).unwrap();
            prove(&space, squeezed(0.2, 0.01)).unwrap();
            prove(&space, squeezed(0.999_999, 1e-6)).unwrap();
            prove(&space, squeezed(0.1, 0.001).chain(squeezed(0.6, 0.001))).unwrap();
        }
    }

    #[test]
    fn points_on_one_line_or_circle_are_no_trouble() {
        let line = |i: usize| [(0.5 + i as f64) / 40.0, 0.5];
        let circle = |i: usize| {
            let (sin, cos) = (i as f64 * 0.157_079_632_679).sin_cos();
            [0.5 + 0.3 * cos, 0.5 + 0.3 * sin]
        };
        for space in SPACES() {
            prove(&space, (0..40).map(circle)).unwrap();
            let lined = prove(&space, (0..40).map(line));
            assert_eq!(lined.is_ok(), space.is_periodic());
        }
    }

    #[test]
    fn a_jitter_that_brings_neighbours_together_is_tried_again() {
        // Found by the random test below: cocircular across the seam, and one grid step apart.
        let end = 1.0 - GRID;
        prove(&SPACES()[0], [[GRID, end], [0.0, end], [end, 0.625], [end, end], [0.5, 0.0]]).unwrap();
    }

    #[test]
    fn a_broken_mesh_is_found_out() {
        let mut mesh = prove(&SPACES()[0], white(&SPACES()[0], 50, 1).unwrap().positions().iter().copied()).unwrap();
        let whole = mesh.clone();
        mesh.half_edges.twin.swap(0, 1);
        assert!(mesh.check().unwrap_err().contains("no twins"));
        mesh = whole.clone();
        mesh.positions[0] = mesh.domain.land(mesh.positions[0] + 0.3);
        assert!(mesh.check().unwrap_err().contains("turned over"));
        mesh = whole;
        let illegal = (0..mesh.half_edges.origin.len() as u32).find(|&h| {
            Patch::whole(&mut mesh.half_edges).flip(h);
            mesh.check().is_ok()
        });
        assert!(illegal.is_some_and(|_| mesh.check_delaunay().is_err()));
    }

    /// Coordinates that trouble geometry: multiples of a coarse grid, boundaries, near-coincidences, and plain ones.
    fn nasty() -> impl Strategy<Value = f64> {
        prop_oneof![
            (0..8u8).prop_map(|k| f64::from(k) / 8.0),
            (0..8u8, -3..=3i8).prop_map(|(k, ulps)| (f64::from(k) / 8.0 + f64::from(ulps) * GRID).max(0.0)),
            Just(1.0 - GRID),
            Just(1e-300),
            0.0..1.0f64,
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn nasty_sets_are_proved_or_refused(points in prop::collection::vec([nasty(), nasty()], 3..40), which in 0..4usize) {
            let space = &SPACES()[which];
            let domain = space.domain();
            let mut positions: Vec<DVec2> = points.into_iter().map(|p| domain.land(DVec2::from(p) * domain.size)).collect();
            let order = separate(&domain, &mut positions, 0, 0.1).order;
            match delaunay(&domain, sorted(&positions, &order), order) {
                Ok(triangulation) => prop_assert_eq!(triangulation.check_delaunay(), Ok(())),
                Err(error) => prop_assert!(!space.is_periodic(), "{}", error),
            }
        }

        #[test]
        fn points_anywhere_are_wrapped_into_the_torus(x in -1e6..1e6f64, y in -1e6..1e6f64) {
            let space = &SPACES()[1];
            let points = PointSet::new(space, vec![[x, y]]).unwrap();
            let [p] = points.positions() else { panic!() };
            prop_assert!(p[0] >= -3.0 && p[0] < 97.0 && p[1] >= 7.0 && p[1] < 8.0);
            prop_assert!(((p[0] - x) / 100.0).round() * 100.0 - (p[0] - x) < 1e-8);
        }
    }
}
