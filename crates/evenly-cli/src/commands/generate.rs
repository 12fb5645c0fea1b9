//! `evenly generate`: points from nothing.

use evenly_io::Columns;

use crate::args::Generate;
use crate::files::{Files, require_one_stdin};
use crate::session::Session;
use crate::wording::told;

pub fn run(args: &Generate) -> anyhow::Result<u8> {
    let mut files = Files::default();
    let request = args.request(&mut files)?;
    request.check().map_err(told)?;
    require_one_stdin(args.density.path().iter().chain(args.space.path()).chain(&args.fixed.fixed))?;
    let mut session = Session::new(&args.run, Some(args.seed))?;
    let outcome = session.run(|context| request.run(&mut files, context))?;
    session.finish(&outcome, Columns::default())
}
