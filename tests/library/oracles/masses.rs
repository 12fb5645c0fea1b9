//! Densities: masses pixel by pixel, and lengths from one pixel's side to the next.

use evenly::{Density, PointSet, measure, measure_each};
use glam::DVec2;

use super::plane::{Plane, planes};
use super::visibility::{End, Walls, point_set, polygons};
use super::{Random, area, assert_near, cut, hex_spacing};

/// A picture that spans a box.
struct Picture {
    plane: Plane,
    columns: usize,
    rows: usize,
    /// Row by row from the bottom, 1 on average.
    values: Vec<f64>,
}

const SIZE: [usize; 2] = [11, 8];

/// A slope with noise on it, a hole, and a ditch all across.
fn slope(x: usize, y: usize, noise: f64) -> f32 {
    let is_gap = (3..5).contains(&x) && (2..6).contains(&y) || y == 6;
    if is_gap { 0.0 } else { (1 + x) as f32 * (0.5 + noise as f32) }
}

/// Half black, and a step of 1 to 100 on the other side.
fn step(x: usize, y: usize, _: f64) -> f32 {
    if x < 5 { 0.0 } else { [1.0, 100.0][usize::from(y > 3)] }
}

const PICTURES: [fn(usize, usize, f64) -> f32; 2] = [slope, step];

impl Picture {
    fn new(plane: Plane, of: fn(usize, usize, f64) -> f32, seed: u64) -> (Self, Density) {
        let ([columns, rows], mut random) = (SIZE, Random(seed));
        let values: Vec<f32> = (0..columns * rows).map(|k| of(k % columns, k / columns, random.unit())).collect();
        let from_top: Vec<f32> = values.chunks(columns).rev().flatten().copied().collect();
        let mean = values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64;
        let picture = Self { plane, columns, rows, values: values.into_iter().map(|value| f64::from(value) / mean).collect() };
        (picture, Density::image(columns, rows, &from_top).unwrap())
    }

    fn pixel(&self) -> DVec2 {
        self.plane.size / DVec2::new(self.columns as f64, self.rows as f64)
    }

    /// The density at a place; on a torus of any period.
    fn at(&self, place: DVec2) -> f64 {
        let pixel = ((place - self.plane.origin) / self.pixel()).floor();
        let of =
            |x: f64, n: usize| if self.plane.is_periodic { x.rem_euclid(n as f64) as usize } else { x.clamp(0.0, n as f64 - 1.0) as usize };
        self.values[of(pixel.x, self.columns) + self.columns * of(pixel.y, self.rows)]
    }

    fn points(&self, n: usize, seed: u64, is_inside: impl Fn(DVec2) -> bool) -> Vec<DVec2> {
        let mut random = Random(seed);
        let places = std::iter::repeat_with(|| random.place(self.plane.origin, self.plane.size));
        places.filter(|&place| self.at(place) > 0.0 && is_inside(place)).take(n).collect()
    }

    /// The mass in a convex polygon, clipped to each pixel that it reaches.
    fn mass(&self, corners: &[DVec2]) -> f64 {
        let pixel = self.pixel();
        let low = corners.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = corners.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        let [first, last] = [low, high].map(|corner| ((corner - self.plane.origin) / pixel).floor());
        let polygon: Vec<(DVec2, ())> = corners.iter().map(|&corner| (corner, ())).collect();
        let mut mass = 0.0;
        for row in first.y as i64..=last.y as i64 {
            for column in first.x as i64..=last.x as i64 {
                let low = self.plane.origin + pixel * DVec2::new(column as f64, row as f64);
                let sides = [(DVec2::NEG_X, -low.x), (DVec2::X, low.x + pixel.x), (DVec2::NEG_Y, -low.y), (DVec2::Y, low.y + pixel.y)];
                let part = sides.iter().fold(polygon.clone(), |part, &(way, half)| cut(&part, way, half, ()));
                let part: Vec<DVec2> = part.into_iter().map(|(corner, ())| corner - low).collect();
                mass += self.at(low + 0.5 * pixel) * area(&part);
            }
        }
        mass
    }

    /// The mean of the density's root along a segment.
    fn stretch(&self, from: DVec2, to: DVec2) -> f64 {
        let (a, b) = ((from - self.plane.origin) / self.pixel(), (to - self.plane.origin) / self.pixel());
        let crossings = (0..2).flat_map(|axis| {
            let (low, high) = (a[axis].min(b[axis]).ceil() as i64, a[axis].max(b[axis]).floor() as i64);
            (low..=high).map(move |line| (line as f64 - a[axis]) / (b[axis] - a[axis]))
        });
        let mut parts: Vec<f64> = crossings.chain([0.0, 1.0]).collect();
        parts.sort_unstable_by(f64::total_cmp);
        parts.windows(2).map(|pair| (pair[1] - pair[0]) * self.at(from.lerp(to, 0.5 * (pair[0] + pair[1]))).sqrt()).sum()
    }

    /// The length of the way between two points; across a gap half of the smaller root counts.
    fn length(&self, from: DVec2, to: DVec2) -> f64 {
        let least = 0.5 * self.at(from).min(self.at(to)).sqrt();
        self.stretch(from, to).max(least) * from.distance(to)
    }

    /// The mass in a box.
    fn mass_in(&self, [low, high]: [DVec2; 2]) -> f64 {
        self.mass(&[low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)])
    }

    /// The squared errors of the numbers of points in so many cells of equal mass, into which a box is halved again and again across its longer side.
    fn squared_errors(&self, points: &[DVec2], [low, high]: [DVec2; 2], n_cells: usize, wanted: f64) -> f64 {
        if n_cells <= 1 {
            return (points.len() as f64 / wanted - 1.0).powi(2);
        }
        let axis = usize::from(high.y - low.y > high.x - low.x);
        let n_below = n_cells / 2;
        let split = |at: f64| {
            let (mut below, mut above) = (high, low);
            (below[axis], above[axis]) = (at, at);
            [[low, below], [above, high]]
        };
        let (mut first, mut last) = (low[axis], high[axis]);
        let share = self.mass_in([low, high]) * n_below as f64 / n_cells as f64;
        for _ in 0..50 {
            let middle = 0.5 * (first + last);
            if self.mass_in(split(middle)[0]) < share { first = middle } else { last = middle }
        }
        let (below, above): (Vec<DVec2>, Vec<DVec2>) = points.iter().partition(|p| p[axis] < last);
        let [box_below, box_above] = split(last);
        self.squared_errors(&below, box_below, n_below, wanted) + self.squared_errors(&above, box_above, n_cells - n_below, wanted)
    }
}

#[test]
fn cells_distances_and_radii_are_those_of_the_density() {
    for (plane, of) in planes().into_iter().flat_map(|plane| PICTURES.map(|of| (plane, of))) {
        for (n, seed) in [(7, 1), (40, 2), (40, 3), (150, 4)] {
            let (picture, density) = Picture::new(plane, of, seed);
            let points = picture.points(n, seed, |_| true);
            let set = PointSet::new(plane.space(), points.iter().map(|p| p.to_array()).collect()).unwrap().with_density(&density);
            let (all, each) = (measure(&set).unwrap(), measure_each(&set).unwrap());
            let spacing = hex_spacing(plane.area(), n);
            let case = format!("{plane:?}, {n}, {seed}");
            let (mut nearest, mut reach, mut deviations, mut distances) = (f64::INFINITY, 0.0f64, Vec::new(), 0.0);
            for (k, point) in each.iter().enumerate() {
                let (at, cell) = (points[k], plane.cell(&points, k));
                let corners: Vec<DVec2> = cell.iter().map(|&(corner, _)| at + corner).collect();
                let mass = picture.mass(&corners) * n as f64 / plane.area();
                let ways = || cell.iter().filter_map(|(_, side)| side.map(|(_, way)| way));
                let distance = ways().map(|way| picture.length(at, at + way)).fold(f64::INFINITY, f64::min) / spacing;
                let radius = |j: usize| {
                    let (corner, before) = (cell[j].0, cell[(j + cell.len() - 1) % cell.len()].1);
                    let others = [before, cell[j].1].into_iter().flatten().map(|(_, way)| at + way);
                    let ways: Vec<f64> = others.chain([at]).map(|from| picture.stretch(from, at + corner)).collect();
                    ways.iter().sum::<f64>() / ways.len() as f64 * corner.length() / spacing
                };
                let radius = (0..cell.len()).map(radius).fold(0.0, f64::max);
                assert_near(point.capacity, mass, 1e-8, &case);
                assert_near(point.nearest, distance, 1e-8, &case);
                assert_near(point.reach, radius, 1e-7, &case);
                (nearest, reach) = (nearest.min(distance), reach.max(radius));
                deviations.push(mass - 1.0);
                distances += distance;
            }
            assert_near(deviations.iter().sum(), 0.0, 1e-7, &case);
            assert_near(all.capacity_sd, (deviations.iter().map(|d| d * d).sum::<f64>() / n as f64).sqrt(), 1e-8, &case);
            assert_near(all.capacity_max_deviation, deviations.iter().map(|d| d.abs()).fold(0.0, f64::max), 1e-8, &case);
            assert_near(all.min_distance, nearest, 1e-8, &case);
            assert_near(all.mean_distance, distances / n as f64, 1e-8, &case);
            assert_near(all.coverage_radius, reach, 1e-7, &case);
            assert_near(all.beta, reach / nearest, 1e-6 * all.beta, &case);
            assert!(all.cvt_energy.is_nan() && all.density_error.is_some() == (n >= 150), "{case}");
        }
    }
}

#[test]
fn the_density_error_is_that_of_cells_of_equal_mass() {
    for (plane, of) in planes().into_iter().flat_map(|plane| PICTURES.map(|of| (plane, of))) {
        for (n, seed) in [(150, 1), (700, 2), (1234, 3)] {
            let (picture, density) = Picture::new(plane, of, seed);
            let points = picture.points(n, seed, |_| true);
            let set = PointSet::new(plane.space(), points.iter().map(|p| p.to_array()).collect()).unwrap().with_density(&density);
            let n_cells = (n as f64 / 100.0).round() as usize;
            let squares = picture.squared_errors(&points, [plane.origin, plane.origin + plane.size], n_cells, n as f64 / n_cells as f64);
            let found = measure(&set).unwrap().density_error.unwrap();
            assert_near(found, (squares / n_cells as f64).sqrt(), 1e-9, &format!("{plane:?}, {n}"));
        }
    }
}

#[test]
fn in_polygons_masses_and_distances_are_those_that_points_see() {
    for ((name, rings), of) in polygons().into_iter().flat_map(|shape| PICTURES.map(|of| (shape.clone(), of))) {
        let walls = Walls::new(&rings);
        let [low, high] = walls.bounds();
        let plane = Plane { origin: low, size: high - low, is_periodic: false };
        for (n, seed) in [(5, 1), (40, 2), (100, 3)] {
            let (mut picture, density) = Picture::new(plane, of, seed);
            // Its mean is 1 inside.
            let inside: f64 = walls.triangles().map(|corners| area(&corners).signum() * picture.mass(&upright(corners))).sum();
            picture.values.iter_mut().for_each(|value| *value *= walls.area() / inside);
            let points = picture.points(n, seed, |place| walls.contains(place));
            let set = point_set(&rings, &points).with_density(&density);
            let (all, each) = (measure(&set).unwrap(), measure_each(&set).unwrap());
            let spacing = hex_spacing(walls.area(), n);
            let case = format!("{name}, {n}, {seed}");
            let (mut distances, mut deviations) = (Vec::new(), Vec::new());
            for (k, (seen, point)) in walls.seen(&points).iter().zip(&each).enumerate() {
                let (at, cell) = (points[k], walls.cell(&points, k, seen));
                let mass = cell.iter().map(|&([a, b], _)| picture.mass(&[at, at + a, at + b])).sum::<f64>() * n as f64 / walls.area();
                let beside = cell.iter().filter_map(|&(_, end)| if let End::Point(other) = end { Some(points[other]) } else { None });
                let nearest = beside.map(|other| picture.length(at, other)).fold(f64::INFINITY, f64::min) / spacing;
                assert_near(point.capacity, mass, 1e-8, &case);
                assert!(point.nearest == nearest || (point.nearest - nearest).abs() < 1e-8, "{case}, {k}: {} {nearest}", point.nearest);
                deviations.push(mass - 1.0);
                distances.extend(nearest.is_finite().then_some(nearest));
            }
            // Neighbours count whatever stands between them: those of the cells that no boundary cuts.
            let all_around = Plane { origin: low - 1e4, size: DVec2::splat(2e4), is_periodic: false };
            let neighbours =
                (0..n).flat_map(|k| all_around.cell(&points, k).into_iter().filter_map(move |(_, side)| side.map(|(other, _)| (k, other))));
            let least = neighbours.map(|(k, other)| picture.length(points[k], points[other])).fold(f64::INFINITY, f64::min) / spacing;
            assert_near(all.min_distance, least, 1e-8, &case);
            assert_near(
                all.boundary.unwrap().min_distance_visible.unwrap(),
                distances.iter().copied().fold(f64::INFINITY, f64::min),
                1e-8,
                &case,
            );
            assert_near(all.mean_distance, distances.iter().sum::<f64>() / distances.len() as f64, 1e-8, &case);
            assert_near(all.capacity_sd, (deviations.iter().map(|d| d * d).sum::<f64>() / n as f64).sqrt(), 1e-8, &case);
            assert_near(all.capacity_max_deviation, deviations.iter().map(|d| d.abs()).fold(0.0, f64::max), 1e-8, &case);
        }
    }
}

/// A triangle turned counter-clockwise.
fn upright([a, b, c]: [DVec2; 3]) -> [DVec2; 3] {
    if area(&[a, b, c]) < 0.0 { [a, c, b] } else { [a, b, c] }
}
