//! Ctrl-C: once, and the state reached is written; twice, and nothing is.

use std::time::{Duration, Instant};

use anyhow::Context as _;
use evenly::CancelToken;

use crate::talk::say;

/// The exit code of a run that was interrupted.
pub const CODE: u8 = 130;
/// Two signals within this time are one.
const AT_ONCE: Duration = Duration::from_millis(500);

/// From here on Ctrl-C ends the run after the iteration at hand; before, there is nothing to keep.
pub fn cancels(cancel: &CancelToken, is_quiet: bool) -> anyhow::Result<()> {
    let cancel = cancel.clone();
    let mut asked: Option<Instant> = None;
    let on_interrupt = move || {
        match asked {
            // Some programs send the signal twice at once.
            Some(at) if at.elapsed() < AT_ONCE => return,
            // Asked twice: at once, and nothing is written.
            Some(_) => std::process::exit(i32::from(CODE)),
            None => asked = Some(Instant::now()),
        }
        cancel.cancel();
        if !is_quiet {
            say("interrupted: writing the state reached; once more to stop at once");
        }
    };
    ctrlc::set_handler(on_interrupt).context("no handler for Ctrl-C")
}
