//! Rows that are held.

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::Points;

/// Cases that are held.
const MOST_CASES: usize = 200_000;

/// Numbers that are held, 128 MB.
const MOST_NUMBERS: usize = 16_000_000;

/// Cases that are told one by one.
const MOST_POINTS: usize = 2000;

/// Numbers of cases: all as long as there is room, then those of a random share of draws, halved when they are
/// too many.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    most: usize,
    /// How often the share was halved.
    halvings: u32,
    cases: Vec<Held>,
    /// By column; NaN where there is no number.
    columns: Vec<Vec<f64>>,
}

#[derive(Clone, Copy, Debug)]
struct Held {
    case: u64,
    group: usize,
    ran: bool,
    /// A random number that cases of one draw share.
    lot: u64,
}

impl Sample {
    pub(super) fn new(columns: usize) -> Self {
        let most = MOST_CASES.min(MOST_NUMBERS / columns.max(1));
        Self { most, halvings: 0, cases: Vec::new(), columns: vec![Vec::new(); columns] }
    }

    /// Holds the case, of this group and run or not, if its draw is of the share.
    pub(super) fn offer(
        &mut self,
        case: u64,
        seed: u64,
        (group, ran): (usize, bool),
        numbers: &[f64],
    ) {
        let held = Held { case, group, ran, lot: SplitMix64::seed_from_u64(seed).next_u64() };
        if !self.is_in(&held) {
            return;
        }
        self.cases.push(held);
        self.columns.iter_mut().zip(numbers).for_each(|(column, value)| column.push(*value));
        while self.cases.len() > self.most {
            self.halvings += 1;
            let stays: Vec<bool> = self.cases.iter().map(|held| self.is_in(held)).collect();
            keep(&mut self.cases, &stays);
            self.columns.iter_mut().for_each(|column| keep(column, &stays));
        }
    }

    fn is_in(&self, held: &Held) -> bool {
        held.lot.trailing_zeros() >= self.halvings
    }

    pub(super) fn len(&self) -> usize {
        self.cases.len()
    }

    /// Of about so many draws one is held.
    pub(super) fn share(&self) -> u64 {
        1_u64.checked_shl(self.halvings).unwrap_or(u64::MAX)
    }

    /// Numbers of a column by row.
    pub(super) fn column(&self, column: usize) -> &[f64] {
        &self.columns[column]
    }

    /// Rows of the cases of a group that ran.
    pub(super) fn rows_that_ran(&self, group: usize) -> Vec<u32> {
        (0..self.len())
            .filter(|row| self.cases[*row].ran && self.cases[*row].group == group)
            .map(|row| row as u32)
            .collect()
    }

    /// Numbers of a column in a group, ascending.
    pub(super) fn sorted(&self, column: usize, group: usize) -> Vec<f64> {
        let of_group = self.columns[column].iter().zip(&self.cases);
        let is_there = |(value, held): &(&f64, &Held)| held.group == group && !value.is_nan();
        let mut sorted: Vec<f64> = of_group.filter(is_there).map(|(value, _)| *value).collect();
        sorted.sort_by(f64::total_cmp);
        sorted
    }

    /// A random few of the cases that ran.
    pub(super) fn points(&self) -> Points {
        let mut rows: Vec<usize> = (0..self.len()).filter(|row| self.cases[*row].ran).collect();
        rows.sort_by_key(|row| self.cases[*row].lot);
        rows.truncate(MOST_POINTS);
        rows.sort_unstable();
        let few = |column: &Vec<f64>| for_a_plot(rows.iter().map(|row| column[*row]).collect());
        Points {
            cases: rows.iter().map(|row| self.cases[*row].case).collect(),
            faults: rows.iter().map(|row| self.cases[*row].group).collect(),
            values: self.columns.iter().map(few).collect(),
        }
    }
}

fn keep<T: Copy>(held: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    held.retain(|_| stays.next().is_some_and(|stays| *stays));
}

/// Digits of a number, and of how far numbers spread, that are enough for a plot.
const DIGITS: f64 = 6.0;

/// Digits that tell any number from the next.
const ALL_DIGITS: f64 = 17.0;

/// The numbers to six digits, or to more of numbers that lie close together far from zero; none of NaN.
fn for_a_plot(values: Vec<f64>) -> Vec<Option<f64>> {
    let there = || values.iter().copied().filter(|value| !value.is_nan());
    let (low, high) =
        (there().fold(f64::INFINITY, f64::min), there().fold(-f64::INFINITY, f64::max));
    let further = (low.abs().max(high.abs()) / (high - low)).log10().ceil();
    let digits = if high > low { (DIGITS + further.max(0.0)).min(ALL_DIGITS) } else { ALL_DIGITS };
    let rounded = |value: &f64| format!("{value:.0$e}", digits as usize - 1).parse().ok();
    values.iter().map(|value| if value.is_nan() { None } else { rounded(value) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sample of draws of two cases each, of which the second has the number of the first.
    fn sample(draws: u64) -> Sample {
        let mut sample = Sample { most: 1000, ..Sample::new(1) };
        for draw in 0..draws {
            sample.offer(2 * draw + 1, draw, (0, true), &[draw as f64 / draws as f64]);
            sample.offer(2 * draw + 2, draw, (1, true), &[draw as f64 / draws as f64]);
        }
        sample
    }

    #[test]
    fn all_are_held_as_long_as_there_is_room() {
        let whole = sample(500);
        assert_eq!((whole.len(), whole.share()), (1000, 1));
        assert_eq!(whole.points().cases, (1..=1000).collect::<Vec<_>>());
    }

    #[test]
    fn points_that_lie_close_together_stay_apart() {
        let numbers =
            |i: u64| [-7e-3, 5000.0, 1e-30].map(|from| from + 1e-3 * from * i as f64 / 400.0);
        let mut sample = Sample::new(3);
        for i in 0..400 {
            sample.offer(i, i, (0, true), &numbers(i));
        }
        for (column, values) in sample.points().values.iter().enumerate() {
            for (i, value) in values.iter().enumerate() {
                let (value, exact) = (value.expect("a number"), numbers(i as u64)[column]);
                let spread = (numbers(399)[column] - numbers(0)[column]).abs();
                assert!((value - exact).abs() <= 5e-6 * spread, "{value} for {exact}");
            }
        }
    }

    #[test]
    fn a_share_of_many_is_fair_and_has_whole_draws() {
        let part = sample(40_000);
        assert!(part.len() <= 1000 && part.len() > 300, "{}", part.len());
        let expected = 80_000.0 / part.share() as f64;
        assert!((part.len() as f64 - expected).abs() < 5.0 * (2.0 * expected).sqrt());
        let sorted = part.sorted(0, 0);
        assert_eq!(sorted, part.sorted(0, 1));
        // Kolmogorov's distance from uniform numbers is beyond 1.95 / sqrt(n) once in a thousand times.
        let n = sorted.len() as f64;
        let distance = |(i, value): (usize, &f64)| (value - i as f64 / n).abs();
        let largest = sorted.iter().enumerate().map(distance).fold(0.0, f64::max);
        assert!(largest < 1.95 / n.sqrt() + 1.0 / n, "{largest}");
    }
}
