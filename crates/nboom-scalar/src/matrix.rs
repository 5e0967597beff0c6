use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use crate::{Real, Vec3};

/// A general 3×3 matrix, stored by rows.
///
/// A rotation named `rot_a_from_b` turns components along the axes of `b` into components
/// along the axes of `a`; its columns are the axes of `b` seen from `a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mat3<R> {
    /// The three rows.
    pub rows: [Vec3<R>; 3],
}

impl<R> Mat3<R> {
    /// The matrix of what `f` makes of each entry, row by row.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> Mat3<S> {
        Mat3 { rows: self.rows.map(|row| row.map(&mut f)) }
    }
}

impl<R: Real> Mat3<R> {
    /// The matrix with these rows.
    #[inline(always)]
    pub fn from_rows(first: Vec3<R>, second: Vec3<R>, third: Vec3<R>) -> Self {
        Self { rows: [first, second, third] }
    }

    /// The matrix with these columns.
    #[inline(always)]
    pub fn from_columns(a: Vec3<R>, b: Vec3<R>, c: Vec3<R>) -> Self {
        Self::from_rows(
            Vec3::new(a.x, b.x, c.x),
            Vec3::new(a.y, b.y, c.y),
            Vec3::new(a.z, b.z, c.z),
        )
    }

    /// The zero matrix.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { rows: [Vec3::zero(); 3] }
    }

    /// The unit matrix.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::from_rows(Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z())
    }

    /// Makes every entry a scalar of this kind.
    #[inline(always)]
    pub fn constant(m: Mat3<f64>) -> Self {
        m.map(R::constant)
    }

    /// J(a), the matrix for which `skew(a) * b` is `a × b` (nomenclature of the report).
    #[inline(always)]
    pub fn skew(a: Vec3<R>) -> Self {
        Self::from_rows(
            Vec3::new(R::zero(), -a.z, a.y),
            Vec3::new(a.z, R::zero(), -a.x),
            Vec3::new(-a.y, a.x, R::zero()),
        )
    }

    /// Positive rotation by `angle` \[rad\] about the first axis.
    pub fn about_x(angle: R) -> Self {
        let (s, c) = angle.sin_cos();
        let (o, i) = (R::zero(), R::one());
        Self::from_rows(Vec3::new(i, o, o), Vec3::new(o, c, -s), Vec3::new(o, s, c))
    }

    /// Positive rotation by `angle` \[rad\] about the second axis.
    pub fn about_y(angle: R) -> Self {
        let (s, c) = angle.sin_cos();
        let (o, i) = (R::zero(), R::one());
        Self::from_rows(Vec3::new(c, o, s), Vec3::new(o, i, o), Vec3::new(-s, o, c))
    }

    /// Positive rotation by `angle` \[rad\] about the unit vector `axis`.
    pub fn about_axis(axis: Vec3<R>, angle: R) -> Self {
        let (s, c) = angle.sin_cos();
        let along = axis.outer(axis);
        along + (Self::identity() - along) * c + Self::skew(axis) * s
    }

    /// The rotation R_x(ψ) R_y(θ) R_x(φ) of eqs. (9.6) and (9.7); angles \[rad\].
    pub fn from_euler_121(psi: R, theta: R, phi: R) -> Self {
        Self::about_x(psi) * Self::about_y(theta) * Self::about_x(phi)
    }

    /// Column `j`, from 0.
    #[inline(always)]
    pub fn column(&self, j: usize) -> Vec3<R> {
        let [a, b, c] = self.rows;
        let [a, b, c] = [a.to_array()[j], b.to_array()[j], c.to_array()[j]];
        Vec3::new(a, b, c)
    }

    /// The transpose.
    #[inline(always)]
    pub fn transpose(&self) -> Self {
        Self::from_columns(self.rows[0], self.rows[1], self.rows[2])
    }

    /// `self` transposed, times `v`.
    #[inline(always)]
    pub fn transpose_mul(&self, v: Vec3<R>) -> Vec3<R> {
        self.rows[0] * v.x + self.rows[1] * v.y + self.rows[2] * v.z
    }
}

impl Mat3<f64> {
    /// Whether all entries are finite.
    pub fn is_finite(&self) -> bool {
        self.rows.iter().all(|row| row.is_finite())
    }

    /// Largest departure of `selfᵀ self` from the unit matrix and of the determinant from 1.
    pub fn rotation_defect(&self) -> f64 {
        let gram = self.transpose() * *self - Self::identity();
        let [a, b, c] = self.rows;
        let entries = gram.rows.into_iter().flat_map(Vec3::to_array);
        entries.map(f64::abs).fold((a.dot(b.cross(c)) - 1.0).abs(), f64::max)
    }
}

impl<R: Real> Mul<Vec3<R>> for Mat3<R> {
    type Output = Vec3<R>;
    #[inline(always)]
    fn mul(self, v: Vec3<R>) -> Vec3<R> {
        Vec3::new(self.rows[0].dot(v), self.rows[1].dot(v), self.rows[2].dot(v))
    }
}

impl<R: Real> Mul for Mat3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let [a, b, c] = self.rows;
        Self { rows: [other.transpose_mul(a), other.transpose_mul(b), other.transpose_mul(c)] }
    }
}

impl<R: Real> Mul<R> for Mat3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        let [a, b, c] = self.rows;
        Self { rows: [a * factor, b * factor, c * factor] }
    }
}

impl<R: Real> Add for Mat3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let [a, b, c] = self.rows;
        Self::from_rows(a + other.rows[0], b + other.rows[1], c + other.rows[2])
    }
}

impl<R: Real> Sub for Mat3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let [a, b, c] = self.rows;
        Self::from_rows(a - other.rows[0], b - other.rows[1], c - other.rows[2])
    }
}

impl<R: Real> Neg for Mat3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let [a, b, c] = self.rows;
        Self { rows: [-a, -b, -c] }
    }
}

impl<R: Real> AddAssign for Mat3<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
