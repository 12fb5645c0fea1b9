//! `evenly optimize`: better points from points.

use evenly_io::Columns;
use evenly_jobs::Message;

use crate::args::Optimize;
use crate::files::{Files, require_one_stdin};
use crate::session::Session;
use crate::wording::told;

pub fn run(args: &Optimize) -> anyhow::Result<u8> {
    let mut files = Files::default();
    let request = args.request(&mut files)?;
    request.check().map_err(told)?;
    let mut session = Session::new(&args.run, None)?;
    let all = std::iter::once(&args.input).chain(args.space.path()).chain(&args.fixed.fixed);
    require_one_stdin(all.chain(&args.density.path()))?;
    let outcome = session.run(|context| request.run(&mut files, context))?;
    // With points that stay, rows have other places.
    let is_same_rows = outcome.points.n_fixed() == 0;
    if !is_same_rows && !files.columns.is_empty() {
        let columns = Message::from(format!("the columns {} are left out: with ", files.columns.names.join(", ")));
        session.note(&columns.name("fixed").text(" rows have other places"));
    }
    session.finish(&outcome, if is_same_rows { files.columns } else { Columns::default() })
}
