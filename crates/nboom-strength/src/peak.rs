//! Where a polynomial is largest.

use crate::nodes::{FINE, halves};

/// Share by which the largest value may be missed.
const TOLERANCE: f64 = 1e-10;

/// Most times that an interval is halved.
const MOST_CUTS: usize = 40;

/// Where on [0, 1] the polynomial with these Bernstein coefficients is largest, if it exceeds `level`,
/// which is positive, there.
pub(crate) fn peak(coefficients: &[f64; FINE], level: f64) -> Option<f64> {
    let mut found = (level, None);
    climb(&coefficients.map(|c| [c]), [0.0, 1.0], 0, &mut found);
    found.1
}

/// The polynomial lies between its Bernstein coefficients, the first and last of which are its
/// values at the ends.
fn climb(
    coefficients: &[[f64; 1]; FINE],
    [from, to]: [f64; 2],
    cuts: usize,
    found: &mut (f64, Option<f64>),
) {
    for (end, x) in [(coefficients[0][0], from), (coefficients[FINE - 1][0], to)] {
        if end > found.0 {
            *found = (end, Some(x));
        }
    }
    let bound = |c: &[[f64; 1]; FINE]| c.iter().map(|[c]| *c).fold(f64::NEG_INFINITY, f64::max);
    if cuts == MOST_CUTS || bound(coefficients) <= found.0 * (1.0 + TOLERANCE) {
        return;
    }
    let middle = 0.5 * (from + to);
    let [left, right] = halves(coefficients);
    let parts = [(left, [from, middle]), (right, [middle, to])];
    let [first, second] = if bound(&parts[0].0) >= bound(&parts[1].0) {
        [&parts[0], &parts[1]]
    } else {
        [&parts[1], &parts[0]]
    };
    climb(&first.0, first.1, cuts + 1, found);
    climb(&second.0, second.1, cuts + 1, found);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nodes::{Basis, places, value};

    #[test]
    fn the_largest_of_many_maxima() {
        // Three maxima of almost the same height.
        let curve = |x: f64| 2.0 + (18.0 * x).cos() + 0.001 * x;
        let values = places().map(|x| [curve(x)]);
        let coefficients = Basis::<FINE>::new().coefficients(&values);
        let brute =
            (0..=100_000).map(|i| value(&coefficients, f64::from(i) / 1e5)[0]).fold(0.0, f64::max);
        let at = peak(&coefficients.map(|[c]| c), 1e-3).expect("it is positive");
        let found = value(&coefficients, at)[0];
        assert!(found >= brute * (1.0 - 1e-9), "{found} {brute}");
    }

    #[test]
    fn what_does_not_exceed_the_level_is_not_found() {
        assert_eq!(peak(&[1.0; FINE], 1.0), None);
        assert_eq!(peak(&[1.0; FINE], 0.5), Some(0.0));
    }
}
