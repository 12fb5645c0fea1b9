//! What can go wrong between a file and a point set.

use std::io;

use thiserror::Error;

use crate::memory::bytes_told;
use crate::message::presentable;

/// A file that cannot be read or written. The message names it, and the line where there is one.
#[derive(Debug, Error)]
pub enum Error {
    /// The operating system says no.
    #[error("{name}: {reason}")]
    Io {
        /// The file's name as it was given.
        name: String,
        /// Why.
        reason: io::Error,
    },
    /// The file's content makes no sense.
    #[error("{name}: {problem}")]
    Content {
        /// The file's name, and the line after a colon where there is one.
        name: String,
        /// What is wrong, and the way out.
        problem: String,
    },
    /// A file name whose ending names no format that can be used so.
    #[error("{name}: {problem}; use one of {choices}")]
    Format {
        /// The file's name as it was given.
        name: String,
        /// What is wrong with it.
        problem: &'static str,
        /// The endings that are possible.
        choices: String,
    },
    /// More memory than is allowed.
    #[error("{name}: reading it would take {}; at most {} of memory may be used", bytes_told(*needed), bytes_told(*allowed))]
    Memory {
        /// The file's name as it was given.
        name: String,
        /// In bytes.
        needed: u64,
        /// In bytes.
        allowed: u64,
    },
    /// The output exists already.
    #[error("{0} exists already; pass --force to overwrite it")]
    Exists(String),
    /// A figure of points that cannot be triangulated.
    #[error(transparent)]
    Points(#[from] evenly::Error),
}

impl Error {
    pub(crate) fn io(name: &str) -> impl FnOnce(io::Error) -> Self {
        let name = name.to_owned();
        move |reason| Self::Io { name, reason }
    }

    pub(crate) fn content(name: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Content { name: name.into(), problem: presentable(&problem.into()) }
    }
}
