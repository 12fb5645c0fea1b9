//! What was measured, for people and as JSON: the same names in both.

use std::fmt::Write as _;
use std::path::Path;

use evenly::Error;
use evenly_io::{Format, Target};
use serde_json::Value;

use crate::session::DONE;
use crate::wording;

/// Prints on stdout: the JSON, or else the table.
pub fn print(json: &Value, is_json: bool, table: impl FnOnce() -> String) -> anyhow::Result<u8> {
    let text = if is_json { serde_json::to_string_pretty(json)? + "\n" } else { table() };
    Target::new("-".as_ref(), Some(Format::Txt), false)?.write(text.as_bytes())?;
    Ok(DONE)
}

/// The same error, with the name that the user knows: of the flag, by pairs of a parameter and its flag, or of the file.
pub fn told(error: Error, file: &Path, flags: &[(&'static str, &'static str)]) -> anyhow::Error {
    wording::told(evenly_jobs::Error::of(error, &file.display().to_string(), flags))
}

/// A line a field.
pub fn table(json: &Value) -> String {
    let mut text = String::new();
    for (name, value) in json.as_object().into_iter().flatten() {
        line(&mut text, name, std::iter::once(shown(name, value)));
    }
    text
}

/// The fields of an object.
pub fn fields(value: Value) -> serde_json::Map<String, Value> {
    if let Value::Object(fields) = value { fields } else { serde_json::Map::new() }
}

/// A name and its values, side by side.
pub fn line(text: &mut String, name: &str, values: impl Iterator<Item = String>) {
    let values: Vec<String> = values.map(|value| format!("{value:<24}")).collect();
    let _ = writeln!(text, "{}", format!("{name:<24} {}", values.join(" ")).trim_end());
}

/// A value for people.
pub fn shown(name: &str, value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => format!("{:.5}", number.as_f64().unwrap_or(f64::NAN)),
        Value::Object(counts) => counts.iter().map(|(key, count)| format!("{key}: {count}")).collect::<Vec<_>>().join(", "),
        Value::Null if name == "beta" => "infinite".into(),
        Value::Null => "-".into(),
        other => other.to_string(),
    }
}
