//! `evenly optimize`: better points from points.

use std::process::ExitCode;

use anyhow::Context as _;
use evenly::{PointSet, Space, warp};

use crate::args::{Optimize, OptimizeMethod};
use crate::session::Session;

pub fn run(args: &Optimize) -> anyhow::Result<ExitCode> {
    let space = args.space.space()?;
    let mut session = Session::new(&args.run, None)?;
    let points = session.time("read", || read(&args.input, space))?;
    if let Some(note) = wrapped_note(&points.1, &space) {
        session.note(note);
    }
    match args.method {
        OptimizeMethod::Procrustes => session.procrustes(points.0, &args.procrustes.params(), !args.procrustes.no_warp),
        OptimizeMethod::Warp => {
            let mut points = points.0;
            session.time("warp", || warp(&mut points));
            session.finish(points, "warp", None)
        }
    }
}

/// Reads points into a domain; also how many of them lay outside and were wrapped.
pub fn read(input: &std::path::Path, space: Space) -> anyhow::Result<(PointSet, usize)> {
    let positions = evenly_io::read_positions(input)?;
    let n_outside = positions.iter().filter(|p| is_outside(&space, p)).count();
    let points = PointSet::new(space, positions).with_context(|| input.display().to_string())?;
    Ok((points, n_outside))
}

fn is_outside(space: &Space, p: &[f64; 2]) -> bool {
    let (origin, size) = (space.origin(), space.size());
    (0..2).any(|axis| p[axis] < origin[axis] || p[axis] > origin[axis] + size[axis])
}

/// What to say of points that were wrapped onto the torus.
pub fn wrapped_note(n_outside: &usize, space: &Space) -> Option<String> {
    (*n_outside > 0)
        .then(|| format!("{n_outside} points lie outside the torus {space} and were wrapped into it; are --size and --origin right?"))
}
