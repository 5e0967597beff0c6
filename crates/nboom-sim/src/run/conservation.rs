use std::fmt;

/// Largest residuals of the conservation laws over a run, after every impulse and all work of
/// thrust, gravity, springs, dashpots, lock-ups and impacts have been accounted for.
///
/// A momentum that is only rounding of the motion is measured by a share of what the energy could
/// make of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Conservation {
    /// Linear momentum, relative to the sum of the bodies' own momenta; none where the main body is held,
    /// whose reaction changes it.
    pub linear_momentum: Option<f64>,
    /// Angular momentum about the mass centre, relative to the sum of the bodies' own; likewise.
    pub angular_momentum: Option<f64>,
    /// Energy, relative to the sum of the bodies' kinetic energies and potentials; where nothing but gravity moves
    /// the mass centre, that of the motion about it.
    pub energy: f64,
}

/// Residuals above this multiple of the relative tolerance are poor. Hundreds of steps err by less;
/// a motion that magnifies errors more does not keep the digits that were asked for.
const MOST: f64 = 1e4;

/// The relative tolerances between which that holds: below, rounding of long runs and of unequal
/// masses counts; above, a hundredth of the whole is poor whatever was asked for.
const JUDGED_BY: (f64, f64) = (1e-12, 1e-6);

/// A conservation law that a run has not kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoorConservation {
    /// What should have been conserved.
    pub quantity: &'static str,
    /// Its residual.
    pub residual: f64,
    /// The largest residual that is good at the tolerance of the run.
    pub limit: f64,
}

impl Conservation {
    /// What each law that holds is called, and its residual.
    pub fn laws(&self) -> impl Iterator<Item = (&'static str, f64)> + use<> {
        let laws = [
            ("linear momentum", self.linear_momentum),
            ("angular momentum", self.angular_momentum),
            ("energy", Some(self.energy)),
        ];
        laws.into_iter().filter_map(|(quantity, residual)| Some((quantity, residual?)))
    }

    /// The residuals that are larger than the relative tolerance `rtol` allows.
    pub fn poor(&self, rtol: f64) -> impl Iterator<Item = PoorConservation> + use<> {
        let (least, most) = JUDGED_BY;
        let limit = MOST * rtol.clamp(least, most);
        let poor = self.laws().filter(move |&(_, residual)| residual.is_nan() || residual > limit);
        poor.map(move |(quantity, residual)| PoorConservation { quantity, residual, limit })
    }
}

impl fmt::Display for PoorConservation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quantity, residual, limit } = self;
        write!(
            f,
            "poor conservation: the {quantity} is off by {residual:.1e} of the whole, at most \
             {limit:.0e} expected at this tolerance; do not trust the motion"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(energy: f64, rtol: f64) -> Vec<&'static str> {
        let found = Conservation { linear_momentum: None, angular_momentum: Some(1e-16), energy };
        found.poor(rtol).map(|law| law.quantity).collect()
    }

    #[test]
    fn residuals_are_judged_by_the_tolerance_within_limits() {
        for (energy, rtol, is_poor) in [
            (0.9e-5, 1e-9, false),
            (1.1e-5, 1e-9, true),
            (0.9e-8, 1e-14, false),
            (1.1e-8, 1e-14, true),
            (0.9e-2, 0.1, false),
            (1.1e-2, 0.1, true),
            (f64::NAN, 1e-9, true),
            (f64::INFINITY, 1e-9, true),
        ] {
            let expected: &[&str] = if is_poor { &["energy"] } else { &[] };
            assert_eq!(told(energy, rtol), expected, "{energy} at {rtol}");
        }
    }

    #[test]
    fn every_law_is_judged() {
        let (linear_momentum, angular_momentum) = (Some(1.0), Some(1.0));
        let found = Conservation { linear_momentum, angular_momentum, energy: 1.0 };
        let poor: Vec<_> = found.poor(1e-9).map(|law| law.quantity).collect();
        assert_eq!(poor, ["linear momentum", "angular momentum", "energy"]);
    }
}
