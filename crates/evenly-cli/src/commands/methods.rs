//! `evenly methods`: the registry, for people and as JSON.

use std::fmt::Write as _;

use anyhow::Context as _;
use evenly::{Method, ParameterKind};
use evenly_io::{Format, Target};
use evenly_jobs::{default_of, jobs_of, registry};

use crate::args::Methods;
use crate::session::DONE;

pub fn run(args: &Methods) -> anyhow::Result<u8> {
    let text = match (&args.name, args.json) {
        (_, true) => serde_json::to_string_pretty(&registry())? + "\n",
        (Some(name), false) => one(Method::named(name).with_context(|| format!("{name:?} is no method; evenly methods lists them"))?),
        (None, false) => table(),
    };
    Target::new("-".as_ref(), Some(Format::Txt), false)?.write(text.as_bytes())?;
    Ok(DONE)
}

const COLUMNS: [&str; 7] = ["generate", "optimize", "stipple", "mesh", "remesh", "sample", "density"];

/// All methods in a table, which is Markdown as well.
pub fn table() -> String {
    let mut text = format!("| {:<14} | {} | what it does |\n|{}|", "method", COLUMNS.join(" | "), "-".repeat(16));
    COLUMNS.iter().for_each(|column| text += &format!("{}|", "-".repeat(column.len() + 2)));
    text += "---|\n";
    for method in Method::all() {
        let jobs = jobs_of(method);
        let cells = COLUMNS.map(|column| format!("{:^width$}", if jobs.contains(&column) { "x" } else { "" }, width = column.len()));
        let _ = writeln!(text, "| {:<14} | {} | {} |", method.name(), cells.join(" | "), method.title());
    }
    text
}

/// One method, with its parameters.
fn one(method: Method) -> String {
    let mut text = format!("{}: {}\n", method.name(), method.title());
    if !method.paper().is_empty() {
        let _ = writeln!(text, "paper: {}", method.paper());
    }
    let _ = writeln!(text, "for: {}", jobs_of(method).join(", "));
    for (about, default) in method.parameters() {
        let default = default_of(&about, default.as_ref()).map_or_else(String::new, |default| format!(" [{default}]"));
        let _ = writeln!(text, "  --{:<20} {}{default}", about.name.replace('_', "-"), about.doc);
        if let ParameterKind::Choice(choices) = about.kind {
            choices.iter().for_each(|choice| text += &format!("  {:24} {}: {}\n", "", choice.name, choice.doc));
        }
        if !about.details.is_empty() {
            let _ = writeln!(text, "  {:22} {}", "", about.details);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manual_has_the_table() {
        assert!(
            include_str!("../../../../docs/methods.md").contains(&table()),
            "docs/methods.md must have what `evenly methods` prints:\n{}",
            table()
        );
    }

    #[test]
    fn every_method_is_told_by_itself() {
        for method in Method::all() {
            let told = one(method);
            assert!(method.parameters().iter().all(|(about, _)| told.contains(about.doc)), "{told}");
        }
    }
}
