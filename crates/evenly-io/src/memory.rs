//! How much memory reading may take: what a file promises is looked at before room is made for it.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use sysinfo::{MemoryRefreshKind, RefreshKind, System};

use crate::Error;

/// The limit, in bytes; 0 before anybody has asked.
static LIMIT: AtomicU64 = AtomicU64::new(0);

/// Three quarters of the memory that the machine has, or the container in which the program runs; in bytes.
pub fn usual_memory() -> u64 {
    static USUAL: OnceLock<u64> = OnceLock::new();
    *USUAL.get_or_init(|| {
        let kind = RefreshKind::nothing().with_memory(MemoryRefreshKind::nothing().with_ram());
        let system = System::new_with_specifics(kind);
        let whole = system.total_memory();
        let own = system.cgroup_limits().map_or(whole, |limits| limits.total_memory);
        let least = if own > 0 { own.min(whole) } else { whole };
        // Where the system does not tell, there is no limit.
        if least > 0 { least / 4 * 3 } else { u64::MAX }
    })
}

/// Sets how many bytes may be in use; without it, [`usual_memory`].
pub fn limit_memory(bytes: u64) {
    LIMIT.store(bytes.max(1), Relaxed);
}

/// How many bytes may be in use.
pub fn memory_limit() -> u64 {
    match LIMIT.load(Relaxed) {
        0 => usual_memory(),
        limit => limit,
    }
}

/// That what comes next fits.
///
/// # Errors
/// [`Error::Memory`] with the name of the file, if it needs more bytes than are allowed.
pub(crate) fn require(name: &str, needed: u64) -> Result<(), Error> {
    let allowed = memory_limit();
    if needed > allowed { Err(Error::Memory { name: name.to_owned(), needed, allowed }) } else { Ok(()) }
}

/// Bytes in words.
pub fn bytes_told(bytes: u64) -> String {
    const UNITS: [(f64, &str); 4] = [(1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    let x = bytes as f64;
    match UNITS.iter().find(|(unit, _)| x >= *unit) {
        Some((unit, name)) => format!("{:.1} {name}", x / unit),
        None => format!("{bytes} bytes"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_told_in_a_unit_that_suits_them() {
        assert_eq!([999, 1500, 2_000_000, 7_500_000_000].map(bytes_told), ["999 bytes", "1.5 kB", "2.0 MB", "7.5 GB"]);
    }

    #[test]
    fn a_machine_has_some_memory() {
        assert!(usual_memory() > 50_000_000);
    }
}
