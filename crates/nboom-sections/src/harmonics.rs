//! Trigonometric polynomials of degree two on the circle, and where they are largest.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_8};
use std::ops::{Add, Mul};

use crate::polynomial::{Polynomial, SignChanges};

/// Coefficients of 1, cos θ, sin θ, cos 2θ and sin 2θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Harmonics(pub(crate) [f64; 5]);

impl Harmonics {
    /// (a + b cos θ + c sin θ)².
    pub(crate) fn of_square([a, b, c]: [f64; 3]) -> Self {
        let (mean, half) = (a * a + 0.5 * (b * b + c * c), 0.5 * (b * b - c * c));
        Self([mean, 2.0 * a * b, 2.0 * a * c, half, b * c])
    }

    /// Where the derivative changes sign within a quadrant.
    ///
    /// With φ from the middle of the quadrant and u = tan φ/2, (1 + u²)² times the derivative is a
    /// polynomial of degree four in u, and |u| ≤ tan π/8.
    fn stationary(self, quadrant: usize) -> impl Iterator<Item = f64> {
        let middle = (quadrant as f64 + 0.5) * FRAC_PI_2;
        let Self([_, c1, s1, c2, s2]) = self;
        let turned = |c: f64, s: f64, angle: f64| {
            let (sin, cos) = angle.sin_cos();
            (c * cos + s * sin, s * cos - c * sin)
        };
        let ((c1, s1), (c2, s2)) = (turned(c1, s1, middle), turned(c2, s2, 2.0 * middle));
        let derivative: Polynomial =
            [s1 + 2.0 * s2, -2.0 * c1 - 8.0 * c2, -12.0 * s2, 8.0 * c2 - 2.0 * c1, 2.0 * s2 - s1];
        let end = FRAC_PI_8.tan();
        let changes = SignChanges::of(&derivative, -end, end);
        changes.into_points().map(move |u| middle + 2.0 * u.atan())
    }
}

impl Add for Harmonics {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl Mul<f64> for Harmonics {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|c| c * factor))
    }
}

/// The angle from 0 to 2π at which `value` is largest, a function whose stationary points within
/// each quadrant, counted from 0, are those of `harmonics`.
pub(crate) fn largest(value: impl Fn(f64) -> f64, harmonics: impl Fn(usize) -> Harmonics) -> f64 {
    let candidates = (0..4).flat_map(|quadrant| {
        let start = quadrant as f64 * FRAC_PI_2;
        std::iter::once(start).chain(harmonics(quadrant).stationary(quadrant))
    });
    let (angle, _) = candidates.fold((0.0, value(0.0)), |best, angle| {
        let found = value(angle);
        if found > best.1 { (angle, found) } else { best }
    });
    angle
}
