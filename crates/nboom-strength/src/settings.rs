use crate::{PulseShape, Slips, StrengthError};

/// How stresses are judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Peak of the structure's response over the peak of a lock-up pulse. It is 1 for a pulse that
    /// is slow against the first bending mode, at most 1.77 for a half-sine and at most 2 for a
    /// rectangle.
    pub amplification: f64,
    /// Shape of pulses over time, which determines how those of several latches add up.
    pub pulses: PulseShape,
    /// Stress at which the material yields \[F/L²\]; without it there are no margins.
    pub yield_stress: Option<f64>,
    /// Factor on stresses when they are compared with the yield stress.
    pub safety_factor: f64,
    /// Slips of the program of 1970 in loads and stresses.
    pub slips: Slips,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            amplification: 1.0,
            pulses: PulseShape::default(),
            yield_stress: None,
            safety_factor: 1.0,
            slips: Slips::default(),
        }
    }
}

impl Settings {
    /// # Errors
    /// When a number is not positive or not finite.
    pub(crate) fn check(&self) -> Result<(), StrengthError> {
        let given = [
            ("dynamic amplification", Some(self.amplification)),
            ("yield stress", self.yield_stress),
            ("safety factor", Some(self.safety_factor)),
        ];
        let wrong = |&(_, value): &(_, Option<f64>)| {
            value.is_some_and(|value| !(value > 0.0 && value.is_finite()))
        };
        match given.into_iter().find(wrong) {
            Some((name, Some(found))) => Err(StrengthError::Setting { name, found }),
            _ => Ok(()),
        }
    }

    /// Share of its strength that a part has left, yield / (factor · stress) − 1.
    pub(crate) fn margin(&self, von_mises: f64) -> Option<f64> {
        self.yield_stress.map(|limit| limit / (self.safety_factor * von_mises) - 1.0)
    }
}
