//! How many cases have latched by a time.

use super::LatchTime;
use super::confidence::proportion;

/// Times that are told, at most.
const MOST: usize = 240;

/// The first and the last of many times, which are all told: few cases decide about the chance to be late.
const AT_ENDS: usize = 20;

/// The empirical distribution of these ascending lock-up times of so many cases at some of them, the first and
/// the last among them.
pub(super) fn times(sorted: &[f64], cases: usize) -> Vec<LatchTime> {
    let mut times: Vec<LatchTime> = Vec::with_capacity(sorted.len().min(MOST));
    for place in places(sorted.len()) {
        let time = sorted[place];
        if times.last().is_none_or(|before| before.time < time) {
            let before = sorted.partition_point(|other| *other < time) as u64;
            let count = sorted.partition_point(|other| *other <= time) as u64;
            times.push(LatchTime { time, before, latched: proportion(count, cases as u64) });
        }
    }
    times
}

/// The places of the times that are told among so many, ascending: all at the ends, in between at even distances.
fn places(count: usize) -> Vec<usize> {
    if count <= MOST {
        return (0..count).collect();
    }
    let (first, last, between) = (AT_ENDS, count - AT_ENDS, MOST - 2 * AT_ENDS);
    let within = (1..=between).map(|i| first + i * (last - first) / (between + 1));
    (0..first).chain(within).chain(last..count).collect()
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
        let before: Vec<_> = found.iter().map(|at| at.before).collect();
        assert_eq!(before, [0, 1, 3]);
    }

    #[test]
    fn of_many_times_those_at_both_ends_are_told() {
        let many: Vec<f64> = (1..=1000).map(f64::from).collect();
        let found = times(&many, 1000);
        assert_eq!(found.len(), MOST);
        assert!(found.iter().all(|at| at.latched.count as f64 == at.time));
        assert!(found.iter().all(|at| at.before as f64 == at.time - 1.0));
        let told: Vec<f64> = found.iter().map(|at| at.time).collect();
        assert!(told[..AT_ENDS].iter().zip(1..).all(|(time, i)| *time == f64::from(i)));
        assert!(told[MOST - AT_ENDS..].iter().zip(981..).all(|(time, i)| *time == f64::from(i)));
    }

    /// Straight lines from what is told to what has latched before the next time that is told are as near to the
    /// truth as cases are even between two of them.
    #[test]
    fn lines_between_told_times_follow_the_distribution() {
        let late = |i: usize| -(1.0 - (i as f64 + 0.5) / 20_000.0).ln();
        let sorted: Vec<f64> = (0..20_000).map(late).collect();
        let found = times(&sorted, sorted.len());
        for pair in found.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            for k in 1..10 {
                let part = f64::from(k) / 10.0;
                let time = from.time + part * (to.time - from.time);
                let truth = sorted.partition_point(|other| *other <= time) as f64;
                let start = from.latched.count as f64;
                let line = start + part * (to.before as f64 - start);
                // Steps would be off by a two-hundredth of the cases.
                assert!((line - truth).abs() < 2e-3 * 20_000.0, "{time}: {line}, {truth}");
            }
        }
    }
}
