//! `evenly optimize`: better points from points.

use std::process::ExitCode;

use evenly::warp;

use crate::args::{Optimize, OptimizeMethod};
use crate::input;
use crate::session::Session;

pub fn run(args: &Optimize) -> anyhow::Result<ExitCode> {
    let space = args.space.space()?;
    args.procrustes.params().validate()?;
    let mut session = Session::new(&args.run, None)?;
    let (mut points, note) = session.time("read", || input::read(&args.input, space))?;
    if let Some(note) = note {
        session.note(note);
    }
    match args.method {
        OptimizeMethod::Procrustes => session.procrustes(points, &args.procrustes.params(), !args.procrustes.no_warp),
        OptimizeMethod::Warp => {
            session.time("warp", || warp(&mut points));
            session.finish(points, "warp", None)
        }
    }
}
