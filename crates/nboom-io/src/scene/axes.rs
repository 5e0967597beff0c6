//! Rotations in words.

use nboom_scalar::{Mat3, Quaternion};

use super::fields::{Fields, Reader};
use crate::angles;

/// Deviation from a rotation, or from length 1, that counts as rounding in the scene.
const ROTATION_TOLERANCE: f64 = 1e-6;

/// Deviation of a squared length from 1 that rounding explains.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Reader<'_, '_> {
    /// The rotation that a table of axes describes.
    pub fn rotation(&mut self, axes: &Fields<'_>) -> Option<Mat3<f64>> {
        if axes.has("euler_xyx") {
            let ([psi, theta, phi], degrees) = self.angles_as_given(axes, "euler_xyx")?;
            return Some(if degrees {
                angles::rotation_from_degrees(psi, theta, phi)
            } else {
                Mat3::from_euler_121(psi, theta, phi)
            });
        }
        if axes.has("turn") {
            let turn = self.table(axes, "turn")?;
            let (about, by) = (self.direction(&turn, "about"), self.angle_as_given(&turn, "by"));
            let ((by, degrees), about) = (by?, about?);
            let sines = if degrees { angles::sin_cos(by) } else { by.sin_cos() };
            return Some(angles::rotation_about(about, sines));
        }
        if axes.has("columns") {
            return self.columns(axes);
        }
        self.quaternion(axes).map(Quaternion::to_matrix)
    }

    /// The attitude that a table of axes describes.
    pub fn attitude(&mut self, axes: &Fields<'_>) -> Option<Quaternion<f64>> {
        if axes.has("quaternion") {
            return self.quaternion(axes);
        }
        self.rotation(axes).map(|rotation| Quaternion::from_matrix(&rotation))
    }

    fn columns(&mut self, axes: &Fields<'_>) -> Option<Mat3<f64>> {
        let rows = self.rows::<3>(axes, "columns");
        let &[x, y, z] = &rows[..] else {
            let found = format!("{} of three numbers", rows.len());
            self.error(&axes.place("columns"), "columns", &found, "three lists of three numbers");
            return None;
        };
        let rotation = Mat3::from_columns(x.into(), y.into(), z.into());
        let defect = rotation.rotation_defect();
        if defect <= ROTATION_TOLERANCE {
            return Some(rotation);
        }
        let found = format!("axes that depart from a rotation by {}", crate::deck::shown(defect));
        let expected = "three right-handed orthogonal unit vectors";
        self.error(&axes.place("columns"), "columns", &found, expected);
        None
    }

    fn quaternion(&mut self, axes: &Fields<'_>) -> Option<Quaternion<f64>> {
        let [scalar, x, y, z] = self.numbers(axes, "quaternion")?;
        let given = Quaternion { scalar, vector: [x, y, z].into() };
        let squared = given.norm_squared();
        if (squared - 1.0).abs() <= ROUNDING {
            return Some(given);
        }
        if (squared.sqrt() - 1.0).abs() <= ROTATION_TOLERANCE {
            return Some(given.normalized());
        }
        let found = format!("a quaternion of norm {}", crate::deck::shown(squared.sqrt()));
        self.error(&axes.place("quaternion"), "quaternion", &found, "norm 1");
        None
    }
}
