use crate::{Mat3, Real, Vec3};

/// Euler parameters: `scalar` is χ, `vector` is K̄; a rotation when the norm is 1.
///
/// As an attitude it turns main-body components into inertial ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion<R> {
    /// χ, the cosine of half the angle.
    pub scalar: R,
    /// K̄, the axis times the sine of half the angle.
    pub vector: Vec3<R>,
}

impl<R: Real> Quaternion<R> {
    /// The rotation by nothing.
    #[inline(always)]
    pub fn identity() -> Self {
        Self { scalar: R::one(), vector: Vec3::zero() }
    }

    /// Square of the norm χ² + K̄·K̄.
    #[inline(always)]
    pub fn norm_squared(self) -> R {
        self.scalar * self.scalar + self.vector.norm_squared()
    }

    /// The quaternion of the same direction with norm 1.
    #[inline(always)]
    pub fn normalized(self) -> Self {
        let inverse = R::one() / self.norm_squared().sqrt();
        Self { scalar: self.scalar * inverse, vector: self.vector * inverse }
    }

    /// The rotation that applies `other` first and `self` after it.
    pub fn compose(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            scalar: a.scalar * b.scalar - a.vector.dot(b.vector),
            vector: b.vector * a.scalar + a.vector * b.scalar + a.vector.cross(b.vector),
        }
    }

    /// The rotation matrix U + 2χ J(K̄) + 2 J(K̄)² of a unit quaternion, eq. (9.13).
    #[inline(always)]
    pub fn to_matrix(self) -> Mat3<R> {
        let two = R::constant(2.0);
        let (x, k) = (self.scalar, self.vector);
        let (kx, ky, kz) = (k * (two * k.x), k * (two * k.y), k * (two * k.z));
        let w = k * (two * x);
        let one = R::one();
        Mat3::from_rows(
            Vec3::new(one - ky.y - kz.z, kx.y - w.z, kx.z + w.y),
            Vec3::new(kx.y + w.z, one - kx.x - kz.z, ky.z - w.x),
            Vec3::new(kx.z - w.y, ky.z + w.x, one - kx.x - ky.y),
        )
    }

    /// Rate of change under the body rate `omega_body` \[rad/T\], eq. (9.15), corrected: note 9.
    #[inline(always)]
    pub fn rate(self, omega_body: Vec3<R>) -> Self {
        let half = R::constant(0.5);
        Self {
            scalar: -(omega_body.dot(self.vector) * half),
            vector: (omega_body * self.scalar - omega_body.cross(self.vector)) * half,
        }
    }
}

impl Quaternion<f64> {
    /// The unit quaternion of a rotation matrix, with χ ≥ 0 (Shepperd's choice of the largest
    /// component keeps it accurate at every angle).
    pub fn from_matrix(rot: &Mat3<f64>) -> Self {
        let [r0, r1, r2] = rot.rows;
        let trace = r0.x + r1.y + r2.z;
        let squares = [
            1.0 + trace,
            1.0 + 2.0 * r0.x - trace,
            1.0 + 2.0 * r1.y - trace,
            1.0 + 2.0 * r2.z - trace,
        ];
        let largest = (0..4).max_by(|&a, &b| squares[a].total_cmp(&squares[b])).unwrap_or(0);
        let (w, x, y, z) = match largest {
            0 => (squares[0], r2.y - r1.z, r0.z - r2.x, r1.x - r0.y),
            1 => (r2.y - r1.z, squares[1], r0.y + r1.x, r0.z + r2.x),
            2 => (r0.z - r2.x, r0.y + r1.x, squares[2], r1.z + r2.y),
            _ => (r1.x - r0.y, r0.z + r2.x, r1.z + r2.y, squares[3]),
        };
        let sign = if w < 0.0 { -1.0 } else { 1.0 };
        Self { scalar: sign * w, vector: Vec3::new(x, y, z) * sign }.normalized()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrix_and_back_at_every_octant() {
        for i in 0..200 {
            let t = f64::from(i);
            let rot = Mat3::from_euler_121(0.7 * t, 1.3 * t + 0.1, 2.9 * t);
            let back = Quaternion::from_matrix(&rot).to_matrix();
            let defect = (back - rot).rows.map(|r| r.norm());
            assert!(defect.iter().all(|d| *d < 1e-14), "{i}: {defect:?}");
        }
    }

    #[test]
    fn rate_is_the_derivative_of_turning_about_a_fixed_axis() {
        let omega = Vec3::new(0.3, -0.5, 0.8);
        let at = |t: f64| {
            let axis = omega * (1.0 / omega.norm());
            let (s, c) = (0.5 * omega.norm() * t).sin_cos();
            Quaternion { scalar: c, vector: axis * s }
        };
        let h = 1e-5;
        let (a, b, rate) = (at(1.0 - h), at(1.0 + h), at(1.0).rate(omega));
        assert!(((b.scalar - a.scalar) / (2.0 * h) - rate.scalar).abs() < 1e-10);
        assert!(((b.vector - a.vector) * (0.5 / h) - rate.vector).norm() < 1e-10);
    }

    #[test]
    fn composition_is_the_matrix_product() {
        let a = Mat3::from_euler_121(0.4, 1.1, -0.3);
        let b = Mat3::from_euler_121(-1.2, 0.6, 2.0);
        let product = Quaternion::from_matrix(&a).compose(Quaternion::from_matrix(&b)).to_matrix();
        assert!((product - a * b).rows.iter().all(|r| r.norm() < 1e-15));
    }
}
