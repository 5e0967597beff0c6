//! Histograms.

use super::Histogram;
use super::percentile::quantile;

/// Most shares of a histogram.
const MOST: f64 = 60.0;

/// How many of these ascending numbers lie where; widths by Freedman and Diaconis, by Sturges where half of the
/// numbers are equal. Numbers that count as one have one share.
pub(super) fn histogram(sorted: &[f64], are_one: bool) -> Option<Histogram> {
    let (from, to) = (*sorted.first()?, *sorted.last()?);
    let n = sorted.len() as f64;
    let middle_half = quantile(sorted, 0.75)? - quantile(sorted, 0.25)?;
    let width = 2.0 * middle_half / n.cbrt();
    let shares = if are_one {
        1.0
    } else if width > 0.0 {
        ((to - from) / width).ceil()
    } else {
        n.log2().ceil() + 1.0
    };
    let mut counts = vec![0; shares.clamp(1.0, MOST) as usize];
    let last = counts.len() - 1;
    for value in sorted {
        let place = (value - from) / (to - from) * counts.len() as f64;
        // Of equal numbers it is NaN, which becomes 0.
        counts[last.min(place as usize)] += 1;
    }
    Some(Histogram { from, to, counts })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_the_rule() {
        // Of 0 to 1 in 1000 steps half lie in 0.5, so that the width is 1 / 10.
        let numbers: Vec<f64> = (0..=1000).map(|i| f64::from(i) / 1000.0).collect();
        let found = histogram(&numbers, false).expect("numbers");
        assert_eq!((found.from, found.to, found.counts.len()), (0.0, 1.0, 11));
        assert_eq!(found.counts.iter().sum::<u64>(), 1001);
        assert!(found.counts.iter().all(|count| (90..=92).contains(count)), "{found:?}");
    }

    #[test]
    fn few_or_equal_or_far_numbers_do_no_harm() {
        assert_eq!(histogram(&[], true), None);
        assert_eq!(histogram(&[2.0; 7], true).expect("numbers").counts, [7]);
        let mut mostly = vec![0.0; 99];
        mostly.push(1.0);
        let found = histogram(&mostly, false).expect("numbers");
        assert_eq!((found.counts[0], found.counts.last()), (99, Some(&1)));
        let far: Vec<f64> = (0..100).map(f64::from).chain([1e9]).collect();
        let found = histogram(&far, false).expect("numbers");
        assert_eq!((found.counts.len(), found.counts[0], found.counts[59]), (60, 100, 1));
    }
}
