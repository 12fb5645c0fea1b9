//! `evenly compare`: several methods on the same points.

use anyhow::bail;
use evenly::CancelToken;
use evenly_io::{Draw, Subject, Target, figure};
use evenly_jobs::Ending;

use crate::args::Compare;
use crate::comparison::Comparison;
use crate::files::{Files, require_one_stdin};
use crate::table::Kind;
use crate::watch::Watch;
use crate::{interrupt, record, session};

/// Points in a method's picture.
const SHOWN: usize = 600;

pub fn run(args: &Compare) -> anyhow::Result<u8> {
    let mut files = Files::default();
    let request = args.request(&mut files)?;
    require_one_stdin(args.input.iter().chain(args.space.path()).chain(&args.density.path()))?;
    let output = match &args.output {
        Some(path) => Some((Kind::of_path(path)?, Target::any(path, args.run.force)?)),
        None => None,
    };
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let cancel = CancelToken::default();
    let mut watch = Watch::new("{msg} [{bar:30}] {pos} of {len} runs", &cancel, args.run.quiet);
    let made = watch.run(&pool, |context| request.run(&mut files, context))?;
    if made.columns.is_empty() && made.is_cancelled {
        return Ok(interrupt::code());
    }
    if made.columns.is_empty() {
        bail!("no run was done, so there is nothing to compare");
    }
    let is_drawn = matches!(output, Some((Kind::Html, _)));
    let pictures = made.columns.iter().map(|column| {
        let (first, seed) = (column.first.as_ref().filter(|_| is_drawn)?, column.runs.first()?.seed);
        let subject = Subject { most_points: Some(SHOWN), ..first.into() };
        figure(&subject, &[Draw::Points], &record::recipe(Some(seed))).ok()
    });
    let pictures = pictures.collect();
    let is_cancelled = made.is_cancelled;
    let comparison = Comparison::new(made, pictures);
    let text = |kind: Kind| kind.write(&comparison);
    match &output {
        Some((kind, target)) => target.write(text(*kind)?.as_bytes())?,
        None => Target::any("-".as_ref(), false)?.write(text(Kind::Text)?.as_bytes())?,
    }
    // Targets that are missed are no failure here.
    Ok(session::code(if is_cancelled { Ending::Cancelled } else { Ending::Done }))
}
