use crate::{Finding, HingeLabel};

/// The stops of a hinge, between which its angle stays while it is free, or of a slide, between which its travel
/// stays.
///
/// A hinge that comes to a stop rebounds from it at a share of its rate, by an impulsive torque. One that does not
/// rebound rests against the stop, until it is drawn away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stops {
    /// The least angle \[rad\]; of a slide its travel \[L\]; −∞ where there is no stop.
    pub lower: f64,
    /// The largest angle \[rad\]; of a slide its travel \[L\]; ∞ where there is no stop.
    pub upper: f64,
    /// The share of its rate at which the hinge rebounds, from 0 to 1.
    pub restitution: f64,
}

/// One of the stops of a hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The angle at it \[rad\].
    pub angle: f64,
    /// The sign of the rates that lead away from it.
    pub away: f64,
}

impl Stops {
    /// No stop.
    pub const NONE: Self =
        Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY, restitution: 0.0 };

    /// Those that there are, the lower one first.
    pub fn iter(&self) -> impl Iterator<Item = Stop> {
        let both = [Stop { angle: self.lower, away: 1.0 }, Stop { angle: self.upper, away: -1.0 }];
        both.into_iter().filter(|stop| stop.angle.is_finite())
    }

    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.iter().next().is_none()
    }

    /// Whether there is one to a side: of smaller angles where `side` is negative, else of larger ones.
    pub(crate) fn has_on(&self, side: f64) -> bool {
        if side < 0.0 { self.lower.is_finite() } else { self.upper.is_finite() }
    }

    /// The stop at exactly this angle.
    pub fn at(&self, angle: f64) -> Option<Stop> {
        self.iter().find(|stop| stop.angle == angle)
    }

    /// Whether an angle is beyond one of them by more than `same`.
    pub(crate) fn exclude(&self, angle: f64, same: f64) -> bool {
        angle < self.lower - same || angle > self.upper + same
    }

    /// What is wrong with them for a hinge that starts at the angle `start` and may lock at another one.
    pub(crate) fn defect(
        &self,
        label: &HingeLabel,
        start: f64,
        lock: Option<f64>,
    ) -> Option<Finding> {
        let Self { lower, upper, .. } = *self;
        let places = [lower, upper].map(|angle| label.coordinate(angle)).join(" and ");
        let found = format!("stops at {places}");
        if lower.is_nan() || upper.is_nan() || lower >= upper {
            return Some(Finding::new(found, "the lower one first, and below the upper one"));
        }
        let beyond = |what: &str, angle: f64| {
            self.exclude(angle, 0.0).then(|| {
                let expected = format!("{what}, {}, between them", label.coordinate(angle));
                Finding::new(found.clone(), expected)
            })
        };
        beyond("the start", start).or_else(|| beyond("the latch", lock?))
    }
}

impl Default for Stops {
    fn default() -> Self {
        Self::NONE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_are_in_order_around_start_and_latch() {
        let label = HingeLabel::new(0, 0);
        let stops = |lower, upper| Stops { lower, upper, restitution: 0.0 };
        let good = [stops(-1.0, 1.0), stops(0.0, f64::INFINITY), Stops::NONE];
        for of in good {
            assert_eq!(of.defect(&label, 0.0, Some(1.0)), None, "{of:?}");
        }
        let bad = [stops(1.0, -1.0), stops(0.5, 0.5), stops(0.1, 2.0), stops(-1.0, 0.9)];
        for of in bad.into_iter().chain([stops(f64::NAN, 1.0)]) {
            assert!(of.defect(&label, 0.0, Some(1.0)).is_some(), "{of:?}");
        }
        let told = stops(0.5, f64::INFINITY).defect(&label, 0.0, None).expect("a defect");
        assert_eq!(told.found, "stops at 28.6479 deg and inf deg");
        assert_eq!(told.expected, "the start, 0 deg, between them");
        assert_eq!(stops(0.0, 2.0).at(2.0), Some(Stop { angle: 2.0, away: -1.0 }));
        assert_eq!(stops(0.0, 2.0).at(1.0), None);
        assert!(Stops::NONE.is_none() && !stops(0.0, f64::INFINITY).is_none());
    }
}
