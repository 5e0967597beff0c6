use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use crate::{Mat3, Number, Real};

/// A vector of three components; which axes they refer to is said where it is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<R> {
    /// First component.
    pub x: R,
    /// Second component.
    pub y: R,
    /// Third component.
    pub z: R,
}

impl<R> Vec3<R> {
    /// The vector (x, y, z).
    #[inline(always)]
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// The vector of what `f` makes of each component.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> Vec3<S> {
        Vec3 { x: f(self.x), y: f(self.y), z: f(self.z) }
    }
}

impl<R: Real> Vec3<R> {
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::new(R::zero(), R::zero(), R::zero())
    }

    /// The unit vector along the first axis.
    #[inline(always)]
    pub fn unit_x() -> Self {
        Self::new(R::one(), R::zero(), R::zero())
    }

    /// The unit vector along the second axis.
    #[inline(always)]
    pub fn unit_y() -> Self {
        Self::new(R::zero(), R::one(), R::zero())
    }

    /// The unit vector along the third axis.
    #[inline(always)]
    pub fn unit_z() -> Self {
        Self::new(R::zero(), R::zero(), R::one())
    }

    /// Makes every component a scalar of this kind.
    #[inline(always)]
    pub fn constant(v: Vec3<f64>) -> Self {
        v.map(R::constant)
    }

    /// Inner product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Cross product, `self` first.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Square of the length.
    #[inline(always)]
    pub fn norm_squared(self) -> R {
        self.dot(self)
    }

    /// Length.
    #[inline(always)]
    pub fn norm(self) -> R {
        self.norm_squared().sqrt()
    }

    /// The dyad `self otherᵀ`.
    #[inline(always)]
    pub fn outer(self, other: Self) -> Mat3<R> {
        Mat3::from_rows(other * self.x, other * self.y, other * self.z)
    }

    /// The components in order.
    #[inline(always)]
    pub fn to_array(self) -> [R; 3] {
        [self.x, self.y, self.z]
    }
}

impl<R> From<[R; 3]> for Vec3<R> {
    #[inline(always)]
    fn from([x, y, z]: [R; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl<R: Number> Vec3<R> {
    /// The nearest `f64` of each component.
    pub fn to_f64(self) -> Vec3<f64> {
        Vec3::new(self.x.to_f64(), self.y.to_f64(), self.z.to_f64())
    }
}

impl Vec3<f64> {
    /// Whether all components are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<R: Real> AddAssign for Vec3<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Real> SubAssign for Vec3<R> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
