//! What is wrong with a command line, in one line, and what may have been meant.

use std::ffi::OsString;

use clap::Error;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::BAD_INPUT;
use crate::session::DONE;
use crate::talk::say;

/// Flags that had another name: the command, that name, and today's.
const RENAMED: [(&str, &str, &str); 4] = [
    ("mesh", "--spacing", "--edge-length"),
    ("mesh", "--max-spacing", "--max-edge-length"),
    ("remesh", "--spacing", "--edge-length"),
    ("remesh", "--n-points", "--n-vertices"),
];

/// Prints help as it is; of an error, one line. Returns the exit code.
pub fn show(error: &Error, words: &[OsString]) -> u8 {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        return if error.print().is_ok() { DONE } else { BAD_INPUT };
    }
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        say(error.to_string().trim_end());
        return BAD_INPUT;
    }
    match renamed(error, words).or_else(|| meant(error)) {
        Some(hint) => say(format_args!("error: {}; {hint}", plain(error))),
        None => say(format_args!("error: {}; see --help", plain(error))),
    }
    BAD_INPUT
}

/// What is wrong, in a line.
pub fn plain(error: &Error) -> anyhow::Error {
    let text = error.to_string();
    let what: Vec<&str> = text.lines().take_while(|line| !line.trim().is_empty()).map(str::trim).collect();
    let what = what.join(" ");
    anyhow::Error::msg(what.strip_prefix("error: ").unwrap_or(&what).to_owned())
}

/// Today's name of a flag.
fn renamed(error: &Error, words: &[OsString]) -> Option<String> {
    let ContextValue::String(flag) = error.get(ContextKind::InvalidArg)? else { return None };
    let of_command = |(command, ..): &&(&str, &str, &str)| words.iter().skip(1).any(|word| word == command);
    let (_, _, new) = RENAMED.iter().filter(of_command).find(|(_, old, _)| old == flag)?;
    Some(format!("it is called {new} now"))
}

/// What may have been meant.
fn meant(error: &Error) -> Option<String> {
    let kinds = [ContextKind::SuggestedSubcommand, ContextKind::SuggestedArg, ContextKind::SuggestedValue];
    let suggested = kinds.into_iter().find_map(|kind| error.get(kind))?;
    let names: Vec<&str> = match suggested {
        ContextValue::String(name) => vec![name],
        ContextValue::Strings(names) => names.iter().map(String::as_str).collect(),
        _ => return None,
    };
    Some(format!("did you mean {}?", names.join(" or ")))
}
