//! Morton's curve through the box from -2 to 2: what is near to each other along it is so in space.

use glam::DVec3;

/// Where a place lies on the curve.
pub(crate) fn morton(p: DVec3) -> u64 {
    const BITS: u32 = 21;
    let cells = ((p + 2.0) * f64::from(1u32 << (BITS - 2))).to_array().map(|x| (x.max(0.0) as u64).min((1 << BITS) - 1));
    (0..BITS).fold(0, |code, bit| code | (0..3).fold(0, |bits, axis| bits | (cells[axis] >> bit & 1) << (3 * bit + axis as u32)))
}
