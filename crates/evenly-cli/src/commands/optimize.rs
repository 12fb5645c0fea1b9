//! `evenly optimize`: better points from points.

use std::process::ExitCode;

use evenly::warp;

use crate::args::{Optimize, OptimizeMethod};
use crate::input;
use crate::session::Session;

pub fn run(args: &Optimize) -> anyhow::Result<ExitCode> {
    let space = args.space.space()?;
    let optimizer = match args.method {
        OptimizeMethod::Procrustes => Some(args.optimizer.procrustes()?),
        OptimizeMethod::PushPull => Some(args.optimizer.push_pull(args.seed)?),
        OptimizeMethod::WellSpaced => Some(args.optimizer.well_spaced(args.seed)?),
        OptimizeMethod::Warp => {
            args.optimizer.none()?;
            None
        }
    };
    let mut session = Session::new(&args.run, None)?;
    let (mut points, note) = session.time("read", || input::read(&args.input, space))?;
    if let Some(note) = note {
        session.note(note);
    }
    match optimizer {
        Some(optimizer) => session.optimize(points, optimizer, !args.optimizer.no_warp),
        None => {
            session.time("warp", || warp(&mut points));
            session.finish(points, "warp", None)
        }
    }
}
