use nboom_model::{Rotor, RotorSpeed};

use super::error::of_rotor;
use super::{Direction, WordsError};

/// A rotor in words: balanced, at a commanded speed relative to its body.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct RotorWords {
    axis: Direction,
    inertia: f64,
    speed: RotorSpeed,
}

/// A rotor with this axis (body axes) and this inertia about it, which is not in that of the body;
/// at rest until it has a speed.
pub fn rotor(axis: impl Into<Direction>, inertia: f64) -> RotorWords {
    RotorWords { axis: axis.into(), inertia, speed: RotorSpeed::Constant(0.0) }
}

impl RotorWords {
    /// Speed relative to the body \[degrees/T\].
    pub fn speed_deg(self, speed: f64) -> Self {
        self.speed_rad(speed.to_radians())
    }

    /// Speed relative to the body \[radians/T\].
    pub fn speed_rad(self, speed: f64) -> Self {
        Self { speed: RotorSpeed::Constant(speed), ..self }
    }

    /// Speeds relative to the body \[degrees/T\] at ascending times, straight between them.
    pub fn speed_over_time_deg(self, speeds: Vec<[f64; 2]>) -> Self {
        let in_radians = speeds.into_iter().map(|[time, speed]| [time, speed.to_radians()]);
        self.speed_over_time_rad(in_radians.collect())
    }

    /// Speeds relative to the body \[radians/T\] at ascending times, straight between them.
    pub fn speed_over_time_rad(self, speeds: Vec<[f64; 2]>) -> Self {
        Self { speed: RotorSpeed::Table(speeds), ..self }
    }

    /// The rotor number `number`, from 0, of what is called `owner`, in the main body until it is put elsewhere.
    fn rotor(&self, owner: &str, number: usize, errors: &mut Vec<WordsError>) -> Option<Rotor> {
        let Self { axis, inertia, speed } = self;
        let axis = axis.unit().map_err(|(found, expected)| {
            let of = of_rotor(owner, number);
            errors.push(WordsError::Value { of, key: "axis", found, expected });
        });
        Some(Rotor { body: None, axis: axis.ok()?, inertia: *inertia, speed: speed.clone() })
    }
}

/// The rotors of what is called `owner`, in the main body until they are put elsewhere.
pub(super) fn rotors(
    words: &[RotorWords],
    owner: &str,
    errors: &mut Vec<WordsError>,
) -> Vec<Rotor> {
    let numbered = words.iter().enumerate();
    numbered.filter_map(|(number, rotor)| rotor.rotor(owner, number, errors)).collect()
}
