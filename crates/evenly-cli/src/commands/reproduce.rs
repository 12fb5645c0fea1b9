//! `evenly reproduce`: a paper's tables and figures, recomputed beside the printed numbers.

use anyhow::Context as _;
use evenly::CancelToken;
use evenly_io::{Scraps, Target, make_folder};
use serde_json::json;

use crate::measuring_args::Reproduce;
use crate::reproduce::{Done, Lab, STUDIES, html};
use crate::talk::say;
use crate::{interrupt, record, session, watch};

pub fn run(args: &Reproduce) -> anyhow::Result<u8> {
    let study = STUDIES.iter().find(|study| study.name == args.paper).context("no such paper")?;
    let name = format!("{}{}", study.name, if args.quick { "-quick" } else { "" });
    let scraps = Scraps::new(&args.output.join(format!("{name}.parts")));
    make_folder(&args.output)?;
    // A run that was interrupted left pages that are not whole: it may replace its own.
    let may_overwrite = args.run.force || scraps.exist();
    let [page, data] = ["html", "json"].map(|ending| Target::any(&args.output.join(format!("{name}.{ending}")), may_overwrite));
    let (page, data) = (page?, data?);
    if args.run.force {
        scraps.clear()?;
    } else if scraps.exist() && !args.run.quiet {
        say(format_args!("going on where an earlier run was interrupted; --force starts again"));
    }
    let cancel = CancelToken::default();
    interrupt::cancels(&cancel, args.run.quiet);
    let bar = watch::bar(args.run.quiet, study.parts.len() as u64, "{prefix} [{bar:20}] {pos} of {len} parts, {elapsed}: {msg}");
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    let lab = Lab { is_quick: args.quick, cancel, bar, models: args.models.clone() };
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let done = pool.install(|| study.run(&lab, &scraps))?;
    lab.bar.finish_and_clear();
    if done.is_empty() {
        say("no part is done, so there is nothing to show");
        return Ok(interrupt::code());
    }
    page.write(html(study, &done, args.quick).as_bytes())?;
    let parts: Vec<&Done> = done.iter().collect();
    let record = json!({ "version": record::VERSION, "command": record::command(), "paper": study.name, "is_quick": args.quick, "parts": without_pictures(&parts)? });
    data.write((serde_json::to_string_pretty(&record)? + "\n").as_bytes())?;
    if done.len() < study.parts.len() {
        say(format_args!(
            "{} of {} parts are done; the same command, without --force, goes on with the others",
            done.len(),
            study.parts.len()
        ));
        return Ok(interrupt::code());
    }
    scraps.clear()?;
    if !args.run.quiet {
        let seconds: f64 = done.iter().map(|done| done.part.seconds).sum();
        say(format_args!("{} and {}: {} parts, {seconds:.0} s", page.name(), data.name(), done.len()));
    }
    Ok(session::DONE)
}

/// The numbers alone: pictures are in the page.
fn without_pictures(parts: &[&Done]) -> anyhow::Result<serde_json::Value> {
    let mut value = serde_json::to_value(parts)?;
    for figure in value.as_array_mut().into_iter().flatten().filter_map(|part| part["figures"].as_array_mut()).flatten() {
        if let Some(figure) = figure.as_object_mut() {
            figure.remove("svg");
        }
    }
    Ok(value)
}
