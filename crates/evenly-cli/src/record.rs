//! A run's whole record, for `--report` and `--json`; and its recipe, for files with room for a comment.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::sync::OnceLock;

use evenly::{Measures, Optimizer, Report, Space, UnmetTarget};
use evenly_jobs::PointsLengths;
use serde::Serialize;
use serde_json::{Value, json};

#[derive(Serialize)]
pub struct Record {
    pub version: &'static str,
    pub command: String,
    pub method: String,
    pub seed: Option<u64>,
    pub space: Space,
    /// In whose lengths the measures are: those of the input, or of the unit square.
    pub metric: &'static str,
    pub n_points: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameters: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<Report>,
    /// Wall time of each phase.
    pub seconds: BTreeMap<&'static str, f64>,
    /// Absent for fewer than three points, or all on one line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measures: Option<Measures>,
    /// The smallest distance and the coverage radius in units; absent where the density varies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lengths: Option<PointsLengths>,
    /// Between which beta certifies all angles to lie; absent from 1 on, and without triangles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_bounds_deg: Option<[f64; 2]>,
    /// The targets that were not reached; absent for a method that has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unmet: Option<Vec<UnmetTarget>>,
    pub notes: Vec<String>,
}

/// The parameters of a method, by their names.
pub fn parameters(optimizer: &dyn Optimizer) -> Value {
    let seed = optimizer.seed().map(|seed| ("seed".to_owned(), Value::from(seed)));
    optimizer.parameters().into_iter().map(|(name, setting)| (name.to_owned(), json!(setting))).chain(seed).collect()
}

pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// How an output was made: version, command, seed.
pub fn recipe(seed: Option<u64>) -> String {
    let seed = seed.map_or_else(String::new, |seed| format!(" (seed {seed})"));
    format!("evenly {VERSION}: {}{seed}", command())
}

static COMMAND: OnceLock<String> = OnceLock::new();

/// Keeps the words of the command line, the first of which is the program.
pub fn keep_command(words: &[OsString]) {
    let quoted = |word: String| if word.contains(' ') { format!("'{word}'") } else { word };
    let words = words.iter().skip(1).map(|word| quoted(word.to_string_lossy().into_owned()));
    let command = std::iter::once("evenly".to_owned()).chain(words).collect::<Vec<_>>().join(" ");
    COMMAND.get_or_init(|| command);
}

/// The command as it was given, without the way to the program.
pub fn command() -> String {
    COMMAND.get().cloned().unwrap_or_default()
}
