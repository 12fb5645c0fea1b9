//! Shapes out of bytes: coordinates on a coarse grid, so that points coincide and lie on lines.

/// Steps along an axis.
const STEPS: f64 = 32.0;

/// The first bytes, as numbers, and what comes after them.
pub fn split<const N: usize>(data: &[u8]) -> Option<([u8; N], &[u8])> {
    data.split_first_chunk().map(|(head, rest)| (*head, rest))
}

/// A coordinate for each byte: three parts of four on the grid, the others next to it.
pub fn coordinate(byte: u8) -> f64 {
    let near = [0.0, 0.0, 0.0, 1e-9][usize::from(byte % 4)];
    f64::from(byte / 4 % 32) / STEPS + near
}

/// Places of N coordinates each.
pub fn places<const N: usize>(data: &[u8]) -> Vec<[f64; N]> {
    data.as_chunks::<N>().0.iter().map(|bytes| bytes.map(coordinate)).collect()
}
