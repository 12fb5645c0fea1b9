//! The readers of points: text, CSV and NumPy.
#![no_main]

mod shared;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| shared::read_as(data, &["txt", "csv", "npy"], |path| drop(evenly_io::read_positions(path))));
