use nboom_scalar::Vec3;

use crate::{Finding, Gravity, InitialMotion, over_time, shown};

/// How the main body is held.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Base {
    /// It moves freely.
    #[default]
    Free,
    /// It is fixed to the ground, a test rig: it keeps its attitude and position.
    Fixed,
    /// It moves as prescribed.
    Driven(Drive),
}

/// A motion that is prescribed for the main body: it turns about an axis through O and slides along
/// it. The axis keeps its direction in the main body and in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Unit vector along the axis, main-body axes.
    pub axis: Vec3<f64>,
    /// Rate \[rad/T\] about the axis and speed \[L/T\] along it over time.
    pub points: Vec<DrivePoint>,
}

/// A time of a prescribed motion: rate and speed are straight between two of them, and constant
/// before the first and after the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivePoint {
    /// \[T\]
    pub time: f64,
    /// Rate about the axis \[rad/T\].
    pub rate: f64,
    /// Speed along the axis \[L/T\].
    pub speed: f64,
}

impl over_time::Row for DrivePoint {
    fn time(&self) -> f64 {
        self.time
    }
}

impl Base {
    /// Whether something other than the equations of motion says how the main body moves.
    pub fn is_held(&self) -> bool {
        *self != Self::Free
    }

    /// How it is driven, if it is.
    pub fn drive(&self) -> Option<&Drive> {
        match self {
            Self::Driven(drive) => Some(drive),
            Self::Free | Self::Fixed => None,
        }
    }

    /// The piece of the prescribed motion that holds at `time`: 0 before its first point.
    pub fn piece_at(&self, time: f64) -> usize {
        self.drive().map_or(0, |drive| over_time::piece_at(&drive.points, time))
    }

    /// When a piece of the prescribed motion ends, unless it is the last one.
    pub fn end_of(&self, piece: usize) -> Option<f64> {
        over_time::end_of(&self.drive()?.points, piece)
    }

    /// Angular acceleration of a main body that is held, and that of O, main-body axes, in a piece
    /// of its prescribed motion.
    pub fn accelerations(&self, piece: usize) -> [Vec3<f64>; 2] {
        let Some(drive) = self.drive() else { return [Vec3::zero(); 2] };
        drive.lines(piece).map(|line| drive.axis * over_time::slope(line))
    }
}

/// Departure from a unit vector, or of gravity from the axis, that is taken for rounding in the
/// input.
const SAME_DIRECTION: f64 = 1e-9;

impl Drive {
    /// What is wrong with it in a scene that begins so and has this gravity.
    pub(crate) fn defect(
        &self,
        initial: &InitialMotion,
        gravity: Option<&Gravity>,
    ) -> Option<Finding> {
        let length = self.axis.norm();
        let is_unit = (length - 1.0).abs() <= SAME_DIRECTION;
        if !is_unit {
            let found = format!("an axis of length {}", shown(length));
            return Some(Finding::new(found, "a unit vector"));
        }
        let are_finite = |point: &DrivePoint| {
            [point.time, point.rate, point.speed].iter().all(|number| number.is_finite())
        };
        let back = self.points.windows(2).find(|pair| pair[0].time >= pair[1].time);
        let found = if self.points.is_empty() {
            Some("neither rates nor speeds".to_owned())
        } else if !self.points.iter().all(are_finite) {
            Some("a number that is not finite".to_owned())
        } else {
            back.map(|pair| {
                format!("time {} after time {}", shown(pair[1].time), shown(pair[0].time))
            })
        };
        if let Some(found) = found {
            let expected = "finite rates or speeds at ascending times, at least one";
            return Some(Finding::new(found, expected));
        }
        let turns = self.points.iter().any(|point| point.rate != 0.0);
        let axis = initial.attitude.normalized().to_matrix() * self.axis;
        let aside = gravity.is_some_and(|gravity| gravity.up.cross(axis).norm() > SAME_DIRECTION);
        (turns && aside).then(|| Finding::new("gravity across its axis", "gravity along it"))
    }

    /// Rate about the axis and speed along it at `time`.
    pub fn rates_at(&self, time: f64) -> [f64; 2] {
        let lines = self.lines(over_time::piece_at(&self.points, time));
        lines.map(|line| over_time::value_at(line, time))
    }

    /// Rate and speed of a piece, each with its time at the two points between which it is
    /// straight.
    fn lines(&self, piece: usize) -> [[[f64; 2]; 2]; 2] {
        let around = over_time::around(&self.points, piece);
        [
            around.map(|point| [point.time, point.rate]),
            around.map(|point| [point.time, point.speed]),
        ]
    }
}
