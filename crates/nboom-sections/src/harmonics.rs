//! Trigonometric polynomials of degree two on the circle, and where they are largest.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_8, TAU};
use std::ops::{Add, Mul};

use crate::polynomial::{Polynomial, SignChanges};

/// More steps than Newton's method needs from a start of the right size, about six.
const MOST_STEPS: usize = 100;

/// Coefficients of 1, cos θ, sin θ, cos 2θ and sin 2θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Harmonics(pub(crate) [f64; 5]);

impl Harmonics {
    /// (a + b cos θ + c sin θ)².
    pub(crate) fn of_square([a, b, c]: [f64; 3]) -> Self {
        let (mean, half) = (a * a + 0.5 * (b * b + c * c), 0.5 * (b * b - c * c));
        Self([mean, 2.0 * a * b, 2.0 * a * c, half, b * c])
    }

    /// The angle from 0 to 2π at which it is largest; the first one where there are two.
    ///
    /// With φ from the axis of the second harmonic and (x, y) = (cos φ, sin φ) it is
    /// d x² + 2 (g x + h y) plus a constant, d ≥ 0: a quadratic form on the unit circle. Its
    /// maximum is where μ x = g and (μ + d) y = h with μ ≥ 0 (Moré and Sorensen, Computing a trust
    /// region step, 1983), and no other stationary point has such a μ.
    pub(crate) fn largest(self) -> f64 {
        let Self([_, c1, s1, c2, s2]) = self;
        let axis = 0.5 * s2.atan2(c2);
        let (sin, cos) = axis.sin_cos();
        let (g, h) = (0.5 * (c1 * cos + s1 * sin), 0.5 * (s1 * cos - c1 * sin));
        let d = 2.0 * c2.hypot(s2);
        let angle = |x: f64, y: f64| (axis + y.atan2(x)).rem_euclid(TAU);
        let mu = multiplier(d, g, h);
        if mu > 0.0 {
            return angle(g / mu, h / (mu + d));
        }
        let y = if d > 0.0 { h / d } else { 0.0 };
        let x = (1.0 - y * y).sqrt();
        angle(x, y).min(angle(-x, y))
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

/// The μ ≥ 0 with (g/μ)² + (h/(μ + d))² = 1, or zero where none is as large.
///
/// At the first guess both terms are at most 1 and one of them is 1, so it is no larger than the
/// solution. The reciprocal of the sum's root is concave in μ, so Newton's method on it stays
/// below.
fn multiplier(d: f64, g: f64, h: f64) -> f64 {
    let mut mu = g.abs().max(h.abs() - d);
    for _ in 0..MOST_STEPS {
        let (x, y) = (g / mu, h / (mu + d));
        let square = x * x + y * y;
        let slope = x * x / mu + y * y / (mu + d);
        let next = mu + (square.sqrt() - 1.0) * square / slope;
        let is_closer = next > mu;
        if !is_closer {
            break;
        }
        mu = next;
    }
    mu
}

/// The angle from 0 to 2π at which `value` is largest, a function whose stationary points within
/// each quadrant, counted from 0, are those of `harmonics`.
pub(crate) fn largest_by_quadrant(
    value: impl Fn(f64) -> f64,
    harmonics: impl Fn(usize) -> Harmonics,
) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn value(Harmonics([c0, c1, s1, c2, s2]): Harmonics, angle: f64) -> f64 {
        let ((sin, cos), (sin2, cos2)) = (angle.sin_cos(), (2.0 * angle).sin_cos());
        c0 + c1 * cos + s1 * sin + c2 * cos2 + s2 * sin2
    }

    /// Coefficients of any size, also far apart and zero.
    fn coefficient() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), -1.0..1.0, (-20..0).prop_map(|power| 10.0_f64.powi(power))]
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

        /// Two searches that have nothing in common.
        #[test]
        fn the_largest_of_all_is_the_largest_of_the_quadrants(
            coefficients in prop::array::uniform5(coefficient())
        ) {
            let harmonics = Harmonics(coefficients);
            let angle = harmonics.largest();
            prop_assert!((0.0..=TAU).contains(&angle), "{angle}");
            let by_quadrant = largest_by_quadrant(|angle| value(harmonics, angle), |_| harmonics);
            let (found, right) = (value(harmonics, angle), value(harmonics, by_quadrant));
            let size = coefficients.iter().fold(0.0, |sum, c| sum + c.abs());
            // A few roundings of each term.
            prop_assert!((found - right).abs() <= 1e-15 * size, "{found} and {right}");
        }
    }

    #[test]
    fn of_two_largest_the_first_is_told() {
        let second_harmonic = Harmonics([0.0, 0.0, 0.0, 0.5, 0.5]).largest();
        // Rounding of an angle.
        assert!((second_harmonic - FRAC_PI_8).abs() < 1e-15);
        // Beside the axis of the second harmonic: 2 cos²φ + 2 h sin φ is largest at sin φ = h/2.
        let between = Harmonics([0.0, 0.0, 1.0, 1.0, 0.0]).largest();
        assert!((between - 0.25_f64.asin()).abs() < 1e-15);
        assert_eq!(Harmonics([1.0, 0.0, 0.0, 0.0, 0.0]).largest(), 0.0);
    }
}
