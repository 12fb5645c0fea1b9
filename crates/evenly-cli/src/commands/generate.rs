//! `evenly generate`: points from nothing.

use anyhow::Context as _;
use clap::ArgMatches;

use crate::args::Generate;
use crate::input;
use crate::memory;
use crate::method::{Method, refuse_others_flags};
use crate::method_args::start_around;
use crate::session::Session;

pub fn run(args: &Generate, flags: &ArgMatches) -> anyhow::Result<u8> {
    refuse_others_flags(&[args.method], flags)?;
    let space = args.space.space()?;
    input::require_one_stdin(args.density.path().into_iter().chain(args.space.path()).chain(args.fixed.path()))?;
    let optimizer = args.optimizer.optimizer(args.method, args.seed)?;
    let mut session = Session::new(&args.run, Some(args.seed))?;
    if let Some(n_points) = args.n_points {
        memory::require_points(n_points, args.method)?;
    }
    let begin = args.start.unwrap_or(args.method.default_start(&space, args.density.is_given()));
    if args.density.is_given() && optimizer.is_some() {
        begin.require_density()?;
    }
    let density = session.time("read", || args.density.density())?;
    let given = args.fixed.points(space)?.with_density(&density);
    let fixed = args.metric.applied(given.clone())?;
    session.restores_to = args.metric.is_unit().then_some(given);
    match optimizer {
        Some(optimizer) => {
            let n_points = args.n_points.context("--n-points is missing: how many?")?;
            let points = session.time("start", || start_around(&fixed, begin, n_points, args.seed))?;
            // Only white noise has long density waves.
            session.optimize(points, args.method, optimizer, begin == Method::White && !args.optimizer.no_warp)
        }
        None => {
            let (points, note) = session.time("start", || args.starts.make(args.method, &fixed, args.n_points, args.seed))?;
            if let Some(note) = note {
                session.note(note);
            }
            session.finish(points, args.method, None)
        }
    }
}
