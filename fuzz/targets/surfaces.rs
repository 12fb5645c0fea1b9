//! The readers of meshes and points in space.
#![no_main]

mod shared;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| shared::read_as(data, &["obj", "ply", "stl", "off", "gltf", "glb", "csv"], |path| {
    drop(evenly_io::read_triangles(path));
    drop(evenly_io::read_triangles_or_points(path));
}));
