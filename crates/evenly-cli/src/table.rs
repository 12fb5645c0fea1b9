//! A comparison as a table: plain text, Markdown, CSV, JSON or a page.

use std::fmt::Write as _;
use std::path::Path;

use anyhow::bail;

use crate::comparison::{Comparison, numbers, shown, spread};
use crate::page::page;

/// A kind of table.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Text,
    Markdown,
    Csv,
    Json,
    Html,
}

/// Methods side by side in plain text, before the next go below.
const ABREAST: usize = 5;

impl Kind {
    pub fn of_path(path: &Path) -> anyhow::Result<Self> {
        let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
        Ok(match ending.as_deref() {
            Some("md") => Self::Markdown,
            Some("csv") => Self::Csv,
            Some("json") => Self::Json,
            Some("html") => Self::Html,
            _ => bail!("{}: unknown ending; use one of .md .csv .json .html", path.display()),
        })
    }

    pub fn write(self, comparison: &Comparison) -> anyhow::Result<String> {
        Ok(match self {
            Self::Text => text(comparison),
            Self::Markdown => markdown(comparison),
            Self::Csv => csv(comparison),
            Self::Json => serde_json::to_string_pretty(comparison)? + "\n",
            Self::Html => page(comparison),
        })
    }
}

fn text(comparison: &Comparison) -> String {
    let mut text = comparison.title() + "\n";
    let names = comparison.names();
    for columns in comparison.columns.chunks(ABREAST) {
        let heads = columns.iter().map(|column| column.method.clone());
        let rows = names.iter().map(|name| (name.clone(), columns.iter().map(|column| shown(spread(column, name))).collect()));
        let rows: Vec<(String, Vec<String>)> = std::iter::once((String::new(), heads.collect())).chain(rows).collect();
        text.push('\n');
        for (name, cells) in rows {
            let _ = write!(text, "{name:<23}");
            cells.iter().for_each(|cell| {
                let _ = write!(text, " {cell:>17}");
            });
            text.truncate(text.trim_end().len());
            text.push('\n');
        }
    }
    text
}

fn markdown(comparison: &Comparison) -> String {
    let mut text = format!("{}. Made by `{}` (evenly {}).\n\n", comparison.title(), comparison.command, comparison.version);
    let heads: Vec<&str> = comparison.columns.iter().map(|column| column.method.as_str()).collect();
    let _ = writeln!(text, "| | {} |\n|---|{}", heads.join(" | "), "---:|".repeat(heads.len()));
    for name in comparison.names() {
        let cells: Vec<String> = comparison.columns.iter().map(|column| shown(spread(column, &name))).collect();
        let _ = writeln!(text, "| `{name}` | {} |", cells.join(" | "));
    }
    text
}

/// A line a run, in full precision.
fn csv(comparison: &Comparison) -> String {
    let names = comparison.names();
    let mut text = format!("method,seed,{}\n", names.join(","));
    for column in &comparison.columns {
        for run in &column.runs {
            let numbers = numbers(run);
            let cell =
                |name: &String| numbers.iter().find(|(known, _)| known == name).map_or_else(String::new, |(_, number)| number.to_string());
            let cells: Vec<String> = names.iter().map(cell).collect();
            let _ = writeln!(text, "{},{},{}", column.method, run.seed, cells.join(","));
        }
    }
    text
}
