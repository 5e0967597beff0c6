/// Times at which a run tells its motion, between its initial time and its end, which are always told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutputTimes(Vec<f64>);

impl OutputTimes {
    /// These times; what is no number is left out.
    pub fn at(times: impl IntoIterator<Item = f64>) -> Self {
        let mut times: Vec<f64> = times.into_iter().filter(|time| time.is_finite()).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        Self(times)
    }

    /// How many intervals they cut the span of a run into.
    pub fn intervals(&self, span: [f64; 2]) -> usize {
        self.inside(span).len() + 1
    }

    fn inside(&self, [start, end]: [f64; 2]) -> &[f64] {
        let after_start = &self.0[self.0.partition_point(|time| *time <= start)..];
        &after_start[..after_start.partition_point(|time| *time < end)]
    }

    /// The output time number `n`, from 0, of a run over a span; infinite after the last one.
    pub(super) fn nth(&self, n: usize, [start, end]: [f64; 2]) -> f64 {
        let inside = self.inside([start, end]);
        match n.checked_sub(1) {
            None => start,
            Some(i) if i <= inside.len() => inside.get(i).copied().unwrap_or(end),
            Some(_) => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(times: &[f64], span: [f64; 2]) -> Vec<f64> {
        let times = OutputTimes::at(times.iter().copied());
        let all: Vec<f64> =
            (0..).map(|n| times.nth(n, span)).take_while(|time| time.is_finite()).collect();
        assert_eq!(times.intervals(span), all.len() - 1);
        all
    }

    #[test]
    fn start_and_end_are_told_once_and_times_in_between_ascend() {
        assert_eq!(all(&[2.0, 1.0, 2.0, f64::NAN], [0.0, 3.0]), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(all(&[-1.0, 0.0, 1.0, 3.0, 4.0], [0.0, 3.0]), [0.0, 1.0, 3.0]);
        assert_eq!(all(&[], [0.0, 3.0]), [0.0, 3.0]);
        assert_eq!(all(&[5.0, 6.0], [0.0, 3.0]), [0.0, 3.0]);
    }
}
