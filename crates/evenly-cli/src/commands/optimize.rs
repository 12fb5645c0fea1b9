//! `evenly optimize`: better points from points.

use anyhow::Context as _;

use crate::args::Optimize;
use crate::input;
use crate::memory;
use crate::method::{by_flag, refuse_beginning, refuse_density};
use crate::session::Session;

pub fn run(args: &Optimize) -> anyhow::Result<u8> {
    args.optimizer.refuse_others(&[args.method])?;
    refuse_beginning(args.method, false, args.warp.no_warp)?;
    if args.density.is_given() {
        refuse_density(args.method)?;
    }
    let space = args.space.space()?;
    let optimizer = args.method.optimizer(&args.optimizer.of(args.method), args.seed).map_err(by_flag)?;
    let optimizer = optimizer.with_context(|| format!("{} makes points, and improves none", args.method))?;
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
    let points = args.metric.applied(given.clone())?;
    session.restores_to = args.metric.is_unit().then_some(given);
    if let Some(note) = note {
        session.note(note);
    }
    session.optimize(points, optimizer, !args.warp.no_warp)
}
