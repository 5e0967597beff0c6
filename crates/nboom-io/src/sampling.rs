use nboom_model::{Finding, shown};

use crate::SceneSettings;

/// Which output times a scene asks for; the initial time and the end are always among them.
#[derive(Clone, Debug, PartialEq)]
pub enum Sampling {
    /// So many after the initial one, uniform to the end.
    Uniform(usize),
    /// From the initial time on with this time between them \[T\].
    Every(f64),
    /// These \[T\], ascending.
    At(Vec<f64>),
}

/// More output times than a run may have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.finding())]
pub struct TooManyTimes {
    /// From one to the next.
    pub every: f64,
    /// The initial time.
    pub start: f64,
    /// The end.
    pub end: f64,
}

impl TooManyTimes {
    /// What was found and what expected.
    pub fn finding(&self) -> Finding {
        let [every, start, end] = [self.every, self.start, self.end].map(shown);
        Finding::new(
            format!("output times every {every} from {start} to {end}"),
            format!("a positive time and at most {MOST_SAMPLES} of them"),
        )
    }
}

/// Most output times of a run.
pub const MOST_SAMPLES: usize = 10_000_000;

/// Share of the time between output times below which the last one is the end.
const SAME: f64 = 1e-9;

impl SceneSettings {
    /// Which output times a run has that is given `samples` uniform ones or none: those, else the scene's. Without
    /// either it has as many as runs have by default.
    pub fn sampling_of_run(&self, samples: Option<usize>) -> Option<Sampling> {
        samples.map(Sampling::Uniform).or_else(|| self.sampling.clone())
    }
}

impl Sampling {
    /// How many there are after the initial one, of uniform ones.
    pub fn samples(&self) -> Option<usize> {
        match self {
            Self::Uniform(samples) => Some(*samples),
            Self::Every(_) | Self::At(_) => None,
        }
    }

    /// The output times of a run from `start` to `end`, in order; `None` for uniform ones.
    ///
    /// # Errors
    /// When there are too many.
    pub fn times(&self, [start, end]: [f64; 2]) -> Result<Option<Vec<f64>>, TooManyTimes> {
        Ok(match self {
            Self::Uniform(_) => None,
            Self::At(times) => Some(times.clone()),
            Self::Every(every) => {
                // False also for what is no number.
                let are_few = *every > 0.0 && (end - start) / every <= MOST_SAMPLES as f64;
                if !are_few {
                    return Err(TooManyTimes { every: *every, start, end });
                }
                let time = |k: u32| start + f64::from(k) * every;
                let before_end = |time: &f64| end - time > SAME * every;
                Some((1..).map(time).take_while(before_end).collect())
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_from_one_to_the_next_end_before_the_end() {
        let times = |every, span| Sampling::Every(every).times(span);
        assert_eq!(times(0.5, [1.0, 2.5]), Ok(Some(vec![1.5, 2.0])));
        assert_eq!(times(2.0, [1.0, 2.5]), Ok(Some(Vec::new())));
        // 3 * 0.1 is above 0.3.
        assert_eq!(times(0.1, [0.0, 0.3]), Ok(Some(vec![0.1, 0.2])));
        assert_eq!(Sampling::Uniform(7).times([0.0, 1.0]), Ok(None));
    }

    #[test]
    fn more_times_than_a_run_may_have_are_refused() {
        for (every, end) in [(1e-9, 1.0), (0.0, 1.0), (-1.0, 1.0), (1.0, 1e300), (f64::NAN, 1.0)] {
            assert!(Sampling::Every(every).times([0.0, end]).is_err(), "{every} {end}");
        }
    }
}
