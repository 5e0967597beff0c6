//! How many cases have latched by a time.

use super::LatchTime;
use super::confidence::proportion;

/// Times that are told.
const MOST: usize = 60;

/// The empirical distribution of these ascending lock-up times of so many cases at some of them, the first and
/// the last among them.
pub(super) fn times(sorted: &[f64], cases: usize) -> Vec<LatchTime> {
    let Some(last) = sorted.len().checked_sub(1) else { return Vec::new() };
    let told = sorted.len().min(MOST);
    let mut times: Vec<LatchTime> = Vec::with_capacity(told);
    for i in 0..told {
        let time = sorted[i * last / (told - 1).max(1)];
        let count = sorted.partition_point(|other| *other <= time);
        if times.last().is_none_or(|before| before.time < time) {
            times.push(LatchTime { time, latched: proportion(count as u64, cases as u64) });
        }
    }
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_times_are_told_once_and_cases_without_one_count() {
        let found = times(&[1.0, 2.0, 2.0, 3.0], 8);
        let shares: Vec<_> = found.iter().map(|at| (at.time, at.latched.count)).collect();
        assert_eq!(shares, [(1.0, 1), (2.0, 3), (3.0, 4)]);
        assert!(found.iter().all(|at| at.latched.of == 8));
        assert!(times(&[], 8).is_empty());
        assert_eq!(times(&[1.0], 8).len(), 1);
    }

    #[test]
    fn of_many_times_both_ends_are_told() {
        let many: Vec<f64> = (1..=1000).map(f64::from).collect();
        let found = times(&many, 1000);
        assert_eq!(found.len(), MOST);
        assert_eq!((found[0].time, found[MOST - 1].time), (1.0, 1000.0));
        assert!(found.iter().all(|at| at.latched.count as f64 == at.time));
    }
}
