use nboom_scalar::Vec3;

use crate::axes::{A_DIRECTION, Rotation, Turns, axis_named, unit_vector};
use crate::diagnostic::quoted;

/// A direction: an axis by name, `"x"`, `"-x"`, `"y"`, …, or three numbers of any length but zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction(Way);

#[derive(Clone, Debug, PartialEq)]
enum Way {
    Named(String),
    Along(Vec3<f64>),
}

impl From<&str> for Direction {
    fn from(name: &str) -> Self {
        Self(Way::Named(name.to_owned()))
    }
}

impl From<[f64; 3]> for Direction {
    fn from(vector: [f64; 3]) -> Self {
        Self(Way::Along(vector.into()))
    }
}

impl From<Vec3<f64>> for Direction {
    fn from(vector: Vec3<f64>) -> Self {
        Self(Way::Along(vector))
    }
}

impl Direction {
    /// The unit vector, or what was found instead of what.
    pub(super) fn unit(&self) -> Result<Vec3<f64>, (String, &'static str)> {
        match &self.0 {
            Way::Named(name) => axis_named(name).ok_or_else(|| (quoted(name), A_DIRECTION)),
            Way::Along(vector) => {
                let unit = unit_vector(*vector).filter(|unit| unit.is_finite());
                unit.ok_or_else(|| ("a vector without direction".to_owned(), A_DIRECTION))
            }
        }
    }
}

/// How axes stand to others: a rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes(Words);

#[derive(Clone, Debug, PartialEq)]
enum Words {
    Turn(Direction, Turns<f64>),
    Other(Rotation),
}

impl Axes {
    /// Three turns: about x, then about the new y, then about the new x \[degrees\].
    pub fn euler_xyx_deg(angles: [f64; 3]) -> Self {
        Self(Words::Other(Rotation::EulerXyx(Turns::Degrees(angles))))
    }

    /// Three turns: about x, then about the new y, then about the new x \[radians\].
    pub fn euler_xyx_rad(angles: [f64; 3]) -> Self {
        Self(Words::Other(Rotation::EulerXyx(Turns::Radians(angles))))
    }

    /// One turn about an axis by the right hand \[degrees\].
    pub fn turn_deg(about: impl Into<Direction>, by: f64) -> Self {
        Self(Words::Turn(about.into(), Turns::Degrees(by)))
    }

    /// One turn about an axis by the right hand \[radians\].
    pub fn turn_rad(about: impl Into<Direction>, by: f64) -> Self {
        Self(Words::Turn(about.into(), Turns::Radians(by)))
    }

    /// The turned x, y and z axes.
    pub fn columns(columns: [[f64; 3]; 3]) -> Self {
        Self(Words::Other(Rotation::Columns(columns)))
    }

    /// A unit quaternion, scalar first.
    pub fn quaternion(quaternion: [f64; 4]) -> Self {
        Self(Words::Other(Rotation::Quaternion(quaternion)))
    }

    /// The rotation, or what was found instead of what.
    pub(super) fn rotation(&self) -> Result<Rotation, (String, &'static str)> {
        match &self.0 {
            Words::Turn(about, by) => Ok(Rotation::Turn { about: about.unit()?, by: *by }),
            Words::Other(rotation) => Ok(*rotation),
        }
    }
}
