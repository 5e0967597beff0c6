//! Latin hypercubes: of each variable one draw in each of as many equal shares as there are draws.

use super::draw::Numbers;

/// Which share each draw has of each variable: a permutation of the draws, computed for one at a time.
#[derive(Clone, Debug)]
pub(crate) struct Strata {
    seed: u64,
    draws: u64,
    /// Bits of the numbers below the least power of two that holds all draws.
    bits: u32,
}

/// Rounds after which neighbours are anywhere.
const ROUNDS: usize = 4;

impl Strata {
    pub fn new(seed: u64, draws: u64) -> Self {
        Self { seed, draws, bits: (draws.max(2) - 1).ilog2() + 1 }
    }

    /// The number above 0 and below 1 of a variable in a draw, from 0, that lies at `u` in its share.
    pub fn place(&self, variable: usize, draw: u64, u: f64) -> f64 {
        let share = (self.share(variable, draw) as f64 + u) / self.draws as f64;
        share.min(1.0 - f64::EPSILON / 2.0)
    }

    fn share(&self, variable: usize, draw: u64) -> u64 {
        let mut keys = Numbers::new(self.seed ^ (variable as u64 + 1).rotate_left(32));
        let keys: [[u64; 2]; ROUNDS] = std::array::from_fn(|_| [keys.bits(), keys.bits() | 1]);
        // Numbers beyond the draws go round again: what is left is a permutation of the draws.
        let mut share = self.shuffled(draw, &keys);
        while share >= self.draws {
            share = self.shuffled(share, &keys);
        }
        share
    }

    /// A permutation of the numbers of so many bits: each step can be undone.
    fn shuffled(&self, number: u64, keys: &[[u64; 2]; ROUNDS]) -> u64 {
        let mask = (1 << self.bits) - 1;
        let half = self.bits.div_ceil(2);
        keys.iter().fold(number, |number, [add, times]| {
            let number = number.wrapping_add(*add).wrapping_mul(*times) & mask;
            number ^ (number >> half)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_share_has_one_draw() {
        for draws in [1, 2, 3, 7, 64, 1000, 4097] {
            let strata = Strata::new(5, draws);
            for variable in 0..4 {
                let mut found = vec![0; draws as usize];
                for draw in 0..draws {
                    let u = strata.place(variable, draw, 0.999_999);
                    found[(u * draws as f64) as usize] += 1;
                }
                assert!(found.iter().all(|count| *count == 1), "{draws} {variable}");
            }
        }
    }

    /// Five standard deviations of a correlation of independent ranks.
    #[test]
    fn variables_are_shuffled_independently() {
        let draws = 5000;
        let strata = Strata::new(11, draws);
        for (a, b) in [(0, 1), (1, 2), (2, 3), (0, 7)] {
            let of = |variable, draw| strata.place(variable, draw, 0.5) - 0.5;
            let sum: f64 = (0..draws).map(|draw| of(a, draw) * of(b, draw)).sum();
            let order: f64 =
                (0..draws).map(|draw| of(a, draw) * (draw as f64 / draws as f64 - 0.5)).sum();
            for sum in [sum, order] {
                let correlation = 12.0 * sum / draws as f64;
                assert!(correlation.abs() < 5.0 / (draws as f64).sqrt(), "{a} {b} {correlation}");
            }
        }
    }
}
