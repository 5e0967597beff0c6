//! Cases at both ends of the range of a number.

use super::Extreme;

/// Cases at each end.
const MOST: usize = 5;

/// The cases with the smallest and the largest numbers; of equal ones those that came first.
#[derive(Clone, Debug, Default)]
pub(super) struct Extremes {
    smallest: Vec<Extreme>,
    largest: Vec<Extreme>,
}

impl Extremes {
    pub(super) fn add(&mut self, found: Extreme) {
        insert(&mut self.smallest, found, |held| held.value <= found.value);
        insert(&mut self.largest, found, |held| held.value >= found.value);
    }

    /// Adds the case of a lock-up that does not come.
    pub(super) fn add_never(&mut self, of: Extreme) {
        let never = Extreme { value: f64::INFINITY, ..of };
        insert(&mut self.largest, never, |held| held.value >= never.value);
    }

    pub(super) fn smallest(&self) -> &[Extreme] {
        &self.smallest
    }

    pub(super) fn largest(&self) -> &[Extreme] {
        &self.largest
    }
}

/// Puts a case behind those that come before it.
fn insert(held: &mut Vec<Extreme>, found: Extreme, before: impl Fn(&Extreme) -> bool) {
    let place = held.partition_point(before);
    if place < MOST {
        held.truncate(MOST - 1);
        held.insert(place, found);
    }
}
