//! Intervals of confidence.

use statrs::distribution::{Binomial, DiscreteCDF};

use super::Proportion;

/// What each end of an interval may miss: 5 % together.
pub(super) const TAIL: f64 = 0.025;

/// The normal score of [`TAIL`].
const SCORE: f64 = 1.959_963_984_540_054;

/// Which of `n` ascending numbers, from 0, bound the quantile of this share; none where `n` is too small.
///
/// The number of draws below the quantile is binomial, whatever the distribution (David and Nagaraja, Order
/// Statistics, 7.1).
pub(super) fn order_statistics(n: usize, share: f64) -> (Option<usize>, Option<usize>) {
    let below = Binomial::new(share, n as u64).expect("a share lies between 0 and 1");
    let rank = |probability: f64| below.inverse_cdf(probability) as usize;
    let (low, high) = (rank(TAIL).checked_sub(1), rank(1.0 - TAIL));
    (low, (high < n).then_some(high))
}

/// `count` of `of` with Wilson's interval (Journal of the American Statistical Association 22, 1927).
pub(super) fn proportion(count: u64, of: u64) -> Proportion {
    if of == 0 {
        return Proportion { count, of, low: 0.0, high: 1.0 };
    }
    let (n, squared) = (of as f64, SCORE * SCORE);
    let share = count as f64 / n;
    let middle = (share + 0.5 * squared / n) / (1.0 + squared / n);
    let variance = share * (1.0 - share) / n + 0.25 * squared / (n * n);
    let half = SCORE * variance.sqrt() / (1.0 + squared / n);
    // At both ends the exact bound is the end; rounding must not move it.
    let low = if count == 0 { 0.0 } else { middle - half };
    let high = if count == of { 1.0 } else { middle + half };
    Proportion { count, of, low, high }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_that_bound_a_median_are_those_of_tables() {
        // Hollander and Wolfe, Nonparametric Statistical Methods, confidence of at least 95 %; ranks from 1.
        for (n, low, high) in [(6, 1, 6), (10, 2, 9), (20, 6, 15), (50, 18, 33), (100, 40, 61)] {
            assert_eq!(order_statistics(n, 0.5), (Some(low - 1), Some(high - 1)), "{n}");
        }
        assert_eq!(order_statistics(5, 0.5), (None, None));
    }

    #[test]
    fn there_is_a_bound_as_soon_as_all_draws_lie_on_one_side_seldom_enough() {
        for (share, fewest) in [(0.95, 72), (0.99, 368)] {
            assert!(f64::powi(share, fewest) <= TAIL && f64::powi(share, fewest - 1) > TAIL);
            let fewest = fewest as usize;
            assert_eq!(order_statistics(fewest, share).1, Some(fewest - 1));
            assert_eq!(order_statistics(fewest - 1, share).1, None);
            assert_eq!(order_statistics(fewest, 1.0 - share).0, Some(0));
            assert_eq!(order_statistics(fewest - 1, 1.0 - share).0, None);
        }
    }

    #[test]
    fn proportions_are_those_that_newcombe_published() {
        // Newcombe, Statistics in Medicine 17, 1998, table I, method 3.
        for (count, of, low, high) in [
            (81, 263, 0.2553, 0.3662),
            (15, 148, 0.0624, 0.1605),
            (0, 20, 0.0, 0.1611),
            (1, 29, 0.0061, 0.1718),
        ] {
            let found = proportion(count, of);
            assert!(
                (found.low - low).abs() < 5e-5 && (found.high - high).abs() < 5e-5,
                "{found:?}"
            );
            let others = proportion(of - count, of);
            assert!((1.0 - others.high - found.low).abs() < 1e-15);
        }
    }
}
