//! `--memory`: no run takes more than it may. Readers and verbs refuse what would need more; what none of
//! them foresees ends here, in one line, before the machine begins to swap.

use std::alloc::System;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use cap::Cap;
use evenly_io::{bytes_told, discard_temporaries, limit_memory, memory_limit};

use crate::BAD_INPUT;
use crate::talk::say;

/// Counts what is in use.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// A run that holds this share of its limit ends: what it asks for next may be beyond.
const NEARLY: f64 = 0.95;
/// How often that is looked at.
const EVERY: Duration = Duration::from_millis(20);
/// No limit is below this, in bytes: the program itself needs as much.
const LEAST: f64 = 5e7;
/// Keeps the process within its limit, of this many bytes if any are given.
pub fn keep_within(bytes: Option<u64>) {
    if let Some(bytes) = bytes {
        limit_memory(bytes);
    }
    let limit = memory_limit();
    let Ok(most) = usize::try_from(limit) else { return };
    // What grows is seen to come near. One huge piece is refused: the standard library then says so, and aborts.
    if ALLOCATOR.set_limit(most).is_err() {
        end(limit);
    }
    #[cfg(unix)]
    {
        let is_on = Arc::new(AtomicBool::new(true));
        // Without it an abort has the exit code of one.
        let _ = signal_hook::flag::register_conditional_shutdown(signal_hook::consts::SIGABRT, i32::from(BAD_INPUT), is_on);
    }
    std::thread::spawn(move || {
        while (ALLOCATOR.allocated() as f64) < NEARLY * limit as f64 {
            std::thread::sleep(EVERY);
        }
        end(limit);
    });
}

fn end(limit: u64) -> ! {
    say(format_args!("error: more than {} of memory would be needed; allow more with --memory", bytes_told(limit)));
    discard_temporaries();
    std::process::exit(i32::from(BAD_INPUT));
}

/// Bytes from words such as `8GB`, `500MB`, `1.5GiB` or `1000000`.
pub fn parse(text: &str) -> Result<u64, String> {
    const UNITS: [(&str, f64); 13] = [
        ("kib", 1024.0),
        ("mib", 1_048_576.0),
        ("gib", 1_073_741_824.0),
        ("tib", 1_099_511_627_776.0),
        ("kb", 1e3),
        ("mb", 1e6),
        ("gb", 1e9),
        ("tb", 1e12),
        ("k", 1e3),
        ("m", 1e6),
        ("g", 1e9),
        ("t", 1e12),
        ("b", 1.0),
    ];
    let lower = text.trim().to_ascii_lowercase();
    let found = UNITS.iter().find_map(|&(unit, size)| Some((lower.strip_suffix(unit)?, size)));
    let (number, unit) = found.unwrap_or((&lower, 1.0));
    let bytes = number.trim().parse::<f64>().ok().map(|number| number * unit);
    match bytes.filter(|&bytes| (LEAST..=1e18).contains(&bytes)) {
        Some(bytes) => Ok(bytes as u64),
        None => Err("it must be a size such as 8GB or 500MB, 50MB at least".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        assert_eq!(
            ["8GB", "500 MB", "1.5gib", "100000000", "64M"].map(|text| parse(text).unwrap_or(0)),
            [8_000_000_000, 500_000_000, 1_610_612_736, 100_000_000, 64_000_000]
        );
        for text in ["", "GB", "-1GB", "nan", "inf", "1e30", "10", "8 apples"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
