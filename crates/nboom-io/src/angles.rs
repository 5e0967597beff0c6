use nboom_scalar::{Mat3, Vec3};

/// The rotation R_x(ψ) R_y(θ) R_x(φ) of eqs. (9.6) and (9.7), angles in degrees.
///
/// Quarter turns, most common in decks, give exact zeros and ones.
pub(crate) fn rotation_from_degrees(psi: f64, theta: f64, phi: f64) -> Mat3<f64> {
    about_x(psi) * about_y(theta) * about_x(phi)
}

pub(crate) fn vector_to_radians(degrees: Vec3<f64>) -> Vec3<f64> {
    Vec3::from(degrees.to_array().map(f64::to_radians))
}

fn about_x(degrees: f64) -> Mat3<f64> {
    let (s, c) = sin_cos(degrees);
    Mat3::from_rows(Vec3::unit_x(), Vec3::new(0.0, c, -s), Vec3::new(0.0, s, c))
}

fn about_y(degrees: f64) -> Mat3<f64> {
    let (s, c) = sin_cos(degrees);
    Mat3::from_rows(Vec3::new(c, 0.0, s), Vec3::unit_y(), Vec3::new(-s, 0.0, c))
}

/// The rotation about a unit vector by an angle with this sine and cosine, Rodrigues' formula.
pub(crate) fn rotation_about(axis: Vec3<f64>, (s, c): (f64, f64)) -> Mat3<f64> {
    let along = axis.outer(axis);
    along + (Mat3::identity() + along * -1.0) * c + Mat3::skew(axis) * s
}

/// The degrees that are read as these radians, if there are any; those with few digits come first.
pub(crate) fn in_degrees(radians: f64) -> Option<f64> {
    let degrees = radians.to_degrees();
    let few = (degrees * 1e9).round() / 1e9;
    [few, degrees].into_iter().find(|degrees| degrees.to_radians() == radians)
}

/// Sine and cosine of an angle in degrees; exact for quarter turns.
pub(crate) fn sin_cos(degrees: f64) -> (f64, f64) {
    let quarters = degrees.rem_euclid(360.0) / 90.0;
    if quarters == 0.0 {
        (0.0, 1.0)
    } else if quarters == 1.0 {
        (1.0, 0.0)
    } else if quarters == 2.0 {
        (0.0, -1.0)
    } else if quarters == 3.0 {
        (-1.0, 0.0)
    } else {
        degrees.to_radians().sin_cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        for k in -9..9 {
            let (s, c) = sin_cos(f64::from(k) * 90.0);
            assert_eq!(s.abs() + c.abs(), 1.0, "{k}");
        }
        let rot = rotation_from_degrees(90.0, 90.0, 0.0);
        assert_eq!(rot.column(0), Vec3::new(0.0, 1.0, 0.0));
        assert_eq!(rot.column(1), Vec3::new(0.0, 0.0, 1.0));
        assert_eq!(rot.column(2), Vec3::new(1.0, 0.0, 0.0));
    }

    /// These rotations from radians; angles of up to two and a half turns are rounded by up to
    /// 2e-15.
    fn agree_with_radians(psi: f64, theta: f64, phi: f64) {
        let found = rotation_from_degrees(psi, theta, phi);
        let expected = Mat3::from_euler_121(psi.to_radians(), theta.to_radians(), phi.to_radians());
        let close = (found - expected).rows.iter().all(|row| row.norm() < 1e-14);
        assert!(close, "{psi}, {theta}, {phi}: {found:?}, {expected:?}");
    }

    #[test]
    fn any_angles_agree_with_radians() {
        agree_with_radians(10.0, -20.0, 450.5);
    }

    #[test]
    fn quarter_turns_agree_with_radians() {
        for quarters in -9..=9 {
            let degrees = 90.0 * f64::from(quarters);
            agree_with_radians(degrees, 0.0, 0.0);
            agree_with_radians(0.0, degrees, 0.0);
            agree_with_radians(30.0, degrees, -degrees);
        }
    }
}
