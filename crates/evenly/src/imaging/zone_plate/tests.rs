//! Laws of zone plates, and the order of methods that Push-Pull's figure 5 shows.

use super::*;
use crate::{
    CvtParams, FarthestPointParams, PushPullParams, Rectangle, RunContext, Torus, cvt, farthest_point, hexagonal, jittered,
    poisson_disk_of, push_pull, warp_isotropic, white,
};

fn unit() -> Torus {
    Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap()
}

#[test]
fn slow_waves_come_through_and_no_error_of_constants_is_left() {
    let plate = Plate { pixels: 64, filter: ReconstructionFilter::Mitchell, chirp: 1e-3 };
    let exact = |index: usize| {
        let [x, y] = plate.middle(index);
        (plate.chirp * (x * x + y * y)).sin()
    };
    let ideal = plate.ideal();
    assert!((0..ideal.len()).all(|index| (ideal[index] - exact(index)).abs() < 0.01));
    let grid = (0..66 * 66).map(|k| [(k % 66) as f64 - 0.5, (k / 66) as f64 - 0.5]).collect::<Vec<_>>();
    let (sampled, n_empty) = plate.sample(&grid);
    assert!(n_empty == 0 && (0..ideal.len()).all(|index| (ideal[index] - sampled[index]).abs() < 0.01));
}

#[test]
fn noise_and_aliasing_order_the_methods_as_the_paper_does() {
    const N: usize = 4096;
    let run = RunContext::default;
    let noise = white(unit(), N, 3).unwrap();
    let mut warped = noise.clone();
    warp_isotropic(&mut warped);
    let pushed = |min_distance: f64, coverage_radius: f64| {
        let mut points = warped.clone();
        let params =
            PushPullParams { min_distance: Some(min_distance), coverage_radius: Some(coverage_radius), ..PushPullParams::default() };
        push_pull(&mut points, &params, &mut run()).unwrap();
        points
    };
    let mut far = warped.clone();
    farthest_point(&mut far, &FarthestPointParams { min_distance: Some(0.92), ..FarthestPointParams::default() }, &mut run()).unwrap();
    let mut centroidal = noise.clone();
    cvt(&mut centroidal, &CvtParams::default(), &mut run()).unwrap();
    let of = |points: &PointSet| {
        let plate = zone_plate(points, &ZonePlateParams::default()).unwrap();
        assert!(plate.image.width() == 512 && plate.error > plate.noise);
        (plate.noise, plate.aliasing)
    };
    let falls = |plates: &[(f64, f64)]| plates.windows(2).all(|pair| pair[0].0 > pair[1].0);
    let rises = |plates: &[(f64, f64)]| plates.windows(2).all(|pair| pair[0].1 < pair[1].1);

    // A larger smallest distance: less noise, more aliasing.
    let by_distance = [of(&pushed(0.75, 0.67)), of(&pushed(0.85, 0.67)), of(&pushed(0.92, 0.67))];
    assert!(falls(&by_distance) && rises(&by_distance), "{by_distance:?}");
    // A smaller coverage radius: less noise as well, and less aliasing for it.
    let by_coverage = [of(&pushed(0.75, 0.75)), of(&pushed(0.75, 0.67)), of(&pushed(0.75, 0.63))];
    assert!(falls(&by_coverage), "{by_coverage:?}");
    assert!(by_coverage[2].0 < 1.05 * by_distance[1].0 && by_coverage[2].1 < by_distance[2].1, "{by_coverage:?} {by_distance:?}");
    // All methods.
    let maximal = of(&poisson_disk_of(unit(), N, 3).unwrap());
    let all = [of(&noise), of(&jittered(unit(), N, 3).unwrap()), maximal, by_distance[1], by_distance[2], of(&centroidal)];
    assert!(falls(&all) && rises(&all), "{all:?}");
    let (far, tough) = (of(&far), of(&pushed(0.9, 0.65)));
    assert!(far.1 > tough.1 && far.0 < maximal.0 && far.1 < of(&centroidal).1, "{far:?} {tough:?}");
    // A lattice is all pattern.
    assert!(of(&hexagonal(unit(), N).unwrap()).1 > all[5].1);
}

#[test]
fn a_rectangle_holds_so_many_pixels_and_wrong_parameters_are_errors() {
    let rectangle = Rectangle::new([0.0, 0.0], [2.0, 1.0]).unwrap();
    let points = white(rectangle, 2 * 64 * 64, 1).unwrap();
    let with = |pixels: usize| zone_plate(&points, &ZonePlateParams { pixels, ..ZonePlateParams::default() });
    assert!(with(64).is_ok() && with(65).unwrap_err().to_string().contains("128 x 64"));
    let one = PointSet::new(unit(), vec![[0.3, 0.4]]).unwrap();
    assert!(zone_plate(&one, &ZonePlateParams::default()).unwrap().aliasing > 1.0);
    assert!(zone_plate(&PointSet::new(unit(), vec![]).unwrap(), &ZonePlateParams::default()).is_err());
    for (pixels, max_frequency) in [(15, 1.0), (4097, 1.0), (64, 0.0), (64, f64::NAN), (64, 9.0)] {
        assert!(zone_plate(&one, &ZonePlateParams { pixels, max_frequency, ..ZonePlateParams::default() }).is_err());
    }
}
