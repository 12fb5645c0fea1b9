//! What jobs say, with flags for parameters.

use anyhow::anyhow;
use evenly_jobs::{Error, Wording};

/// Parameters as flags: `--min-distance`.
pub struct Flags;

impl Wording for Flags {
    fn name(&self, parameter: &str) -> String {
        format!("--{}", parameter.replace('_', "-"))
    }

    fn setting(&self, parameter: &str, value: &str) -> String {
        format!("{} {value}", self.name(parameter))
    }
}

/// The error with flags for parameters.
pub fn told(error: impl Into<Error>) -> anyhow::Error {
    anyhow!("{}", error.into().message().shown(&Flags))
}
