//! The first triangulation and what is measured on it, of points on a grid.
#![no_main]

mod shapes;

use evenly::{PointSet, Rectangle, Space, Torus, measure, measure_each};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some(([kind, width], rest)) = shapes::split(data) else { return };
    let size = [1.0 + f64::from(width), 1.0];
    let space: Space =
        if kind % 2 == 0 { Torus::new([0.0; 2], size).unwrap().into() } else { Rectangle::new([0.0; 2], size).unwrap().into() };
    let Ok(points) = PointSet::new(&space, shapes::places(rest)) else { return };
    drop(measure(&points));
    drop(measure_each(&points));
});
