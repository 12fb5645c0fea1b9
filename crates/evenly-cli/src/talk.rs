//! Talk on stderr. Where it cannot be said, the work goes on: `eprintln!` would end it.

use std::fmt::Display;
use std::io::Write as _;

use evenly_io::presentable;

/// Says a line.
pub fn say(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{}", presentable(&line.to_string()));
}
