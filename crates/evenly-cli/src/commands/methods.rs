//! `evenly methods`: the registry, for people and as JSON.

use std::fmt::Write as _;

use anyhow::Context as _;
use evenly::{About, Method, ParameterKind, Setting};
use evenly_io::{Format, Target};
use serde_json::{Value, json};

use crate::args::Methods;
use crate::method::{ByDensity, Offered, OnMeshes, OnSurfaces};
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

/// What a method can do, by the commands' names; `density` where its points follow one.
fn jobs(method: Method) -> Vec<&'static str> {
    let points: &[&str] = if method.is_optimizer() { &["generate", "optimize"] } else { &["generate"] };
    let others = [
        ("stipple", ByDensity::is_offered(method)),
        ("mesh", OnMeshes::is_offered(method)),
        ("remesh", OnMeshes::is_offered(method)),
        ("sample", OnSurfaces::is_offered(method)),
        ("density", method.knows_density()),
    ];
    points.iter().copied().chain(others.into_iter().filter(|(_, is)| *is).map(|(name, _)| name)).collect()
}

const COLUMNS: [&str; 7] = ["generate", "optimize", "stipple", "mesh", "remesh", "sample", "density"];

/// All methods in a table, which is Markdown as well.
pub fn table() -> String {
    let mut text = format!("| {:<14} | {} | what it does |\n|{}|", "method", COLUMNS.join(" | "), "-".repeat(16));
    COLUMNS.iter().for_each(|column| text += &format!("{}|", "-".repeat(column.len() + 2)));
    text += "---|\n";
    for method in Method::all() {
        let jobs = jobs(method);
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
    let _ = writeln!(text, "for: {}", jobs(method).join(", "));
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

/// A parameter's value where none is given, in words.
fn default_of(about: &About, default: Option<&Setting>) -> Option<String> {
    if about.default.is_empty() { default.map(ToString::to_string) } else { Some(about.default.into()) }
}

/// All methods, as JSON.
pub fn registry() -> Value {
    let parameter = |(about, default): (About, Option<Setting>)| {
        let (kind, choices) = match about.kind {
            ParameterKind::Number => ("number", None),
            ParameterKind::Target => ("target", None),
            ParameterKind::Count => ("count", None),
            ParameterKind::Flag => ("flag", None),
            ParameterKind::Choice(choices) => ("choice", Some(choices.iter().map(|choice| choice.name).collect::<Vec<_>>())),
        };
        json!({ "name": about.name, "kind": kind, "choices": choices, "default": default_of(&about, default.as_ref()), "doc": about.doc })
    };
    let method = |method: Method| {
        let parameters: Vec<Value> = method.parameters().into_iter().map(parameter).collect();
        json!({ "name": method.name(), "title": method.title(), "paper": method.paper(), "jobs": jobs(method), "parameters": parameters })
    };
    Method::all().map(method).collect()
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
