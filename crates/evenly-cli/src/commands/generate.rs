//! `evenly generate`: points from nothing.

use std::process::ExitCode;

use evenly::{PointSet, Space, hexagonal, jittered, white};

use crate::args::{Generate, GenerateMethod, Start};
use crate::optimizer_args::{OPTIMIZERS, refuse};
use crate::session::Session;

pub fn run(args: &Generate) -> anyhow::Result<ExitCode> {
    let space = args.space.space()?;
    let (optimizer, start) = match args.method {
        GenerateMethod::Procrustes => (Some(args.optimizer.procrustes()?), args.start.unwrap_or(Start::White)),
        GenerateMethod::PushPull => (Some(args.optimizer.push_pull(args.seed)?), args.start.unwrap_or(Start::White)),
        GenerateMethod::WellSpaced => (Some(args.optimizer.well_spaced(args.seed)?), args.start.unwrap_or(Start::White)),
        GenerateMethod::White => (None, Start::White),
        GenerateMethod::Jittered => (None, Start::Jittered),
        GenerateMethod::Hexagonal => (None, Start::Hexagonal),
    };
    if optimizer.is_none() {
        args.optimizer.none()?;
        refuse(args.start.map(|_| "start"), OPTIMIZERS)?;
    }
    let mut session = Session::new(&args.run, Some(args.seed))?;
    let points = session.time("start", || begin(start, space, args.n_points, args.seed))?;
    match optimizer {
        // Only white noise has long density waves.
        Some(optimizer) => session.optimize(points, optimizer, start == Start::White && !args.optimizer.no_warp),
        None => {
            let name = clap::ValueEnum::to_possible_value(&args.method).map_or_else(String::new, |value| value.get_name().to_owned());
            session.finish(points, &name, None)
        }
    }
}

fn begin(start: Start, space: Space, n_points: usize, seed: u64) -> Result<PointSet, evenly::Error> {
    match start {
        Start::White => white(space, n_points, seed),
        Start::Jittered => jittered(space, n_points, seed),
        Start::Hexagonal => hexagonal(space, n_points),
    }
}
