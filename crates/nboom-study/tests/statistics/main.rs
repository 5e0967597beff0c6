//! Statistics of made tables, and the page that shows them.

mod page;
mod rounding;
mod samples;
mod tables;

use nboom_study::statistics::{Field, Role};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

/// A column of this name.
fn field(name: &str, role: Role) -> Field {
    Field { description: name.to_owned(), ..Field::new(name, name, None, role) }
}

/// Uniform numbers between 0 and 1.
fn uniform(seed: u64) -> impl Iterator<Item = f64> {
    let mut random = SplitMix64::seed_from_u64(seed);
    std::iter::repeat_with(move || ((random.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64)
}
