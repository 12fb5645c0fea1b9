//! `evenly generate`: points from nothing.

use crate::args::Generate;
use crate::input;
use crate::memory;
use crate::method::{by_flag, refuse_beginning, refuse_density, require_density};
use crate::session::Session;
use anyhow::Context as _;

pub fn run(args: &Generate) -> anyhow::Result<u8> {
    args.optimizer.refuse_others(&[args.method])?;
    args.starts.refuse_others(&[args.method])?;
    refuse_beginning(args.method, args.start.is_some(), args.warp.no_warp)?;
    let space = args.space.space()?;
    input::require_one_stdin(args.density.path().into_iter().chain(args.space.path()).chain(args.fixed.path()))?;
    let optimizer = args.method.optimizer(&args.told(), args.seed).map_err(by_flag)?;
    let mut session = Session::new(&args.run, Some(args.seed))?;
    if let Some(n_points) = args.n_points {
        memory::require_points(n_points, args.method)?;
    }
    let begin = args.start.unwrap_or(args.method.default_start(&space, args.density.is_given()));
    if args.density.is_given() && optimizer.is_some() {
        require_density(begin)?;
    }
    if args.density.is_given() {
        refuse_density(args.method)?;
    }
    let density = session.time("read", || args.density.density())?;
    let given = args.fixed.points(space)?.with_density(&density);
    let fixed = args.metric.applied(given.clone())?;
    session.restores_to = args.metric.is_unit().then_some(given);
    match optimizer {
        Some(optimizer) => {
            let n_points = args.n_points.context("--n-points is missing: how many?")?;
            let points = session.time("start", || begin.start(&fixed, n_points, args.seed)).map_err(by_flag)?;
            // Only white noise has long density waves.
            session.optimize(points, optimizer, begin.has_long_waves() && !args.warp.no_warp)
        }
        None => {
            let (points, note) =
                session.time("start", || args.method.make(&args.told(), &fixed, args.n_points, args.seed)).map_err(by_flag)?;
            if let Some(note) = note {
                session.note(note);
            }
            session.finish(points, args.method, None)
        }
    }
}
