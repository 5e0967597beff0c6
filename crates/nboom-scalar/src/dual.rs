use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::Real;

/// A number together with its derivative with respect to one variable (forward mode).
///
/// Values go through exactly the operations that they would go through alone, so that they
/// have the same roundings; derivatives follow by the rules of differentiation. The square
/// root has no derivative at zero.
///
/// ```
/// use nboom_scalar::{Dual, Real};
/// /// Height of a pendulum of length ℓ at an angle.
/// fn height<R: Real>(length: R, angle: R) -> R {
///     length * (R::one() - angle.sin_cos().1)
/// }
/// let found = height(Dual::constant(2.0), Dual::variable(0.5));
/// assert_eq!(found.value, height(2.0, 0.5));
/// assert!((found.derivative - 2.0 * 0.5_f64.sin()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<R> {
    /// The number.
    pub value: R,
    /// Its derivative.
    pub derivative: R,
}

impl<R: Real> Dual<R> {
    /// The variable at this value: derivative one.
    pub fn variable(value: R) -> Self {
        Self { value, derivative: R::one() }
    }

    /// A number that does not depend on the variable: derivative zero.
    ///
    /// It takes the scalar itself, where [`Real::constant`] takes an `f64`.
    pub fn constant(value: R) -> Self {
        Self { value, derivative: R::zero() }
    }

    /// Sine and cosine from those of the value.
    #[inline(always)]
    fn turned(self, (sine, cosine): (R, R)) -> (Self, Self) {
        let rate = self.derivative;
        (
            Self { value: sine, derivative: cosine * rate },
            Self { value: cosine, derivative: -(sine * rate) },
        )
    }
}

impl<R: Real> Real for Dual<R> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self { value: R::constant(value), derivative: R::zero() }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self { value: root, derivative: self.derivative / (root + root) }
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.turned(self.value.sin_cos())
    }

    #[inline(always)]
    fn remark(words: impl FnOnce() -> String) {
        R::remark(words);
    }

    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let pairs = R::sin_cos_all(angles.map(|angle| angle.value));
        std::array::from_fn(|i| angles[i].turned(pairs[i]))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        let inner = self.derivative.mul_add(factor.value, term.derivative);
        Self {
            value: self.value.mul_add(factor.value, term.value),
            derivative: self.value.mul_add(factor.derivative, inner),
        }
    }
}

impl<R: Real> Add for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, derivative: self.derivative + other.derivative }
    }
}

impl<R: Real> Sub for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, derivative: self.derivative - other.derivative }
    }
}

impl<R: Real> Mul for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            derivative: self.value * other.derivative + self.derivative * other.value,
        }
    }
}

impl<R: Real> Div for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, derivative: (self.derivative - value * other.derivative) / other.value }
    }
}

impl<R: Real> Neg for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, derivative: -self.derivative }
    }
}

impl<R: Real> AddAssign for Dual<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Real> SubAssign for Dual<R> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DoubleDouble, Quaternion, Several, Vec3};

    const AT: [f64; 5] = [0.3, 0.9, 1.7, 2.6, 40.0];

    fn close(found: f64, expected: f64) {
        // Few roundings lie between the two.
        assert!((found - expected).abs() < 1e-14 * expected.abs().max(1.0), "{found} {expected}");
    }

    #[test]
    fn each_operation_has_its_derivative() {
        for at in AT {
            let (x, a) = (Dual::variable(at), Dual::constant(0.7));
            let (s, c) = f64::sin_cos(at);
            close((x + a).derivative, 1.0);
            close((x - a).derivative, 1.0);
            close((a - x).derivative, -1.0);
            close((-x).derivative, -1.0);
            close((x * a).derivative, 0.7);
            close((x * x * x).derivative, 3.0 * at * at);
            close((x / a).derivative, 1.0 / 0.7);
            close((a / x).derivative, -0.7 / (at * at));
            close(x.sqrt().derivative, 0.5 / at.sqrt());
            close(x.sin_cos().0.derivative, c);
            close(x.sin_cos().1.derivative, -s);
            close(x.mul_add(x, x).derivative, 2.0 * at + 1.0);
            let (mut sum, mut difference) = (a, a);
            sum += x;
            difference -= x;
            assert_eq!((sum, difference), (a + x, a - x));
        }
    }

    #[test]
    fn chain_rule() {
        for at in AT {
            let x = Dual::variable(at);
            // d/dx √(2 + sin x²) = x cos x² / √(2 + sin x²)
            let found = (Dual::constant(2.0) + (x * x).sin_cos().0).sqrt();
            let (s, c) = f64::sin_cos(at * at);
            assert_eq!(found.value, (2.0 + s).sqrt());
            close(found.derivative, at * c / (2.0 + s).sqrt());
        }
    }

    #[test]
    fn sines_of_several_angles_are_those_of_each() {
        let angles = AT.map(Dual::variable);
        assert_eq!(Real::sin_cos_all(angles), angles.map(Real::sin_cos));
    }

    #[test]
    fn products_and_sums_round_as_the_scalar_rounds_them() {
        let fused = |x: f64| Dual::variable(Several([x]));
        let (x, y, z) = (fused(1.1), fused(2.3), fused(-2.53));
        assert_eq!(x.mul_add(y, z).value.0[0], f64::mul_add(1.1, 2.3, -2.53));
        assert_ne!(x.mul_add(y, z).value, (x * y + z).value);
        let (x, y, z) = (Dual::variable(1.1), Dual::variable(2.3), Dual::constant(-2.53));
        assert_eq!(x.mul_add(y, z), x * y + z);
    }

    /// A component of a vector turned by a quaternion that is not of norm 1.
    fn turned<R: Real>(x: R) -> R {
        let vector = Vec3::new(x, x.sin_cos().0, R::one() / x);
        let turn = Quaternion { scalar: x.sqrt(), vector }.normalized().to_matrix();
        (turn * Vec3::new(R::one(), x, x * x)).y
    }

    #[test]
    fn central_differences_of_vector_algebra() {
        for at in AT {
            let h = 1e-5;
            let difference = (turned(at + h) - turned(at - h)) / (2.0 * h);
            let found = turned(Dual::variable(at));
            assert_eq!(found.value, turned(at));
            // h² times a third derivative, and rounding of 1e-16 x² in values over h.
            let allowed = 1e-9 * (1.0 + at * at);
            assert!((found.derivative - difference).abs() < allowed, "at {at}");
        }
    }

    #[test]
    fn central_differences_in_double_double() {
        for at in AT {
            let at = DoubleDouble::from(at);
            let h = DoubleDouble::from(1e-9);
            let difference = (turned(at + h) - turned(at - h)) / (h + h);
            let found = turned(Dual::variable(at)).derivative;
            // h² times a third derivative, and rounding of 1e-32 x² in values over h.
            let allowed = 1e-15 * (1.0 + at.to_f64() * at.to_f64());
            assert!((found - difference).abs().to_f64() < allowed, "at {at:?}");
        }
    }

    #[test]
    fn duals_of_duals_have_second_derivatives() {
        let x = Dual::variable(Dual::variable(0.8_f64));
        let found = x * x.sin_cos().0;
        // (x sin x)″ = 2 cos x − x sin x
        close(found.derivative.derivative, 2.0 * 0.8_f64.cos() - 0.8 * 0.8_f64.sin());
    }
}
