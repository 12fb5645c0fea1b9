//! The readers of lines: GeoJSON, WKT, SVG and text.
#![no_main]

mod shared;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| shared::read_as(data, &["geojson", "wkt", "svg", "txt"], |path| drop(evenly_io::read_lines(path))));
