use nboom_model::Material;

use crate::{Margins, PulseShape, Slips, StrengthError};

/// How stresses are judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Peak of the structure's response over the peak of a pulse. It is 1 for a pulse that
    /// is slow against the first bending mode, at most 1.77 for a half-sine and at most 2 for a
    /// rectangle.
    pub amplification: f64,
    /// Shape of pulses over time, which determines how those of several hinges add up.
    pub pulses: PulseShape,
    /// Stress at which all parts yield \[F/L²\], in place of those of their materials.
    pub yield_stress: Option<f64>,
    /// Factor on stresses when they are compared with the yield stress.
    pub safety_factor: f64,
    /// Factor on stresses when they are compared with the ultimate stress.
    pub ultimate_factor: f64,
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
            ultimate_factor: 1.0,
            slips: Slips::default(),
        }
    }
}

impl Settings {
    /// By what loads and margins are judged that is neither the scene's nor usual; `None` if nothing is.
    pub fn in_words(&self) -> Option<String> {
        let factor = |name: &str, factor: f64| (factor != 1.0).then(|| format!("{name} {factor}"));
        let yield_stress = |stress: f64| format!("a yield stress of {stress:e} for all materials");
        let said = [
            factor("dynamic amplification of pulses", self.amplification),
            self.yield_stress.map(yield_stress),
            factor("safety factor", self.safety_factor),
            factor("ultimate factor", self.ultimate_factor),
        ];
        let said: Vec<String> = said.into_iter().flatten().collect();
        (!said.is_empty()).then(|| said.join(", "))
    }

    /// # Errors
    /// When a number is not positive or not finite.
    pub(crate) fn check(&self) -> Result<(), StrengthError> {
        let given = [
            ("dynamic amplification", Some(self.amplification)),
            ("yield stress", self.yield_stress),
            ("safety factor", Some(self.safety_factor)),
            ("ultimate factor", Some(self.ultimate_factor)),
        ];
        let wrong = |&(_, value): &(_, Option<f64>)| {
            value.is_some_and(|value| !(value > 0.0 && value.is_finite()))
        };
        match given.into_iter().find(wrong) {
            Some((name, Some(found))) => Err(StrengthError::Setting { name, found }),
            _ => Ok(()),
        }
    }

    /// Shares of its strength that a part of `material` has left, each limit / (factor · stress) − 1.
    pub(crate) fn margins(&self, material: &Material, von_mises: f64) -> Margins {
        let margin = |limit: f64, factor: f64| limit / (factor * von_mises) - 1.0;
        let yields = self.yield_stress.or(material.yield_stress);
        Margins {
            on_yield: yields.map(|limit| margin(limit, self.safety_factor)),
            on_ultimate: material.ultimate_stress.map(|limit| margin(limit, self.ultimate_factor)),
        }
    }
}
