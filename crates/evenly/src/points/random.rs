//! Random numbers: PCG, a portable generator, with our own mapping to f64, so that a seed means the same bits for ever.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// A stream of random numbers. Different purposes take different streams of one seed.
pub(crate) struct Random(Pcg64);

impl Random {
    pub fn new(seed: u64, stream: u64) -> Self {
        // PCG's first outputs are alike for small states; a multiple of an odd constant spreads the seed's bits.
        const SPREAD: u128 = 0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c835;
        Self(Pcg64::new(u128::from(seed).wrapping_add(1).wrapping_mul(SPREAD), u128::from(stream)))
    }

    /// Uniform in [0, 1): 53 random bits.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// A seed for one of many things that depend on `seed`.
    pub fn derived(seed: u64, index: usize) -> u64 {
        Self::new(seed, 1 << 32 | index as u64).0.next_u64()
    }

    /// Puts the items into a random order, each equally likely.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            // 32 random bits, scaled: for so few items as good as uniform.
            let other = ((self.0.next_u64() >> 32) * (last as u64 + 1)) >> 32;
            items.swap(last, other as usize);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_means_the_same_numbers_for_ever() {
        let mut random = Random::new(7, 0);
        let first: Vec<u64> = (0..3).map(|_| (random.unit() * (1u64 << 53) as f64) as u64).collect();
        assert_eq!(first, [8_322_783_790_462_752, 3_687_220_168_939_734, 4_537_775_367_533_519]);
    }

    #[test]
    fn seeds_and_streams_differ() {
        let first = |seed, stream| Random::new(seed, stream).unit();
        assert_ne!(first(0, 0), first(1, 0));
        assert_ne!(first(0, 0), first(0, 1));
    }
}
