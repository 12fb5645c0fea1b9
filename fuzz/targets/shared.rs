//! What the targets share: readers take files, so what comes in is written to one.

use std::path::Path;

/// Hands the input to a reader as a file with each of these endings.
pub fn read_as(data: &[u8], endings: &[&str], read: impl Fn(&Path)) {
    for ending in endings {
        let path = std::env::temp_dir().join(format!("evenly-fuzz-{}.{ending}", std::process::id()));
        if std::fs::write(&path, data).is_ok() {
            read(&path);
        }
    }
}
