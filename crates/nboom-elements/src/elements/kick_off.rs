use nboom_model::Hinge;
use nboom_scalar::{Real, Vec3};

use crate::{EventName, LineNames, Names};

/// What kick-off springs are called.
pub(crate) const NAMES: Names = Names {
    name: "kick-off spring",
    rise: EventName {
        in_files: "kick_off_disengage",
        in_listing: "KICKOFF SPRING DISENGAGES AT HINGE",
    },
    fall: EventName { in_files: "kick_off_engage", in_listing: "KICKOFF SPRING ENGAGES AT HINGE" },
    line: Some(LineNames {
        force: "kick-off force",
        length: "kick-off length",
        force_column: "KICKOFF SPRING FORCE",
        length_column: "EXTENSION OF KICKOFF SPRING",
    }),
};

/// Force of a kick-off spring by its length, eq. (6.10): F = a₀ + a₁x + a₂x² + a₃x³, positive
/// when it pushes its ends apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KickOffLaw<R> {
    coefficients: [R; 4],
}

impl<R: Real> KickOffLaw<R> {
    /// The law with coefficients a₀ to a₃.
    pub fn new(coefficients: [f64; 4]) -> Self {
        Self::of_numbers(coefficients.map(R::constant))
    }

    /// The law with coefficients a₀ to a₃ of any scalar.
    pub fn of_numbers(coefficients: [R; 4]) -> Self {
        Self { coefficients }
    }

    /// a₀ to a₃.
    pub fn numbers(&self) -> [R; 4] {
        self.coefficients
    }

    /// Force at `length`, while the spring acts.
    #[inline(always)]
    pub fn force(&self, length: R) -> R {
        let [a0, a1, a2, a3] = self.coefficients;
        ((a3 * length + a2) * length + a1) * length + a0
    }

    /// The force on the end to which `span` leads from the other one, while the spring acts; NaN where
    /// the ends meet.
    #[inline(always)]
    pub fn push(&self, span: Vec3<R>) -> Vec3<R> {
        let length = span.norm();
        span * (self.force(length) / length)
    }

    /// Potential energy at `length`, zero at zero length. A spring that has let go keeps the
    /// potential of its limit length.
    pub fn potential(&self, length: R) -> R {
        let [a0, a1, a2, a3] = self.coefficients;
        let part = |a: R, power: f64| a * R::constant(1.0 / power);
        let sum = ((part(a3, 4.0) * length + part(a2, 3.0)) * length + part(a1, 2.0)) * length;
        -((sum + a0) * length)
    }
}

/// The most energy that the spring of a hinge can store, every term taken by its magnitude.
pub(crate) fn stored(hinge: &Hinge) -> f64 {
    hinge.kick_off.map_or(0.0, |spring| {
        let magnitudes = spring.coefficients.map(f64::abs);
        KickOffLaw::<f64>::new(magnitudes).potential(spring.limit_length).abs()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_forces_at_the_printed_lengths() {
        // Forces and lengths of the four springs in the printout of Section 18, at the initial time.
        let springs = [
            ([10.0, -0.2, 0.0, 0.0], 8.0, 8.4),
            ([4.0, -0.5, 0.05, 0.0], 10.0, 4.0),
            ([1.0, -0.02, 0.0, 0.0], 2.0, 0.96),
            ([20.0, -0.6, 0.0, 0.0], 2.0, 18.8),
        ];
        for (coefficients, length, force) in springs {
            let law = KickOffLaw::<f64>::new(coefficients);
            assert!((law.force(length) - force).abs() < 1e-14);
        }
    }

    #[test]
    fn force_is_the_slope_of_the_potential_downwards() {
        let law = KickOffLaw::<f64>::new([4.0, -0.5, 0.05, 0.02]);
        let h = 1e-4;
        for x in [0.3, 2.0, 9.0] {
            let slope = (law.potential(x + h) - law.potential(x - h)) / (2.0 * h);
            // Second differences err by h² F''/6, below 1e-9 here.
            assert!((slope + law.force(x)).abs() < 1e-8);
        }
    }
}
