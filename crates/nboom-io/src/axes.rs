//! Rotations and directions, as scenes and programs say them.

use nboom_scalar::{Mat3, Quaternion, Vec3};

use crate::angles;
use crate::deck::shown;

/// Deviation from a rotation, or from length 1, that counts as rounding in the scene.
const ROTATION_TOLERANCE: f64 = 1e-6;

/// Deviation of a squared length from 1 that rounding explains.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What messages expect of a direction.
pub(crate) const A_DIRECTION: &str = "\"x\", \"-x\", \"y\", \"-y\", \"z\", \"-z\" or three numbers";

/// A rotation, in one of four ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rotation {
    /// ψ, θ, φ: about x, then about the new y, then about the new x.
    EulerXyx(Turns<[f64; 3]>),
    /// One turn about a unit vector, by the right hand.
    Turn { about: Vec3<f64>, by: Turns<f64> },
    /// The turned axes.
    Columns([[f64; 3]; 3]),
    /// A unit quaternion, scalar first.
    Quaternion([f64; 4]),
}

/// Angles, as they are given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Turns<T> {
    Degrees(T),
    Radians(T),
}

impl Rotation {
    /// The rotation matrix, or what was found instead of what.
    pub fn matrix(&self) -> Result<Mat3<f64>, (String, &'static str)> {
        match *self {
            Self::EulerXyx(Turns::Degrees([psi, theta, phi])) => {
                Ok(angles::rotation_from_degrees(psi, theta, phi))
            }
            Self::EulerXyx(Turns::Radians([psi, theta, phi])) => {
                Ok(Mat3::from_euler_121(psi, theta, phi))
            }
            Self::Turn { about, by } => {
                let sines = match by {
                    Turns::Degrees(by) => angles::sin_cos(by),
                    Turns::Radians(by) => by.sin_cos(),
                };
                Ok(angles::rotation_about(about, sines))
            }
            Self::Columns([x, y, z]) => {
                let rotation = Mat3::from_columns(x.into(), y.into(), z.into());
                let defect = rotation.rotation_defect();
                let found = || format!("axes that depart from a rotation by {}", shown(defect));
                let is_rotation = defect <= ROTATION_TOLERANCE;
                let expected = "three right-handed orthogonal unit vectors";
                if is_rotation { Ok(rotation) } else { Err((found(), expected)) }
            }
            Self::Quaternion(_) => self.attitude().map(Quaternion::to_matrix),
        }
    }

    /// The unit quaternion, or what was found instead of what.
    pub fn attitude(&self) -> Result<Quaternion<f64>, (String, &'static str)> {
        let Self::Quaternion([scalar, x, y, z]) = *self else {
            return self.matrix().map(|rotation| Quaternion::from_matrix(&rotation));
        };
        let given = Quaternion { scalar, vector: [x, y, z].into() };
        let squared = given.norm_squared();
        if (squared - 1.0).abs() <= ROUNDING {
            Ok(given)
        } else if (squared.sqrt() - 1.0).abs() <= ROTATION_TOLERANCE {
            Ok(given.normalized())
        } else {
            Err((format!("a quaternion of norm {}", shown(squared.sqrt())), "norm 1"))
        }
    }
}

/// The unit vector along an axis of this name, `x` or `-x`, letter case ignored.
pub(crate) fn axis_named(text: &str) -> Option<Vec3<f64>> {
    let (sign, name) = text.strip_prefix('-').map_or((1.0, text), |name| (-1.0, name));
    let axis = ["x", "y", "z"].iter().position(|axis| axis.eq_ignore_ascii_case(name))?;
    Some(Vec3::from([0, 1, 2].map(|i| if i == axis { sign } else { 0.0 })))
}

/// The vector with length 1; one that has this length but for rounding is left alone.
pub(crate) fn unit_vector(vector: Vec3<f64>) -> Option<Vec3<f64>> {
    let largest = vector.to_array().into_iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    if largest == 0.0 {
        return None;
    }
    if (vector.norm_squared() - 1.0).abs() <= ROUNDING {
        return Some(vector);
    }
    let scaled = vector.map(|c| c / largest);
    let length = scaled.norm();
    Some(scaled.map(|c| c / length))
}
