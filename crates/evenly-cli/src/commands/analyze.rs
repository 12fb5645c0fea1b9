//! `evenly analyze`: the proof.

use std::fmt::Write as _;
use std::process::ExitCode;

use anyhow::{Context as _, bail};
use evenly::{Measures, RadialSpectrum, measure, radial_spectrum};
use evenly_io::{Draw, Format, Target, write_points};
use serde::Serialize;

use crate::args::Analyze;
use crate::talk::say;
use crate::{input, record, session};

pub fn run(args: &Analyze) -> anyhow::Result<ExitCode> {
    let space = args.space.space()?;
    let plot = match &args.plot {
        Some(path) => Some(Target::new(path, None, args.force)?),
        None => None,
    };
    if let Some(plot) = plot.as_ref().filter(|plot| plot.format().holds_points()) {
        bail!("{}: a figure is .svg or .png", plot.name());
    }
    let (points, note) = input::read(&args.input, space)?;
    if let Some(note) = note {
        say(format_args!("note: {note}"));
    }
    let name = || args.input.display().to_string();
    let pool = session::pool(args.threads)?;
    let measures = pool.install(|| measure(&points)).with_context(name)?;
    let spectrum =
        if args.spectrum { Some(pool.install(|| radial_spectrum(std::slice::from_ref(&points))).with_context(name)?) } else { None };
    let found = Found { measures, spectrum };
    if let Some(plot) = &plot {
        let layers: Vec<Draw> = args.draw.iter().map(|&layer| layer.into()).collect();
        write_points(&points, &layers, &record::recipe(None), plot).with_context(name)?;
    }
    let text = if args.json { serde_json::to_string_pretty(&found)? + "\n" } else { table(&found) };
    Target::new("-".as_ref(), Some(Format::Txt), false)?.write(text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}

/// All that was asked for, in one object.
#[derive(Serialize)]
struct Found {
    #[serde(flatten)]
    measures: Measures,
    #[serde(flatten)]
    spectrum: Option<RadialSpectrum>,
}

/// A line a measure, in the names of the JSON; no curves.
fn table(found: &Found) -> String {
    let mut text = String::new();
    if let Ok(serde_json::Value::Object(fields)) = serde_json::to_value(found) {
        for (name, value) in fields.iter().filter(|(_, value)| !value.is_array()) {
            let value = match value {
                serde_json::Value::Number(number) if number.is_f64() => format!("{:.5}", number.as_f64().unwrap_or(f64::NAN)),
                serde_json::Value::Object(counts) => {
                    counts.iter().map(|(key, count)| format!("{key}: {count}")).collect::<Vec<_>>().join(", ")
                }
                serde_json::Value::Null if name == "beta" => "infinite".into(),
                serde_json::Value::Null => "-".into(),
                other => other.to_string(),
            };
            let _ = writeln!(text, "{name:<24} {value}");
        }
    }
    text
}
