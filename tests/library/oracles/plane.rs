//! Torus and rectangle: all pairs, all half-planes, and rasters.

use evenly::{PointSet, Rectangle, Space, Torus, measure, measure_each};
use glam::DVec2;
use proptest::prelude::*;

use super::{Random, area, assert_near, cut, ends, hex_spacing};

/// A box, periodic or not.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub origin: DVec2,
    pub size: DVec2,
    pub is_periodic: bool,
}

/// On whose bisector a side of a cell lies, and the way there; `None` on a wall.
pub(super) type Side = Option<(usize, DVec2)>;

impl Plane {
    pub fn space(&self) -> Space {
        let (origin, size) = (self.origin.to_array(), self.size.to_array());
        if self.is_periodic { Torus::new(origin, size).unwrap().into() } else { Rectangle::new(origin, size).unwrap().into() }
    }

    pub fn area(&self) -> f64 {
        self.size.x * self.size.y
    }

    pub fn random_points(&self, n: usize, seed: u64) -> Vec<DVec2> {
        let mut random = Random(seed);
        (0..n).map(|_| random.place(self.origin, self.size)).collect()
    }

    /// The shortest way, on a torus of all copies.
    fn way(&self, from: DVec2, to: DVec2) -> DVec2 {
        let by = to - from;
        if self.is_periodic { by - (by / self.size).round() * self.size } else { by }
    }

    /// The ways to all copies that can be near.
    fn ways(&self, from: DVec2, to: DVec2) -> impl Iterator<Item = DVec2> + use<> {
        let (way, size, reach) = (self.way(from, to), self.size, i32::from(self.is_periodic));
        let shifts = (-reach..=reach).flat_map(move |x| (-reach..=reach).map(move |y| DVec2::new(f64::from(x), f64::from(y))));
        shifts.map(move |shift| way + shift * size)
    }

    /// The distance of a point to the nearest other; on a torus also to its own copies.
    fn nearest(&self, points: &[DVec2], k: usize) -> f64 {
        let own = if self.is_periodic { self.size.min_element() } else { f64::INFINITY };
        let others = points.iter().enumerate().filter(|&(other, _)| other != k);
        others.map(|(_, &p)| self.way(points[k], p).length()).fold(own, f64::min)
    }

    /// The nearest point to a place.
    fn nearest_to(&self, points: &[DVec2], place: DVec2) -> (usize, f64) {
        let squared = |p: &DVec2| self.way(place, *p).length_squared();
        let (k, squared) = points.iter().map(squared).enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        (k, squared.sqrt())
    }

    /// The largest distance of a place from the nearest point: no place of a box is farther than its middle by more than half of its diagonal.
    fn coverage_radius(&self, points: &[DVec2]) -> f64 {
        let n = (self.size / (0.5 * hex_spacing(self.area(), points.len()))).ceil().max(DVec2::ONE);
        let mut half = 0.5 * self.size / n;
        let boxes = (0..n.x as usize).flat_map(|x| (0..n.y as usize).map(move |y| DVec2::new(x as f64, y as f64)));
        let mut middles: Vec<DVec2> = boxes.map(|k| self.origin + (2.0 * k + 1.0) * half).collect();
        let mut most = 0.0f64;
        while half.length() > 1e-10 * self.size.max_element() {
            let distances: Vec<f64> = middles.iter().map(|&middle| self.nearest_to(points, middle).1).collect();
            most = distances.iter().copied().fold(most, f64::max);
            let (reach, quarter) = (half.length(), 0.5 * half);
            let kept = middles.iter().zip(distances).filter(|(_, distance)| distance + reach > most);
            let split =
                |middle: DVec2| [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]].map(|sign| middle + DVec2::from(sign) * quarter);
            middles = kept.flat_map(|(&middle, _)| split(middle)).collect();
            half = quarter;
        }
        most
    }

    /// A point's Voronoi cell, relative to it: what all half-planes leave. Each corner has the side that begins there.
    pub fn cell(&self, points: &[DVec2], k: usize) -> Vec<(DVec2, Side)> {
        let at = points[k];
        let [low, high] = if self.is_periodic { [-self.size, self.size] } else { [self.origin - at, self.origin + self.size - at] };
        let mut cell: Vec<(DVec2, Side)> =
            [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|corner| (corner, None)).to_vec();
        for (other, &p) in points.iter().enumerate() {
            for way in self.ways(at, p).filter(|way| *way != DVec2::ZERO) {
                let half = 0.5 * way.length_squared();
                if cell.iter().any(|(corner, _)| corner.dot(way) > half) {
                    cell = cut(&cell, way, half, Some((other, way)));
                }
            }
        }
        cell
    }
}

pub(super) fn planes() -> Vec<Plane> {
    let shapes = [([0.0, 0.0], [1.0, 1.0]), ([3.0, -7.0], [1.0, 20.0]), ([1e6, -1e6], [5.0, 4.0])];
    let both = shapes.iter().flat_map(|shape| [(shape, true), (shape, false)]);
    both.map(|(&(origin, size), is_periodic)| Plane { origin: origin.into(), size: size.into(), is_periodic }).collect()
}

/// Points in planes of all shapes, and what they are.
fn cases(most: usize) -> Vec<(Plane, Vec<DVec2>, String)> {
    let numbers = [(3, 3), (7, 2), (200, 1), (1000, 1)].into_iter().filter(move |&(n, _)| n <= most);
    let all = numbers.flat_map(|(n, seeds)| (0..seeds).flat_map(move |seed| planes().into_iter().map(move |plane| (plane, n, seed))));
    all.map(|(plane, n, seed)| (plane, plane.random_points(n, seed), format!("{plane:?}, {n}, {seed}"))).collect()
}

fn point_set(plane: &Plane, points: &[DVec2]) -> PointSet {
    PointSet::new(plane.space(), points.iter().map(|p| p.to_array()).collect()).unwrap()
}

#[test]
fn distances_are_those_of_all_pairs() {
    for (plane, mut points, case) in cases(1000) {
        for n_twice in [0, 2] {
            points.extend_from_within(..n_twice);
            let n = points.len();
            let set = point_set(&plane, &points);
            let (all, each) = (measure(&set).unwrap(), measure_each(&set).unwrap());
            let spacing = hex_spacing(plane.area(), n);
            let nearest: Vec<f64> = (0..n).map(|k| plane.nearest(&points, k) / spacing).collect();
            assert_near(all.hex_spacing, spacing, 1e-12 * spacing, &case);
            assert_eq!(all.coincident_points, n_twice, "{case}");
            assert_near(all.min_distance, nearest.iter().copied().fold(f64::INFINITY, f64::min), 1e-9, &case);
            assert_near(all.mean_distance, nearest.iter().sum::<f64>() / n as f64, 1e-9, &case);
            for (point, nearest) in each.iter().zip(nearest) {
                assert_near(point.nearest, nearest, 1e-9, &case);
            }
        }
    }
}

#[test]
fn no_place_is_farther_than_the_coverage_radius() {
    for (plane, points, case) in cases(1000) {
        let measures = measure(&point_set(&plane, &points)).unwrap();
        let radius = plane.coverage_radius(&points) / measures.hex_spacing;
        assert_near(measures.coverage_radius, radius, 1e-6 * radius, &case);
        assert_near(measures.beta, radius / measures.min_distance, 1e-5 * measures.beta, &case);
    }
}

/// That cells are what all half-planes leave.
fn compare_cells(plane: &Plane, points: &[DVec2], case: &str) {
    let n = points.len();
    let set = point_set(plane, points);
    let (all, each) = (measure(&set).unwrap(), measure_each(&set).unwrap());
    let mean = plane.area() / n as f64;
    let (mut squares, mut most, mut energy) = (0.0, 0.0f64, 0.0);
    for (k, point) in each.iter().enumerate() {
        let cell: Vec<DVec2> = plane.cell(points, k).into_iter().map(|(corner, _)| corner).collect();
        let deviation = area(&cell) / mean - 1.0;
        let reach = cell.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        assert_near(point.capacity, deviation + 1.0, 1e-8, case);
        assert_near(point.reach, reach / all.hex_spacing, 1e-8, case);
        squares += deviation * deviation;
        most = most.max(deviation.abs());
        energy += ends(&cell).map(|(a, b)| a.perp_dot(b) * (a.length_squared() + a.dot(b) + b.length_squared()) / 12.0).sum::<f64>();
    }
    assert_near(all.capacity_sd, (squares / n as f64).sqrt(), 1e-8, case);
    assert_near(all.capacity_max_deviation, most, 1e-8, case);
    // A regular hexagon of area 1 has 5 / (18 sqrt(3)).
    let of_hexagons = n as f64 * mean * mean * 5.0 / (18.0 * 3f64.sqrt());
    assert_near(all.cvt_energy, energy / of_hexagons, 1e-8 * all.cvt_energy, case);
}

#[test]
fn cells_are_what_all_half_planes_leave() {
    for (plane, points, case) in cases(1000) {
        compare_cells(&plane, &points, &case);
    }
}

#[test]
fn cells_are_as_large_as_the_places_in_them_are_many() {
    const SIDE: usize = 400;
    for (plane, points, case) in cases(200) {
        let each = measure_each(&point_set(&plane, &points)).unwrap();
        let place = |k: usize| (DVec2::new((k % SIDE) as f64, (k / SIDE) as f64) + 0.5) / SIDE as f64;
        let nearest: Vec<usize> = (0..SIDE * SIDE).map(|k| plane.nearest_to(&points, plane.origin + place(k) * plane.size).0).collect();
        // So many places are in each cell, and so many of them have one of another cell beside them.
        let (mut n_places, mut n_doubtful) = (vec![0.0; points.len()], vec![0.0; points.len()]);
        for (k, &own) in nearest.iter().enumerate() {
            let beside = [(k / SIDE * SIDE) + (k + 1) % SIDE, (k / SIDE * SIDE) + (k + SIDE - 1) % SIDE, (k + SIDE) % (SIDE * SIDE)];
            let beside = beside.into_iter().chain([(k + SIDE * SIDE - SIDE) % (SIDE * SIDE)]);
            n_places[own] += 1.0;
            n_doubtful[own] += f64::from(u8::from(beside.into_iter().any(|other| nearest[other] != own)));
        }
        for (k, point) in each.iter().enumerate() {
            let places = point.capacity * (SIDE * SIDE) as f64 / points.len() as f64;
            assert_near(places, n_places[k], n_doubtful[k] + 1.0, &case);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(60) })]

    /// On a grid most points lie on circles with four others or more, and walls.
    #[test]
    fn points_on_a_grid_have_the_same_distances_and_cells(
        mut places in prop::collection::vec((0..=8u32, 0..=8u32), 4..30), is_periodic: bool, height in prop_oneof![Just(1.0), Just(0.1), Just(3.0)],
    ) {
        let plane = Plane { origin: DVec2::new(-1.0, 5.0), size: DVec2::new(1.0, height), is_periodic };
        if is_periodic {
            places.iter_mut().for_each(|(x, y)| (*x, *y) = (*x % 8, *y % 8));
        }
        places.sort_unstable();
        places.dedup();
        let points: Vec<DVec2> =
            places.iter().map(|&(x, y)| plane.origin + plane.size * DVec2::new(f64::from(x), f64::from(y)) / 8.0).collect();
        let set = point_set(&plane, &points);
        let Ok(measures) = measure(&set) else { return Ok(()) };
        let nearest = (0..points.len()).map(|k| plane.nearest(&points, k)).fold(f64::INFINITY, f64::min);
        assert_near(measures.min_distance * measures.hex_spacing, nearest, 1e-12, "grid");
        let radius = plane.coverage_radius(&points);
        assert_near(measures.coverage_radius * measures.hex_spacing, radius, 1e-8, "grid");
        compare_cells(&plane, &points, &format!("{plane:?}, {places:?}"));
    }
}
