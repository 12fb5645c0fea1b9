//! [`Queue`]: edges by a length, the shortest first, to a sixteenth of an octave.
//!
//! Edges of about the same length come in the order of a stack: what came last is near to what was just worked on, in space and so in memory.

/// Bits of an `f64` that are not looked at: what is above are the exponent, and four bits of the mantissa.
const IGNORED: u32 = 48;

/// Edges, each by its ends.
#[derive(Default)]
pub(super) struct Queue {
    levels: Vec<Vec<[u32; 2]>>,
    /// None is below this.
    lowest: usize,
}

impl Queue {
    /// Lengths are neither negative nor infinite.
    pub fn push(&mut self, length: f64, ends: [u32; 2]) {
        let level = (length.to_bits() >> IGNORED) as usize;
        if level >= self.levels.len() {
            self.levels.resize_with(level + 1, Vec::new);
        }
        self.levels[level].push(ends);
        self.lowest = self.lowest.min(level);
    }

    pub fn pop(&mut self) -> Option<[u32; 2]> {
        while let Some(level) = self.levels.get_mut(self.lowest) {
            match level.pop() {
                Some(ends) => return Some(ends),
                None => self.lowest += 1,
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shorter_ones_come_first() {
        let lengths = [3.0, 1e-300, 0.0, 1.0, 7.5, 1.01, 0.2, 1e300];
        let mut queue = Queue::default();
        (0..).zip(lengths).for_each(|(k, length)| queue.push(length, [k, k]));
        let order: Vec<f64> = std::iter::from_fn(|| queue.pop()).map(|[k, _]| lengths[k as usize]).collect();
        assert_eq!(order.len(), lengths.len());
        assert!(order.windows(2).all(|pair| pair[0] <= pair[1] * 1.0625), "{order:?}");
    }
}
