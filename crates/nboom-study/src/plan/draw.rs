//! Random numbers of one draw.

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

/// Bits of a seed: tables in any format keep whole numbers of so many.
pub(crate) const BITS_OF_A_SEED: u32 = 53;

const MASK: u64 = (1 << BITS_OF_A_SEED) - 1;

/// Uniform random numbers, the same on every machine.
#[derive(Clone, Debug)]
pub(crate) struct Numbers(Xoshiro256PlusPlus);

impl Numbers {
    /// Those of a draw, from 0, of a study with this seed.
    pub fn of_draw(study: u64, draw: u64) -> Self {
        Self::new(seed(study, draw))
    }

    pub fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// The next bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// The next number, above 0 and below 1.
    pub fn next(&mut self) -> f64 {
        inside(self.bits() >> (64 - BITS_OF_A_SEED))
    }

    /// So many.
    pub fn take(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.next()).collect()
    }
}

/// The middle of one of 2^53 equal intervals between 0 and 1.
pub(crate) fn inside(interval: u64) -> f64 {
    // The last middle would round to 1.
    ((interval as f64 + 0.5) / (1_u64 << BITS_OF_A_SEED) as f64).min(1.0 - f64::EPSILON / 2.0)
}

/// The seed of a draw, from 0, of a study with this seed: each draw has another.
pub(crate) fn seed(study: u64, draw: u64) -> u64 {
    let mut numbers = Numbers::new(study);
    let mut seed = draw.wrapping_add(numbers.bits()) & MASK;
    // Each step can be undone within 53 bits, so that no two draws share a seed.
    for _ in 0..3 {
        seed = seed.wrapping_mul(numbers.bits() | 1) & MASK;
        seed ^= seed >> 27;
    }
    seed
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn each_draw_has_a_seed_of_its_own() {
        let seeds: BTreeSet<u64> = (0..100_000).map(|draw| seed(1970, draw)).collect();
        assert_eq!(seeds.len(), 100_000);
        assert!(seeds.iter().all(|seed| *seed <= MASK));
        let bits: u32 =
            (0..1000).map(|draw| (seed(1, draw) ^ seed(1, draw + 1)).count_ones()).sum();
        // Half of 53 bits change from one to the next, within five standard deviations.
        assert!((f64::from(bits) / 1000.0 - 26.5).abs() < 5.0 * 3.64 / 1000_f64.sqrt(), "{bits}");
    }

    #[test]
    fn numbers_are_inside() {
        assert!(inside(0) > 0.0 && inside(MASK) < 1.0);
    }
}
