//! What `evenly compare` has found.

use evenly::Space;
use evenly_jobs::{Column, CompareOutcome, CompareRun};
use serde::Serialize;
use serde_json::Value;

use crate::record;

/// Methods side by side.
#[derive(Serialize)]
pub struct Comparison {
    pub version: &'static str,
    pub command: String,
    pub space: Space,
    pub n_points: usize,
    /// Whether it was interrupted, so that runs are missing.
    pub is_interrupted: bool,
    /// What optimisers started from; `None` for points that were given.
    pub start: Option<String>,
    #[serde(rename = "methods")]
    pub columns: Vec<Column>,
    /// Of each method the first run's points, as SVG.
    #[serde(skip)]
    pub pictures: Vec<Option<String>>,
}

/// Mean and standard deviation over runs.
#[derive(Clone, Copy)]
pub struct Spread {
    pub mean: f64,
    pub sd: f64,
}

/// Every measure as a number, by name: the valences as shares.
pub fn numbers(run: &CompareRun) -> Vec<(String, f64)> {
    let mut numbers = Vec::new();
    if let Ok(Value::Object(fields)) = serde_json::to_value(&run.measures) {
        for (name, value) in &fields {
            match value {
                Value::Object(_) => numbers.extend(valences(run)),
                Value::Null => numbers.push((name.clone(), if name == "beta" { f64::INFINITY } else { f64::NAN })),
                value => numbers.extend(value.as_f64().map(|number| (name.clone(), number))),
            }
        }
    }
    numbers.push(("seconds".into(), run.seconds));
    numbers.extend(run.iterations.map(|n| ("iterations".into(), n as f64)));
    numbers.extend(run.is_reached.map(|is_reached| ("reached_fraction".into(), f64::from(u8::from(is_reached)))));
    numbers
}

fn valences(run: &CompareRun) -> Vec<(String, f64)> {
    let valence = &run.measures.valence;
    let all: usize = valence.values().sum();
    let share = |n: usize| n as f64 / all as f64;
    let known = [5, 6, 7].map(|k| valence.get(&k).copied().unwrap_or_default());
    let named = [5, 6, 7].into_iter().zip(known).map(|(k, n)| (format!("valence_{k}_fraction"), share(n)));
    named.chain([("valence_other_fraction".into(), share(all - known.iter().sum::<usize>()))]).collect()
}

/// A measure over the runs; `None` if they do not have it.
pub fn spread(column: &Column, name: &str) -> Option<Spread> {
    let of = |run: &CompareRun| numbers(run).into_iter().find(|(known, _)| known == name).map(|(_, number)| number);
    let numbers: Vec<f64> = column.runs.iter().filter_map(of).collect();
    if numbers.is_empty() {
        return None;
    }
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let squares: f64 = numbers.iter().map(|number| (number - mean).powi(2)).sum();
    Some(Spread { mean, sd: (squares / (numbers.len() as f64 - 1.0).max(1.0)).sqrt() })
}

impl Comparison {
    pub fn new(made: CompareOutcome, pictures: Vec<Option<String>>) -> Self {
        Self {
            version: record::VERSION,
            command: record::command(),
            space: made.space,
            n_points: made.n_points,
            is_interrupted: made.is_cancelled,
            start: made.start.map(|start| start.name().to_owned()),
            columns: made.columns,
            pictures,
        }
    }

    /// The names of all measures that some run has, in their order.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for run in self.columns.iter().flat_map(|column| &column.runs) {
            for (name, _) in numbers(run) {
                if !names.contains(&name) {
                    names.push(name);
                }
            }
        }
        names
    }

    /// In a sentence.
    pub fn title(&self) -> String {
        let from = self.start.as_ref().map_or_else(|| "the points given".to_owned(), |start| format!("start {start}"));
        let kind = self.space.kind();
        let most_runs = self.columns.iter().map(|column| column.runs.len()).max().unwrap_or_default();
        let missing = if self.is_interrupted { " (interrupted: runs are missing)" } else { "" };
        format!("{} points, {kind} {}, {from}, {most_runs} runs{missing}: mean and standard deviation", self.n_points, self.space)
    }
}

/// A measure for people: four digits, and as many decimals of its deviation, if they show any.
pub fn shown(spread: Option<Spread>) -> String {
    let Some(Spread { mean, sd }) = spread else { return "-".into() };
    let size = mean.abs();
    if mean.is_nan() {
        return "-".into();
    }
    if mean.is_infinite() {
        return "infinite".into();
    }
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return if sd > 1e-3 * size { format!("{mean:.2e} \u{b1}{sd:.0e}") } else { format!("{mean:.2e}") };
    }
    let is_whole = sd == 0.0 && mean.fract() == 0.0;
    let digits = if is_whole { 0 } else { 4usize.saturating_sub(size.max(1.0).log10() as usize) };
    let (mean, sd) = (format!("{mean:.digits$}"), format!("{sd:.digits$}"));
    let is_steady = sd.chars().all(|digit| matches!(digit, '0' | '.')) || sd == "NaN" || sd == "inf";
    if is_steady { mean } else { format!("{mean} \u{b1}{sd}") }
}
