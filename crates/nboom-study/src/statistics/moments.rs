//! Mean and deviation of numbers that are not held.

/// By Welford's recurrence (Technometrics 4, 1962), which cancels nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct Moments {
    count: u64,
    mean: f64,
    /// Sum of squared differences from the mean.
    squares: f64,
}

impl Moments {
    pub(super) fn add(&mut self, value: f64) {
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
    }

    pub(super) fn count(&self) -> u64 {
        self.count
    }

    pub(super) fn mean(&self) -> Option<f64> {
        (self.count > 0).then_some(self.mean)
    }

    pub(super) fn deviation(&self) -> Option<f64> {
        (self.count > 1).then(|| (self.squares / (self.count - 1) as f64).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_mean_leaves_the_deviation_its_digits() {
        let mut moments = Moments::default();
        // The numbers 1 to 9 have the variance n (n + 1) / 12 with n = 9.
        (1..=9).for_each(|i| moments.add(1e9 + f64::from(i)));
        assert_eq!(moments.mean(), Some(1e9 + 5.0));
        assert!((moments.deviation().expect("several") - 7.5_f64.sqrt()).abs() < 1e-9);
    }
}
