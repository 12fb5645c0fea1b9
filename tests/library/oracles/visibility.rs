//! Polygons: what points see, by each segment of the boundary.

use std::f64::consts::PI;

use evenly::{PointSet, Polygon, Space, measure, measure_each};
use glam::DVec2;

use super::{Random, area, assert_near, ends, hex_spacing};
use crate::shapes::{Ring, comb, l_shape, nested, rectangle, slit, star};

/// The segments of a polygon, in the parts that hang together.
pub(super) struct Walls {
    pub rings: Vec<Vec<DVec2>>,
    pub segments: Vec<[DVec2; 2]>,
}

/// Where a ray ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum End {
    /// On a segment of the boundary.
    Wall(usize),
    /// On the bisector with a point.
    Point(usize),
}

impl Walls {
    pub fn new(rings: &[Ring]) -> Self {
        let rings: Vec<Vec<DVec2>> = rings.iter().map(|ring| ring.iter().map(|&p| p.into()).collect()).collect();
        let segments = rings.iter().flat_map(|ring| ends(ring).map(|(a, b)| [a, b])).collect();
        Self { rings, segments }
    }

    /// Whether a ring lies in an odd number of others.
    fn is_hole(&self, k: usize) -> bool {
        self.rings.iter().enumerate().filter(|&(other, ring)| other != k && holds(ring, self.rings[k][0])).count() % 2 == 1
    }

    pub fn area(&self) -> f64 {
        self.triangles().map(|corners| area(&corners)).sum()
    }

    /// Triangles from one place to each segment, whose areas add up to that inside; they may run clockwise.
    pub fn triangles(&self) -> impl Iterator<Item = [DVec2; 3]> + use<'_> {
        let to = self.bounds()[0];
        self.rings.iter().enumerate().flat_map(move |(k, ring)| {
            let is_turned = (area(ring) > 0.0) == self.is_hole(k);
            ends(ring).map(move |(a, b)| if is_turned { [to, b, a] } else { [to, a, b] })
        })
    }

    pub fn contains(&self, place: DVec2) -> bool {
        self.rings.iter().filter(|ring| holds(ring, place)).count() % 2 == 1
    }

    pub fn bounds(&self) -> [DVec2; 2] {
        let corners = || self.rings.iter().flatten().copied();
        [corners().fold(DVec2::INFINITY, DVec2::min), corners().fold(DVec2::NEG_INFINITY, DVec2::max)]
    }

    pub fn random_points(&self, n: usize, seed: u64) -> Vec<DVec2> {
        let ([low, high], mut random) = (self.bounds(), Random(seed));
        std::iter::repeat_with(|| random.place(low, high - low)).filter(|&place| self.contains(place)).take(n).collect()
    }

    /// Whether no segment stands between two places.
    pub fn sees(&self, a: DVec2, b: DVec2) -> bool {
        let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
        let crosses =
            |&[c, d]: &[DVec2; 2]| (turn(a, b, c) > 0.0) != (turn(a, b, d) > 0.0) && (turn(c, d, a) > 0.0) != (turn(c, d, b) > 0.0);
        !self.segments.iter().any(crosses)
    }

    /// For each point the others that it sees.
    pub fn seen(&self, points: &[DVec2]) -> Vec<Vec<usize>> {
        let of = |k: usize| (0..points.len()).filter(|&other| other != k && self.sees(points[k], points[other])).collect();
        (0..points.len()).map(of).collect()
    }

    /// What ends a ray from a point, and how far away: the boundary, or the bisector with another that it sees.
    fn ray(&self, points: &[DVec2], k: usize, seen: &[usize], direction: DVec2) -> (f64, End) {
        let at = points[k];
        let to_segment = |&[a, b]: &[DVec2; 2]| {
            let (along, start) = (b - a, a - at);
            let across = direction.perp_dot(along);
            let [part, place] = [start.perp_dot(along) / across, start.perp_dot(direction) / across];
            if part > 0.0 && (0.0..=1.0).contains(&place) { part } else { f64::INFINITY }
        };
        let to_bisector = |&other: &usize| {
            let way = points[other] - at;
            let towards = 2.0 * way.dot(direction);
            if towards > 0.0 { way.length_squared() / towards } else { f64::INFINITY }
        };
        let walls = self.segments.iter().enumerate().map(|(number, segment)| (to_segment(segment), End::Wall(number)));
        let bisectors = seen.iter().map(|other| (to_bisector(other), End::Point(*other)));
        walls.chain(bisectors).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    }

    /// The outline of what a point sees of the places that are nearer to it than to others that it sees: pieces, counter-clockwise and relative to the point, each with that on which it lies.
    ///
    /// Between two rays that end on one line, with no corner of the boundary in between, all end there; others are drawn closer.
    pub fn cell(&self, points: &[DVec2], k: usize, seen: &[usize]) -> Vec<([DVec2; 2], End)> {
        let mut turns: Vec<f64> =
            self.rings.iter().flatten().map(|corner| (corner - points[k]).to_angle()).chain([-PI, -1.0, 1.0, PI]).collect();
        turns.sort_unstable_by(f64::total_cmp);
        let ray = |turn: f64| {
            let direction = DVec2::from_angle(turn);
            let (length, end) = self.ray(points, k, seen, direction);
            (turn, length * direction, end)
        };
        let mut pieces = Vec::new();
        for pair in turns.windows(2).filter(|pair| pair[1] - pair[0] > 1e-9) {
            let mut rays = vec![ray(pair[1] - 1e-12), ray(pair[0] + 1e-12)];
            while let [.., to, from] = rays[..] {
                if from.2 == to.2 {
                    pieces.push(([from.1, to.1], from.2));
                } else if to.0 - from.0 > 1e-11 {
                    rays.insert(rays.len() - 1, ray(0.5 * (from.0 + to.0)));
                    continue;
                }
                rays.pop();
            }
        }
        pieces
    }

    /// Of a place in one of the cells, the distance to the nearest point that sees it.
    fn distance(&self, points: &[DVec2], seen: &[Vec<usize>], place: DVec2) -> Option<f64> {
        let seers: Vec<usize> = (0..points.len()).filter(|&k| self.sees(points[k], place)).collect();
        let squared = |k: usize| points[k].distance_squared(place);
        let has = |&k: &usize| seen[k].iter().all(|&other| squared(other) >= squared(k));
        let is_in_cell = seers.iter().any(has);
        is_in_cell.then(|| seers.iter().map(|&k| squared(k)).fold(f64::INFINITY, f64::min).sqrt())
    }

    /// The largest of these: on a raster, and on finer ones around its best places.
    fn coverage_radius(&self, points: &[DVec2], sides: [usize; 2]) -> f64 {
        let seen = self.seen(points);
        let [low, high] = self.bounds();
        let raster = |low: DVec2, step: DVec2, [columns, rows]: [usize; 2]| {
            let places = (0..columns * rows).map(move |k| low + step * (DVec2::new((k % columns) as f64, (k / columns) as f64) + 0.5));
            let inside = places.filter(|&place| self.contains(place));
            inside.filter_map(|place| self.distance(points, &seen, place).map(|distance| (distance, place))).collect::<Vec<_>>()
        };
        let mut step = (high - low) / DVec2::new(sides[0] as f64, sides[1] as f64);
        let mut found = raster(low, step, sides);
        for _ in 0..6 {
            found.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
            let mut best: Vec<(f64, DVec2)> = Vec::new();
            for &(distance, place) in &found {
                if best.len() < 12 && best.iter().all(|(_, other)| (place - other).abs().cmpgt(1.5 * step).any()) {
                    best.push((distance, place));
                }
            }
            found = best;
            let finer: Vec<_> = found.iter().flat_map(|&(_, place)| raster(place - 2.0 * step, 0.2 * step, [20; 2])).collect();
            found.extend(finer);
            step *= 0.2;
        }
        found.iter().map(|&(distance, _)| distance).fold(0.0, f64::max)
    }
}

/// Whether a ring winds around a place.
fn holds(ring: &[DVec2], place: DVec2) -> bool {
    let is_crossed = |(a, b): (DVec2, DVec2)| {
        let [low, high] = if a.y < b.y { [a, b] } else { [b, a] };
        low.y <= place.y && place.y < high.y && (high - low).perp_dot(place - low) > 0.0
    };
    ends(ring).filter(|&ends| is_crossed(ends)).count() % 2 == 1
}

pub(super) fn holes() -> Vec<Ring> {
    let turned = |[x, y]: [f64; 2], size: f64| vec![[x, y], [x + size, y + 0.3 * size], [x + 0.7 * size, y + 1.3 * size]];
    vec![
        rectangle([0.0, 0.0], [1.0, 1.0]),
        turned([0.2, 0.15], 0.2),
        turned([0.6, 0.5], 0.25),
        turned([0.15, 0.6], 0.15),
        turned([0.7, 0.1], 0.1),
    ]
}

pub(super) fn polygons() -> Vec<(&'static str, Vec<Ring>)> {
    vec![
        ("L", l_shape()),
        ("slit", slit(1e-3)),
        ("thin slit", slit(1e-9)),
        ("holes", holes()),
        ("ring", nested(2)),
        ("comb", comb(4, 0.5)),
        ("thin comb", comb(3, 0.05)),
        ("star", star(7, 0.3)),
    ]
}

pub(super) fn point_set(rings: &[Ring], points: &[DVec2]) -> PointSet {
    let space = Space::from(&Polygon::from_rings(rings.to_vec()).unwrap());
    PointSet::new(space, points.iter().map(|p| p.to_array()).collect()).unwrap()
}

fn cases() -> Vec<(Vec<Ring>, Vec<DVec2>, String)> {
    let all = polygons().into_iter().flat_map(|shape| [(5, 1), (5, 2), (40, 3), (40, 4), (150, 5)].map(|case| (shape.clone(), case)));
    all.map(|((name, rings), (n, seed))| {
        let points = Walls::new(&rings).random_points(n, seed);
        (rings, points, format!("{name}, {n}, {seed}"))
    })
    .collect()
}

#[test]
fn distances_are_those_of_pairs_that_see_each_other() {
    for (rings, points, case) in cases() {
        let (walls, set) = (Walls::new(&rings), point_set(&rings, &points));
        let (all, each) = (measure(&set).unwrap(), measure_each(&set).unwrap());
        let spacing = hex_spacing(walls.area(), points.len());
        let distance = |a: usize, b: usize| points[a].distance(points[b]) / spacing;
        let visible = walls.seen(&points).into_iter().enumerate();
        let nearest: Vec<f64> =
            visible.map(|(k, seen)| seen.into_iter().map(|other| distance(k, other)).fold(f64::INFINITY, f64::min)).collect();
        let pairs = (0..points.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
        let least = pairs.map(|(i, j)| distance(i, j)).fold(f64::INFINITY, f64::min);
        let seeing: Vec<f64> = nearest.iter().copied().filter(|distance| distance.is_finite()).collect();
        assert_near(all.min_distance, least, 1e-9, &case);
        assert_near(all.mean_distance, seeing.iter().sum::<f64>() / seeing.len() as f64, 1e-9, &case);
        let least = seeing.into_iter().fold(f64::INFINITY, f64::min);
        assert_near(all.boundary.unwrap().min_distance_visible.unwrap(), least, 1e-9, &case);
        for (k, (point, nearest)) in each.iter().zip(nearest).enumerate() {
            assert!(point.nearest == nearest || (point.nearest - nearest).abs() < 1e-9, "{case}, {k}: {} {nearest}", point.nearest);
        }
    }
}

#[test]
fn cells_are_what_points_see() {
    for (rings, points, case) in cases() {
        let (walls, set, n) = (Walls::new(&rings), point_set(&rings, &points), points.len());
        let (all, each) = (measure(&set).unwrap(), measure_each(&set).unwrap());
        let mean = walls.area() / n as f64;
        let (mut deviations, mut energy) = (Vec::new(), 0.0);
        for (k, (seen, point)) in walls.seen(&points).iter().zip(&each).enumerate() {
            let cell = walls.cell(&points, k, seen);
            let capacity = cell.iter().map(|([a, b], _)| 0.5 * a.perp_dot(*b)).sum::<f64>() / mean;
            assert_near(point.capacity, capacity, 1e-7, &case);
            let is_clear = cell.iter().all(|(_, end)| matches!(end, End::Point(_)));
            assert!(is_clear || !point.is_inner, "{case}, {k}");
            let second = |[a, b]: [DVec2; 2]| a.perp_dot(b) * (a.length_squared() + a.dot(b) + b.length_squared()) / 12.0;
            energy += cell.iter().map(|(ends, _)| second(*ends)).sum::<f64>();
            deviations.push((capacity - 1.0).abs());
        }
        let of_hexagons = n as f64 * mean * mean * 5.0 / (18.0 * 3f64.sqrt());
        assert_near(all.capacity_sd, (deviations.iter().map(|d| d * d).sum::<f64>() / n as f64).sqrt(), 1e-7, &case);
        assert_near(all.capacity_max_deviation, deviations.iter().copied().fold(0.0, f64::max), 1e-7, &case);
        assert_near(all.cvt_energy, energy / of_hexagons, 1e-7 * all.cvt_energy, &case);
    }
}

/// Behind corners cells overlap: what one point sees may be nearer to another.
#[test]
fn no_place_is_farther_from_points_that_see_it_than_the_coverage_radius() {
    for (rings, points, case) in cases() {
        let walls = Walls::new(&rings);
        let set = point_set(&rings, &points);
        let measures = measure(&set).unwrap();
        let sides = if case.starts_with("thin comb") { [1000, 500] } else { [150; 2] };
        let radius = walls.coverage_radius(&points, sides) / measures.hex_spacing;
        // Nearly each place that the raster leaves out has one of it beside it.
        assert!((-1e-9..1e-3).contains(&(measures.coverage_radius / radius - 1.0)), "{case}: {} {radius}", measures.coverage_radius);
        let farthest = measure_each(&set).unwrap().iter().map(|point| point.reach).fold(0.0, f64::max);
        assert_near(measures.coverage_radius, farthest, 1e-5 * farthest, &case);
    }
}

/// Two rooms of different size that nowhere hang together, and a point in a third.
#[test]
fn parts_have_means_of_their_own_and_a_lone_point_has_no_distance() {
    let rooms = vec![rectangle([0.0, 0.0], [1.0, 1.0]), rectangle([1.1, 0.0], [2.0, 1.0]), rectangle([0.0, 1.5], [0.3, 0.2])];
    let mut points = Walls::new(&rooms[..1]).random_points(10, 1);
    points.extend(Walls::new(&rooms[1..2]).random_points(15, 2));
    points.extend(Walls::new(&rooms[2..]).random_points(1, 3));
    let (walls, room_of) = (Walls::new(&rooms), |k: usize| usize::from(k >= 10) + usize::from(k >= 25));
    let distance = |a: usize, b: usize| points[a].distance(points[b]);
    let nearest: Vec<f64> = (0..25)
        .map(|k| {
            (0..25)
                .filter(|&other| other != k && room_of(other) == room_of(k))
                .map(|other| distance(k, other))
                .fold(f64::INFINITY, f64::min)
        })
        .collect();
    let mut set = points.clone();
    for (n_twice, sum) in [(0, nearest.iter().sum::<f64>()), (1, nearest[1..].iter().sum()), (2, nearest[1..].iter().sum())] {
        // Of points that share a place each has the other: at first one of many, then the lone one too.
        set.extend((n_twice > 0).then(|| points[[0, 25][n_twice - 1]]));
        let measures = measure(&point_set(&rooms, &set)).unwrap();
        let n_alone = if n_twice < 2 { 1 } else { 0 };
        let mean = sum / (set.len() - n_alone) as f64;
        assert_near(measures.mean_distance * measures.hex_spacing, mean, 1e-9, &format!("{n_twice}"));
    }
    let each = measure_each(&point_set(&rooms, &points)).unwrap();
    let means = [1.0 / 10.0, 2.0 / 15.0, 0.3 * 0.2];
    for (k, (seen, point)) in walls.seen(&points).iter().zip(&each).enumerate() {
        let area: f64 = walls.cell(&points, k, seen).iter().map(|([a, b], _)| 0.5 * a.perp_dot(*b)).sum();
        assert_near(point.capacity, area / means[room_of(k)], 1e-8, &format!("{k}"));
    }
}
