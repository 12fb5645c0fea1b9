//! Signals: once, and the state reached is written; twice, or where there is nothing to keep, and the process
//! ends at once. No file is left half-written.

use std::sync::atomic::{AtomicU8, Ordering::SeqCst};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use evenly::CancelToken;
use evenly_io::discard_temporaries;

use crate::talk::say;

/// Two signals within this time are one: some programs send them twice.
const AT_ONCE: Duration = Duration::from_millis(500);
/// Ctrl-C.
const INTERRUPT: u8 = 2;
/// By shells, an exit code stands for a signal, to which this is added.
const OF_SIGNALS: u8 = 128;

/// The signal that came last; Ctrl-C until one has come.
static SIGNAL: AtomicU8 = AtomicU8::new(INTERRUPT);
/// What a signal cancels, where there is a state to keep.
static KEEPING: Mutex<Option<Keeping>> = Mutex::new(None);

struct Keeping {
    cancel: CancelToken,
    is_quiet: bool,
    asked: Option<Instant>,
}

/// The exit code of a run that was interrupted: 130 by Ctrl-C, 143 by SIGTERM, 129 by SIGHUP.
pub fn code() -> u8 {
    OF_SIGNALS + SIGNAL.load(SeqCst)
}

/// From here on a signal ends the run after the step at hand, and the state reached is kept; before, there is
/// nothing to keep.
pub fn cancels(cancel: &CancelToken, is_quiet: bool) {
    let mut keeping = KEEPING.lock().unwrap_or_else(PoisonError::into_inner);
    keeping.get_or_insert_with(|| Keeping { cancel: cancel.clone(), is_quiet, asked: None });
}

/// All that is to be kept is written: from here on a signal ends the process at once.
pub fn ends() {
    *KEEPING.lock().unwrap_or_else(PoisonError::into_inner) = None;
}

fn on_signal(signal: u8) {
    SIGNAL.store(signal, SeqCst);
    let mut keeping = KEEPING.lock().unwrap_or_else(PoisonError::into_inner);
    match &mut *keeping {
        Some(Keeping { asked: Some(at), .. }) if at.elapsed() < AT_ONCE => {}
        Some(Keeping { cancel, is_quiet, asked: asked @ None }) => {
            *asked = Some(Instant::now());
            cancel.cancel();
            if !*is_quiet {
                say("interrupted: writing the state reached; once more to stop at once");
            }
        }
        _ => {
            discard_temporaries();
            std::process::exit(i32::from(code()));
        }
    }
}

/// Listens for signals until the process ends, but for those that it was started to ignore.
#[cfg(unix)]
pub fn listen() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let ignored = ignored();
    let heard = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // Without a listener signals end the process, as they do any.
    if let Ok(mut signals) = signal_hook::iterator::Signals::new(heard) {
        std::thread::spawn(move || signals.forever().for_each(|signal| on_signal(signal as u8)));
    }
}

/// A bit for each signal that is ignored, as by `nohup`; where the system does not tell, none.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// Listens for Ctrl-C until the process ends.
#[cfg(not(unix))]
pub fn listen() {
    // Without a listener Ctrl-C ends the process, as it does any.
    let _ = ctrlc::set_handler(|| on_signal(INTERRUPT));
}
