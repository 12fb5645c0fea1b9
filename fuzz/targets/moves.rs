//! Live moves: some passes of each optimiser, of points on a grid.
#![no_main]

mod shapes;

use evenly::{
    CvtParams, LloydParams, PointSet, ProcrustesParams, PushPullParams, Rectangle, RunContext, Space, Torus, cvt, lloyd, procrustes,
    push_pull,
};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some(([kind, width], rest)) = shapes::split(data) else { return };
    let size = [1.0 + f64::from(width / 16), 1.0];
    let space: Space =
        if kind % 2 == 0 { Torus::new([0.0; 2], size).unwrap().into() } else { Rectangle::new([0.0; 2], size).unwrap().into() };
    let Ok(mut points) = PointSet::new(&space, shapes::places(&rest[..rest.len().min(200)])) else { return };
    let n_points = points.n_points();
    let mut run = RunContext::default();
    let done = match kind / 2 % 4 {
        0 => push_pull(&mut points, &PushPullParams { max_passes: Some(30), ..Default::default() }, &mut run),
        1 => procrustes(&mut points, &ProcrustesParams { max_iterations: 10, ..Default::default() }, &mut run),
        2 => lloyd(&mut points, &LloydParams { iterations: 10, ..Default::default() }, &mut run),
        _ => cvt(&mut points, &CvtParams { iterations: 10, ..Default::default() }, &mut run),
    };
    if done.is_ok() {
        assert!(points.n_points() == n_points && points.positions().iter().flatten().all(|x| x.is_finite()));
    }
});
