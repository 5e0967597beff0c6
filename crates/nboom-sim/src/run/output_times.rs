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

    /// How many intervals these cut the span of a run into, or without them `samples` uniform ones: none where it has
    /// no length.
    pub fn intervals(listed: Option<&Self>, samples: usize, [start, end]: [f64; 2]) -> usize {
        match listed {
            _ if start == end => 0,
            Some(times) => times.inside([start, end]).len() + 1,
            None => samples,
        }
    }

    fn inside(&self, [start, end]: [f64; 2]) -> &[f64] {
        let after_start = &self.0[self.0.partition_point(|time| *time <= start)..];
        &after_start[..after_start.partition_point(|time| *time < end)]
    }

    /// The output time number `n`, from 0, of a run over a span that is cut so; infinite after the last one.
    pub(super) fn nth(
        listed: Option<&Self>,
        samples: usize,
        [start, end]: [f64; 2],
        n: usize,
    ) -> f64 {
        let intervals = Self::intervals(listed, samples, [start, end]);
        match listed {
            _ if n > intervals => f64::INFINITY,
            _ if n == 0 => start,
            _ if n == intervals => end,
            Some(times) => times.inside([start, end])[n - 1],
            None => start + (end - start) * (n as f64 / samples as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(times: &[f64], span: [f64; 2]) -> Vec<f64> {
        let times = OutputTimes::at(times.iter().copied());
        of(Some(&times), 0, span)
    }

    fn of(listed: Option<&OutputTimes>, samples: usize, span: [f64; 2]) -> Vec<f64> {
        let nth = |n| OutputTimes::nth(listed, samples, span, n);
        let all: Vec<f64> = (0..).map(nth).take_while(|time| time.is_finite()).collect();
        assert_eq!(OutputTimes::intervals(listed, samples, span), all.len() - 1);
        all
    }

    #[test]
    fn start_and_end_are_told_once_and_times_in_between_ascend() {
        assert_eq!(all(&[2.0, 1.0, 2.0, f64::NAN], [0.0, 3.0]), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(all(&[-1.0, 0.0, 1.0, 3.0, 4.0], [0.0, 3.0]), [0.0, 1.0, 3.0]);
        assert_eq!(all(&[], [0.0, 3.0]), [0.0, 3.0]);
        assert_eq!(all(&[5.0, 6.0], [0.0, 3.0]), [0.0, 3.0]);
    }

    #[test]
    fn uniform_times_are_told_from_start_to_end() {
        assert_eq!(of(None, 4, [1.0, 3.0]), [1.0, 1.5, 2.0, 2.5, 3.0]);
        assert_eq!(of(None, 1, [1.0, 3.0]), [1.0, 3.0]);
    }

    #[test]
    fn a_run_of_no_length_is_told_once() {
        assert_eq!(of(None, 200, [3.0, 3.0]), [3.0]);
        assert_eq!(all(&[], [3.0, 3.0]), [3.0]);
        assert_eq!(all(&[1.0, 3.0, 4.0], [3.0, 3.0]), [3.0]);
    }
}
