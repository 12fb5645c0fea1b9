//! The reader of images.
#![no_main]

mod shared;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| shared::read_as(data, &["png"], |path| drop(evenly_io::read_image(path))));
