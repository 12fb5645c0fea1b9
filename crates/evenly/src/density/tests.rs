use glam::DVec2;
use proptest::prelude::*;

use super::*;
use crate::points::Random;
use crate::{Rectangle, Torus};

/// Pixels at random, some of them 0.
fn noise(width: usize, height: usize, seed: u64) -> Density {
    let mut random = Random::new(seed, 0);
    let values: Vec<f32> = (0..width * height).map(|_| (10.0 * random.unit() - 2.0).max(0.0) as f32).collect();
    Density::image(width, height, &values).unwrap_or_else(|_| Density::image(width, height, &vec![1.0; width * height]).unwrap())
}

fn domain(size: [f64; 2], is_periodic: bool) -> Domain {
    let space: Space =
        if is_periodic { Torus::new([0.0, 0.0], size).unwrap().into() } else { Rectangle::new([0.0, 0.0], size).unwrap().into() };
    space.domain()
}

/// The mass of a polygon, by its definition: clipped to each pixel, also of the pictures around.
fn mass_by_pixels(field: &Field, pixels: [usize; 2], domain: &Domain, polygon: &[DVec2], periods: i64) -> f64 {
    let side = domain.size / DVec2::new(pixels[0] as f64, pixels[1] as f64);
    let [columns, rows] = pixels.map(|n| n as i64);
    let all = (-periods * rows..(periods + 1) * rows)
        .flat_map(|row| (-periods * columns..(periods + 1) * columns).map(move |column| (column, row)));
    all.map(|(column, row)| {
        let low = DVec2::new(column as f64, row as f64) * side;
        let mut cell = polygon.to_vec();
        for (normal, distance) in [(DVec2::NEG_X, -low.x), (DVec2::X, low.x + side.x), (DVec2::NEG_Y, -low.y), (DVec2::Y, low.y + side.y)] {
            let mut kept = Vec::new();
            for (k, &a) in cell.iter().enumerate() {
                let b = cell[(k + 1) % cell.len()];
                let (at_a, at_b) = (a.dot(normal) - distance, b.dot(normal) - distance);
                if at_a <= 0.0 {
                    kept.push(a);
                }
                if (at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0) {
                    kept.push(a + (b - a) * (at_a / (at_a - at_b)));
                }
            }
            cell = kept;
        }
        let area: f64 = (0..cell.len()).map(|k| 0.5 * cell[k].perp_dot(cell[(k + 1) % cell.len()])).sum();
        area * field.at((low + 0.5 * side).rem_euclid(domain.size))
    })
    .sum()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(150) })]

    #[test]
    fn masses_are_those_of_the_pixels_wherever_a_polygon_lies(
        width in 1..12usize, height in 1..12usize, seed in 0..1000u64, aspect in -2.0..2.0f64, is_periodic: bool, corners in 3..8usize,
    ) {
        let domain = domain([1.0, aspect.exp()], is_periodic);
        let field = noise(width, height, seed).field(&domain).unwrap();
        let mut random = Random::new(seed, 1);
        let at = DVec2::new(random.unit(), random.unit()) * domain.size;
        // A convex polygon around it, across the seam of a torus.
        let mut polygon: Vec<DVec2> = (0..corners)
            .map(|k| {
                let angle = std::f64::consts::TAU * (k as f64 + 0.3 * random.unit()) / corners as f64;
                0.45 * domain.size.min_element() * DVec2::from_angle(angle)
            })
            .collect();
        if !is_periodic {
            polygon.iter_mut().for_each(|corner| *corner = (at + *corner).clamp(DVec2::ZERO, domain.size) - at);
        }
        let absolute: Vec<DVec2> = polygon.iter().map(|&corner| at + corner).collect();
        let expected = mass_by_pixels(&field, [width, height], &domain, &absolute, i64::from(is_periodic));
        let mut sides = Vec::new();
        let mass = field.mass(at, &polygon, &mut sides);
        prop_assert!((mass - expected).abs() < 1e-10 * domain.area(), "{mass} {expected}");
        let (again, centroid) = field.centroid(at, &polygon);
        prop_assert!((again - expected).abs() < 1e-10 * domain.area());
        // Split by a line through the centroid, both parts balance: so do all first moments about it.
        let moved: Vec<DVec2> = polygon.iter().map(|&corner| corner - centroid).collect();
        let (_, rest) = field.centroid(at + centroid, &moved);
        prop_assert!(mass < 1e-9 || rest.length() < 1e-7, "{rest}");
    }

    #[test]
    fn a_segment_is_as_long_as_its_parts_are(
        width in 1..40usize, height in 1..40usize, seed in 0..1000u64, is_periodic: bool, share in 0.01..0.99f64,
    ) {
        let domain = domain([2.0, 1.0], is_periodic);
        let field = noise(width, height, seed).field(&domain).unwrap();
        let mut random = Random::new(seed, 2);
        let mut place = || DVec2::new(random.unit(), random.unit()) * domain.size;
        let (from, to) = (place(), place());
        let by = domain.spoke(from, to);
        let whole = field.stretch(from, by);
        let parts = share * field.stretch(from, share * by) + (1.0 - share) * field.stretch(from + share * by, (1.0 - share) * by);
        prop_assert!((whole - parts).abs() < 1e-9 * (1.0 + whole));
        prop_assert!((whole - field.stretch(from + by, -by)).abs() < 1e-9 * (1.0 + whole));
        let n = 4000;
        let sampled: f64 = (0..n).map(|k| field.at((from + (k as f64 + 0.5) / n as f64 * by).rem_euclid(domain.size)).sqrt()).sum();
        prop_assert!((whole - sampled / n as f64).abs() < 0.05 * (1.0 + whole), "{whole} {}", sampled / n as f64);
        let (low, high) = (from.min(from + by), from.max(from + by));
        let [least, most] = field.root_bounds(low, high);
        prop_assert!(least <= whole * (1.0 + 1e-6) && whole <= most * (1.0 + 1e-6), "{least} {whole} {most}");
    }

    #[test]
    fn a_cut_has_its_share_of_the_mass_below(
        width in 1..30usize, height in 1..30usize, seed in 0..1000u64, axis in 0..2usize, share in 0.0..1.0f64,
    ) {
        let domain = domain([1.0, 1.5], false);
        let field = noise(width, height, seed).field(&domain).unwrap();
        let mut random = Random::new(seed, 3);
        let mut place = || DVec2::new(random.unit(), random.unit()) * domain.size;
        let (a, b) = (place(), place());
        let (low, high) = (a.min(b), a.max(b));
        let cut = field.cut(low, high, axis, share);
        let mut below = high;
        below[axis] = cut;
        let (whole, part) = (field.mass_in(low, high), field.mass_in(low, below));
        prop_assert!(cut >= low[axis] && cut <= high[axis] && (part - share * whole).abs() < 1e-9, "{part} {}", share * whole);
    }

    #[test]
    fn a_place_without_density_settles_at_the_nearest_that_has_some(
        width in 1..30usize, height in 1..30usize, seed in 0..1000u64, is_periodic: bool, n_full in 1..4usize,
    ) {
        let domain = domain([1.0, 1.0], is_periodic);
        let mut random = Random::new(seed, 4);
        let mut values = vec![0.0; width * height];
        for _ in 0..n_full {
            values[(random.unit() * (width * height) as f64) as usize] = 1.0;
        }
        let field = Density::image(width, height, &values).unwrap().field(&domain).unwrap();
        let place = DVec2::new(random.unit(), random.unit());
        let settled = domain.land(field.settle(place));
        prop_assert!(field.at(settled) > 0.0);
        let distance = domain.spoke(place, settled).length();
        // Nearer than any other place in a full pixel, to a part of a pixel.
        for _ in 0..200 {
            let mass = random.unit();
            let other = field.place(mass, random.unit());
            prop_assert!(field.at(other) > 0.0);
            prop_assert!(distance <= domain.spoke(place, other).length() + 0.5 / width.min(height) as f64);
        }
    }
}

#[test]
fn a_picture_has_its_first_row_at_the_top() {
    let domain = domain([1.0, 1.0], false);
    let field = Density::image(2, 2, &[1.0, 2.0, 3.0, 6.0]).unwrap().field(&domain).unwrap();
    let at = |x, y| field.at(DVec2::new(x, y)) * 3.0;
    assert_eq!([at(0.2, 0.8), at(0.7, 0.9), at(0.1, 0.3), at(0.9, 0.1)], [1.0, 2.0, 3.0, 6.0]);
    let space: Space = Rectangle::new([10.0, -5.0], [2.0, 4.0]).unwrap().into();
    let function = Density::function(&space, 1, 2, |p| p[1] + 5.0).unwrap();
    let field = function.field(&space.domain()).unwrap();
    assert!((field.at(DVec2::new(0.1, 1.1)) - 1.5).abs() < 1e-6 && (field.at(DVec2::new(0.1, 0.1)) - 0.5).abs() < 1e-6);
    assert_eq!(function.resampled(1, 1), [1.0]);
    assert_eq!(Density::image(4, 1, &[1.0, 1.0, 3.0, 3.0]).unwrap().resampled(2, 1), [0.5, 1.5]);
}

#[test]
fn wrong_pictures_are_errors() {
    for (width, height, values) in [
        (0, 1, vec![]),
        (2, 2, vec![1.0; 3]),
        (1, 1, vec![0.0]),
        (1, 2, vec![1.0, -1.0]),
        (1, 2, vec![1.0, f32::NAN]),
        (1, 2, vec![1.0, f32::INFINITY]),
        (30_000, 30_000, vec![]),
        (usize::MAX, 2, vec![]),
    ] {
        assert!(Density::image(width, height, &values).is_err(), "{width} {height}");
    }
    let space: Space = Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap().into();
    assert!(Density::function(&space, 10, 10, |_| f64::NAN).is_err() && Density::function(&space, 0, 3, |_| 1.0).is_err());
    assert!(Density::function(&space, 1 << 20, 1 << 20, |_| 1.0).is_err());
}
