//! `evenly optimize`: better points from points.

use anyhow::bail;
use clap::ArgMatches;
use evenly::warp;

use crate::args::Optimize;
use crate::input;
use crate::memory;
use crate::method::{Method, refuse_others_flags};
use crate::session::Session;

pub fn run(args: &Optimize, flags: &ArgMatches) -> anyhow::Result<u8> {
    refuse_others_flags(&[args.method], flags)?;
    let space = args.space.space()?;
    if args.method == Method::Warp && space.region().is_some() {
        bail!("--method warp moves points by a rectangle's sides; in a polygon it would do nothing");
    }
    let optimizer = args.optimizer.optimizer(args.method, args.seed)?;
    let mut session = Session::new(&args.run, None)?;
    input::require_one_stdin(std::iter::once(&args.input).chain(args.density.path()).chain(args.space.path()).chain(args.fixed.path()))?;
    let fixed = args.fixed.points(space.clone())?;
    let (points, note, columns) = session.time("read", || input::read_with_columns(&args.input, &space))?;
    if fixed.n_points() == 0 {
        session.columns = columns;
    } else if !columns.is_empty() {
        session.note(format!("the columns {} are left out: with --fixed rows have other places", columns.names.join(", ")));
    }
    let points = input::joined(&fixed, points)?;
    memory::require_points(points.n_points(), args.method)?;
    let given = points.with_density(&session.time("read", || args.density.density())?);
    let mut points = args.metric.applied(given.clone())?;
    session.restores_to = args.metric.is_unit().then_some(given);
    if let Some(note) = note {
        session.note(note);
    }
    match optimizer {
        Some(optimizer) => session.optimize(points, args.method, optimizer, !args.optimizer.no_warp),
        None => {
            session.time("warp", || warp(&mut points));
            session.finish(points, args.method, None)
        }
    }
}
