//! [`Corners`]: distinct places, by number.

use std::collections::HashMap;

use glam::DVec2;

/// Distinct places in normalised coordinates, and as they were given.
#[derive(Default)]
pub(super) struct Corners {
    pub places: Vec<DVec2>,
    pub inputs: Vec<[f64; 2]>,
    numbers: HashMap<[u64; 2], u32>,
}

impl Corners {
    /// The number of a place, which is a new one where it is not there yet.
    pub fn number(&mut self, at: DVec2, input: impl FnOnce() -> [f64; 2]) -> u32 {
        // A zero has no sign here, so that equal places have equal bits.
        let at = at + 0.0;
        *self.numbers.entry([at.x.to_bits(), at.y.to_bits()]).or_insert_with(|| {
            self.places.push(at);
            self.inputs.push(input());
            self.places.len() as u32 - 1
        })
    }
}
