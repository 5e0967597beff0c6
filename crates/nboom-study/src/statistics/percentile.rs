//! Percentiles.

use super::Percentile;
use super::confidence::order_statistics;

/// Those that are told \[%\].
const PERCENTS: [f64; 7] = [1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0];

/// Percentiles of ascending numbers with their intervals; none of no numbers. The last ones may be infinite.
pub(super) fn percentiles(sorted: &[f64]) -> Vec<Percentile> {
    let of = |percent: f64| {
        let share = percent / 100.0;
        let value = quantile(sorted, share)?;
        let (low, high) = order_statistics(sorted.len(), share);
        // Of few numbers all may lie on one side of the percentile; its interval then reaches to the estimate.
        let (before, after, _) = neighbours(sorted.len() - 1, share);
        let (low, high) = (low.map(|i| sorted[i.min(before)]), high.map(|i| sorted[i.max(after)]));
        Some(Percentile { percent, value, low, high })
    };
    PERCENTS.into_iter().filter_map(of).collect()
}

/// The quantile of ascending numbers, linear between them (definition 7 of Hyndman and Fan).
pub(super) fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let (before, after, part) = neighbours(sorted.len().checked_sub(1)?, share);
    let (low, high) = (sorted[before], sorted[after]);
    // Between a time and never there is nothing.
    Some(if part == 0.0 || low == high { low } else { low + part * (high - low) })
}

/// The numbers at both sides of a quantile, and how far it is from one to the other.
fn neighbours(last: usize, share: f64) -> (usize, usize, f64) {
    let place = share * last as f64;
    let before = place.floor() as usize;
    (before, last.min(before + 1), place - before as f64)
}
