use nboom_scalar::{Mat3, Quaternion};

/// Euler angles ψ, θ, φ \[rad\] of the main body: its attitude is R_x(ψ) R_y(θ) R_x(φ),
/// eq. (9.7), solved for the angles.
///
/// θ lies in \[0, π\], the others in (−π, π]. Where θ is 0 or π only a combination of ψ and φ
/// is determined; there ψ is zero.
pub fn euler_angles(attitude: Quaternion<f64>) -> [f64; 3] {
    let Mat3 { rows: [first, second, third] } = attitude.to_matrix();
    // θ = acos M11, written so that small angles keep their digits.
    let theta = first.y.hypot(first.z).atan2(first.x);
    if first.y == 0.0 && first.z == 0.0 {
        // A difference, because a negated zero would turn into an angle of minus zero.
        return [0.0, theta, (0.0 - second.z).atan2(second.y)];
    }
    [second.x.atan2(-third.x), theta, first.y.atan2(first.z)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: [f64; 3], expected: [f64; 3]) {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-12, "{found:?} {expected:?}");
        }
    }

    #[test]
    fn angles_of_a_rotation_come_back() {
        for angles in [[0.3, 1.2, -2.0], [-2.5, 1e-6, 2.4], [3.0, 3.1, 0.1]] {
            let rot = Mat3::from_euler_121(angles[0], angles[1], angles[2]);
            let found = euler_angles(Quaternion::from_matrix(&rot));
            // At θ of a millionth, rounding of the matrix moves ψ and φ by ten digits less.
            for (a, b) in found.iter().zip(angles) {
                assert!((a - b).abs() < 1e-9, "{found:?} {angles:?}");
            }
        }
    }

    #[test]
    fn degenerate_attitudes_put_everything_into_phi() {
        close(euler_angles(Quaternion::identity()), [0.0; 3]);
        let about_x = Quaternion::from_matrix(&Mat3::about_x(0.7));
        close(euler_angles(about_x), [0.0, 0.0, 0.7]);
    }
}
