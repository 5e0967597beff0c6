//! Spearman's rank correlation.

use std::borrow::Cow;

use statrs::distribution::{ContinuousCDF, Normal};

use super::Driver;
use super::confidence::TAIL;

/// Numbers closer than this share of the largest differ by rounding.
const ROUNDING: f64 = 1e-13;

/// Numbers in ascending order.
#[derive(Clone, Debug)]
pub(super) struct Ranked<'a> {
    values: Cow<'a, [f64]>,
    /// Rows that have a number, by their numbers.
    order: Vec<u32>,
}

impl<'a> Ranked<'a> {
    /// The numbers of these rows; NaN is none.
    pub(super) fn new(values: &'a [f64], rows: &[u32]) -> Self {
        Self::of(Cow::Borrowed(values), rows)
    }

    /// The numbers of these rows; NaN comes after all others.
    pub(super) fn with_none_last(values: &[f64], rows: &[u32]) -> Self {
        let last = |value: &f64| if value.is_nan() { f64::INFINITY } else { *value };
        Self::of(values.iter().map(last).collect(), rows)
    }

    /// The same of numbers that are all one, but for those that are none.
    pub(super) fn tied(mut self) -> Self {
        for value in self.values.to_mut().iter_mut().filter(|value| value.is_finite()) {
            *value = 0.0;
        }
        self
    }

    /// The same of results of runs, in which numbers that rounding may tell apart are one. Counts are not rounded.
    pub(super) fn rounded(mut self) -> Self {
        let finite = || self.values.iter().filter(|value| value.is_finite());
        if finite().all(|value| value.fract() == 0.0) {
            return self;
        }
        let rounding = ROUNDING * finite().fold(0.0_f64, |most, value| most.max(value.abs()));
        let mut least = f64::NEG_INFINITY;
        for &row in &self.order {
            let value = &mut self.values.to_mut()[row as usize];
            if *value - least <= rounding {
                *value = least;
            } else {
                least = *value;
            }
        }
        self
    }

    fn of(values: Cow<'a, [f64]>, rows: &[u32]) -> Self {
        let value = |row: &u32| values[*row as usize];
        let mut order: Vec<u32> = rows.iter().copied().filter(|row| !value(row).is_nan()).collect();
        order.sort_by(|a, b| value(a).total_cmp(&value(b)));
        Self { values, order }
    }

    /// Of each row that has a number here and there its rank less the mean rank, 0 in other rows; and how many
    /// such rows there are. Equal numbers share their mean rank.
    fn ranks(&self, other: &Self) -> (Vec<f64>, usize) {
        let is_shared = |row: &&u32| !other.values[**row as usize].is_nan();
        let order: Vec<u32> = self.order.iter().filter(is_shared).copied().collect();
        let mut ranks = vec![0.0; self.values.len()];
        let mut first = 0;
        let equal = |a: &u32, b: &u32| self.values[*a as usize] == self.values[*b as usize];
        for tie in order.chunk_by(equal) {
            let twice = (2 * first + tie.len()) as f64 - order.len() as f64;
            tie.iter().for_each(|row| ranks[*row as usize] = 0.5 * twice);
            first += tie.len();
        }
        (ranks, order.len())
    }
}

/// The rank correlation over rows that have both numbers, and how many these are; none if one is constant.
fn spearman(a: &Ranked<'_>, b: &Ranked<'_>) -> Option<(f64, usize)> {
    let ((a, count), (b, _)) = (a.ranks(b), b.ranks(a));
    let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let size = product(&a, &a).sqrt() * product(&b, &b).sqrt();
    (size > 0.0).then(|| ((product(&a, &b) / size).clamp(-1.0, 1.0), count))
}

/// What drives an effect, strongest first, of columns by their numbers.
///
/// The bound is that of independence, by the normal limit of the coefficient, whose variance is 1 / (n - 1). It
/// is wider the more variables there are (Bonferroni), since of many one always seems to matter; those that are constant
/// have no coefficient.
pub(super) fn drivers(causes: &[(usize, Ranked<'_>)], effect: &Ranked<'_>) -> Vec<Driver> {
    let of = |(variable, cause): &(usize, Ranked<'_>)| Some((*variable, spearman(cause, effect)?));
    let mut found: Vec<_> = causes.iter().filter_map(of).collect();
    found.sort_by(|(_, (a, _)), (_, (b, _))| b.abs().total_cmp(&a.abs()));
    let score = Normal::standard().inverse_cdf(1.0 - TAIL / found.len().max(1) as f64);
    let driver = |(variable, (coefficient, count)): (usize, (f64, usize))| {
        let bound = (score / (count as f64 - 1.0).sqrt()).min(1.0);
        Driver { variable, coefficient, bound }
    };
    found.into_iter().map(driver).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn correlation(a: &[f64], b: &[f64]) -> Option<(f64, usize)> {
        let rows: Vec<u32> = (0..a.len() as u32).collect();
        spearman(&Ranked::new(a, &rows), &Ranked::new(b, &rows))
    }

    #[test]
    fn without_ties_it_is_the_sum_of_squared_differences() {
        // IQ and hours of television, the example of textbooks: 1 - 6 * 194 / (10 * 99).
        let iq = [106.0, 100.0, 86.0, 101.0, 99.0, 103.0, 97.0, 113.0, 112.0, 110.0];
        let hours = [7.0, 27.0, 2.0, 50.0, 28.0, 29.0, 20.0, 12.0, 6.0, 17.0];
        let (found, count) = correlation(&iq, &hours).expect("numbers");
        assert!((found - (1.0 - 6.0 * 194.0 / 990.0)).abs() < 1e-15 && count == 10);
    }

    #[test]
    fn ties_share_their_rank_and_gaps_are_left_out() {
        // Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: 4.5 / sqrt(4.5 * 5).
        let (a, b) = ([1.0, 2.0, f64::NAN, 2.0, 9.0, 0.0], [1.0, 2.0, 0.0, 3.0, 4.0, f64::NAN]);
        let (found, count) = correlation(&a, &b).expect("numbers");
        assert!((found - (4.5 / 5.0_f64).sqrt()).abs() < 1e-15 && count == 4, "{found}");
        assert_eq!(correlation(&[1.0, 1.0, 1.0], &[1.0, 2.0, 3.0]), None);
    }

    #[test]
    fn numbers_that_rounding_tells_apart_are_ties() {
        let angles = [0.0, -1.4e-17, 0.3, -2.8e-17, 0.5, 1e-18];
        let rows: Vec<u32> = (0..6).collect();
        let ranked = Ranked::new(&angles, &rows).rounded();
        let tied = [0.0, 0.0, 0.3, 0.0, 0.5, 0.0];
        let (found, expected) = (ranked.ranks(&ranked), Ranked::new(&tied, &rows));
        assert_eq!(found, expected.ranks(&expected));
        // Counts differ by one or not at all, and what is never is later than all.
        let counts = [1.0, 2.0, 3e7];
        let few: Vec<u32> = (0..3).collect();
        let told = Ranked::new(&counts, &few);
        assert_eq!(told.clone().rounded().ranks(&told), told.ranks(&told));
        let never = [0.5, f64::INFINITY, 0.25, f64::INFINITY];
        let late: Vec<u32> = (0..4).collect();
        let told = Ranked::new(&never, &late);
        assert_eq!(told.clone().rounded().ranks(&told), told.ranks(&told));
    }

    #[test]
    fn bounds_are_near_the_critical_values_of_tables() {
        // Zar, Biostatistical Analysis, table B.20, two-sided 5 %.
        for (n, critical) in [(10, 0.648), (20, 0.447), (30, 0.362), (50, 0.279), (100, 0.197)] {
            let values: Vec<f64> = (0..n).map(f64::from).collect();
            let rows: Vec<u32> = (0..n as u32).collect();
            let ranked = Ranked::new(&values, &rows);
            let [driver] = drivers(&[(0, ranked.clone())], &ranked)[..] else { panic!("one") };
            assert_eq!(driver.coefficient, 1.0);
            assert!((driver.bound - critical).abs() < 0.006, "{n}: {}", driver.bound);
        }
    }

    #[test]
    fn a_variable_that_does_not_vary_makes_no_bound_wider() {
        let values: Vec<f64> = (0..30).map(f64::from).collect();
        let rows: Vec<u32> = (0..30).collect();
        let (ranked, constant) = (Ranked::new(&values, &rows), [2.0; 30]);
        let alone = drivers(&[(0, ranked.clone())], &ranked);
        let causes = [(0, ranked.clone()), (1, Ranked::new(&constant, &rows))];
        assert_eq!(drivers(&causes, &ranked), alone);
    }
}
