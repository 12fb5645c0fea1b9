//! `evenly generate`: points from nothing.

use std::process::ExitCode;

use evenly::{PointSet, Space, hexagonal, jittered, white};

use crate::args::{Generate, GenerateMethod, Start};
use crate::session::Session;

pub fn run(args: &Generate) -> anyhow::Result<ExitCode> {
    let space = args.space.space()?;
    args.procrustes.params().validate()?;
    let mut session = Session::new(&args.run, Some(args.seed))?;
    let start = match args.method {
        GenerateMethod::Procrustes => args.start,
        GenerateMethod::White => Start::White,
        GenerateMethod::Jittered => Start::Jittered,
        GenerateMethod::Hexagonal => Start::Hexagonal,
    };
    let points = session.time("start", || begin(start, space, args.n_points, args.seed))?;
    if args.method != GenerateMethod::Procrustes {
        let name = clap::ValueEnum::to_possible_value(&args.method).map_or_else(String::new, |value| value.get_name().to_owned());
        return session.finish(points, &name, None);
    }
    // Only white noise has long density waves.
    let is_warped = start == Start::White && !args.procrustes.no_warp;
    session.procrustes(points, &args.procrustes.params(), is_warped)
}

fn begin(start: Start, space: Space, n_points: usize, seed: u64) -> Result<PointSet, evenly::Error> {
    match start {
        Start::White => white(space, n_points, seed),
        Start::Jittered => jittered(space, n_points, seed),
        Start::Hexagonal => hexagonal(space, n_points),
    }
}
