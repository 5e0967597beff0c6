//! Samples of known distributions.

use nboom_study::statistics::{Role, Spread, Statistics, Summary};
use nboom_tables::Cell;
use proptest::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::{field, uniform};

fn normal(share: f64) -> f64 {
    Normal::new(3.0, 2.0).expect("a deviation").inverse_cdf(share)
}

/// Statistics of rows of two variables and one result.
fn of_rows(rows: impl Iterator<Item = [f64; 3]>) -> Summary {
    let roles = [("a", Role::Variable), ("b", Role::Variable), ("c", Role::Result)];
    let mut statistics =
        Statistics::new(roles.into_iter().map(|(name, role)| field(name, role)).collect(), &[]);
    rows.for_each(|row| statistics.row(&row.map(Cell::Number)));
    statistics.finish()
}

fn of_numbers(numbers: impl Iterator<Item = f64>) -> Spread {
    of_rows(numbers.map(|x| [x, 0.0, 0.0])).columns.swap_remove(0).spreads.swap_remove(0)
}

#[test]
fn percentiles_of_samples_are_those_of_their_distributions() {
    let n = 20_000;
    for (seed, quantile) in [(1, (|u| u) as fn(f64) -> f64), (2, normal)] {
        let found = of_numbers(uniform(seed).take(n).map(quantile));
        assert_eq!(found.percentiles.len(), 7);
        for one in found.percentiles {
            // The share below an estimate has the variance p (1 - p) / n.
            let p = one.percent / 100.0;
            let off = 4.5 * (p * (1.0 - p) / n as f64).sqrt();
            assert!(quantile(p - off) < one.value && one.value < quantile(p + off), "{one:?}");
            let (low, high) = (one.low.expect("many"), one.high.expect("many"));
            assert!(low < one.value && one.value < high);
            assert!(low > quantile(p - 2.0 * off) && high < quantile(p + 2.0 * off), "{one:?}");
        }
    }
    let found = of_numbers(uniform(3).take(n).map(normal));
    let (mean, deviation) = (found.mean.expect("many"), found.deviation.expect("many"));
    assert!((mean - 3.0).abs() < 4.5 * 2.0 / (n as f64).sqrt());
    assert!((deviation - 2.0).abs() < 4.5 * 2.0 / (2.0 * n as f64).sqrt());
}

#[test]
fn intervals_hold_what_they_promise() {
    let (studies, n) = (600, 150);
    let mut held = [0; 7];
    for seed in 0..studies {
        let found = of_numbers(uniform(1000 + seed).take(n).map(normal)).percentiles;
        for (held, one) in held.iter_mut().zip(found) {
            let truth = normal(one.percent / 100.0);
            let is_above = one.low.is_none_or(|low| low <= truth);
            *held += u64::from(is_above && one.high.is_none_or(|high| truth <= high));
        }
    }
    // 95 % of 600, less 4.5 deviations of a binomial number.
    let least = 570.0 - 4.5 * (600.0 * 0.95 * 0.05_f64).sqrt();
    assert!(held.iter().all(|held| *held as f64 > least), "{held:?}");
    assert!(held.iter().all(|held| *held < studies), "an interval that misses nothing: {held:?}");
}

#[test]
fn few_numbers_have_percentiles_with_few_bounds() {
    let found = of_numbers([2.0, 1.0].into_iter());
    let [first, .., last] = found.percentiles[..] else { panic!("seven") };
    assert_eq!((first.low, last.high), (None, None));
    let median = found.percentiles[3];
    assert_eq!((median.value, median.low, median.high), (1.5, None, None));
    assert_eq!((found.mean, found.deviation), (Some(1.5), Some(0.5_f64.sqrt())));
    let found = of_numbers([2.0].into_iter());
    assert_eq!((found.mean, found.deviation, found.percentiles[6].value), (Some(2.0), None, 2.0));
    let found = of_rows(std::iter::empty());
    assert_eq!(found.columns[0].spreads[0].percentiles, []);
}

#[test]
fn what_drives_a_result_is_found() {
    let mut random = uniform(7);
    let mut draw = || random.next().expect("endless");
    let found = of_rows((0..2000).map(|_| {
        let (a, b) = (draw(), draw());
        [a, b, -(5.0 * b).exp()]
    }));
    let [first, second] = found.columns[2].drivers[..] else { panic!("two variables") };
    assert_eq!((first.variable, first.coefficient), (1, -1.0));
    assert_eq!(second.variable, 0);
    assert!(second.coefficient.abs() < second.bound, "{second:?}");
    assert!(found.columns[0].drivers.is_empty(), "a variable has none");
}

#[test]
fn independent_variables_stay_within_their_bound() {
    let studies = 300;
    let beyond = |seed: u64| {
        let numbers: Vec<f64> = uniform(5000 + seed).take(90).collect();
        let found = of_rows(numbers.chunks(3).map(|row| [row[0], row[1], row[2]]));
        found.columns[2].drivers.iter().any(|one| one.coefficient.abs() > one.bound)
    };
    let count = (0..studies).filter(|seed| beyond(*seed)).count() as f64;
    // At most 5 %, and 4.5 deviations.
    assert!(count < 15.0 + 4.5 * (300.0 * 0.05 * 0.95_f64).sqrt(), "{count}");
    assert!(count > 0.0, "the bound is never reached");
}

proptest! {
    #[test]
    fn any_numbers_keep_their_order(numbers in prop::collection::vec(prop::num::f64::ANY, 0..60)) {
        let found = of_numbers(numbers.iter().copied());
        let used = numbers.iter().filter(|x| x.abs() <= 1e150).count();
        prop_assert_eq!(found.count, used as u64);
        prop_assert_eq!(found.percentiles.len(), if used > 0 { 7 } else { 0 });
        for pair in found.percentiles.windows(2) {
            prop_assert!(pair[0].value <= pair[1].value);
        }
        for one in &found.percentiles {
            prop_assert!(one.low.is_none_or(|low| low <= one.value));
            prop_assert!(one.high.is_none_or(|high| one.value <= high));
        }
    }
}
