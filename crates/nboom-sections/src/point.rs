use std::ops::{Add, Mul, Sub};

/// A point in the plane of a section, or the vector from one to another, along ξ and ζ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Along ξ.
    pub xi: f64,
    /// Along ζ.
    pub zeta: f64,
}

impl Point {
    /// The point on the η axis.
    pub const ORIGIN: Self = Self { xi: 0.0, zeta: 0.0 };

    /// ξ₁ζ₂ − ζ₁ξ₂, positive for a turn from ξ towards ζ; minus the η component of the cross
    /// product, since ξ, η, ζ are right-handed.
    pub(crate) fn cross(self, other: Self) -> f64 {
        self.xi * other.zeta - self.zeta * other.xi
    }

    pub(crate) fn dot(self, other: Self) -> f64 {
        self.xi * other.xi + self.zeta * other.zeta
    }

    pub(crate) fn norm(self) -> f64 {
        self.xi.hypot(self.zeta)
    }

    pub(crate) fn is_finite(self) -> bool {
        self.xi.is_finite() && self.zeta.is_finite()
    }
}

impl Add for Point {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { xi: self.xi + other.xi, zeta: self.zeta + other.zeta }
    }
}

impl Sub for Point {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { xi: self.xi - other.xi, zeta: self.zeta - other.zeta }
    }
}

impl Mul<f64> for Point {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { xi: self.xi * factor, zeta: self.zeta * factor }
    }
}
