use std::f64::consts::FRAC_2_PI;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::Real;

/// A number of about 32 digits: the sum of two `f64`, of which the low part is at most half a
/// unit in the last place of the high one.
///
/// It is there to tell how far the same equations on `f64` are off. Relative errors, in units
/// of 2⁻¹⁰⁴ = 4.9e-32, are at most 3/4 for sums and differences (however much cancels), 5/4 for
/// products, 15/4 for quotients and 1 for square roots (Joldes, Muller and Popescu 2017;
/// Muller and Rideau 2022; Lefèvre and others 2023). Sines and cosines of angles up to 1e5 are
/// off by at most one such unit (not relative), and sines of angles below π/4 by three relative.
///
/// Bounds hold while no part overflows or underflows: for magnitudes from 1e-140 to 1e140 of
/// operands and results, and for zero. Beyond, parts may become NaN. Comparison is by value.
///
/// ```
/// use nboom_scalar::{DoubleDouble, Real};
/// let third = DoubleDouble::one() / DoubleDouble::from(3.0);
/// let missing = DoubleDouble::one() - third - third - third;
/// assert!(missing.abs().to_f64() < 1e-31);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

/// π/2 in three parts, to 6e-50.
const HALF_PI: [f64; 3] =
    [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// The rounded sum and its error, exactly.
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// [`two_sum`] of parts of which the first is not the smaller one.
#[inline]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// The rounded product and its error, exactly.
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

impl DoubleDouble {
    /// π.
    pub const PI: Self = Self { high: 2.0 * HALF_PI[0], low: 2.0 * HALF_PI[1] };

    /// The exact sum of two parts, which may overlap and stand in any order.
    pub fn new(high: f64, low: f64) -> Self {
        let (high, low) = two_sum(high, low);
        Self { high, low }
    }

    /// The nearest `f64`.
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// The high part, which is the nearest `f64`.
    pub fn high(self) -> f64 {
        self.high
    }

    /// What the number has beyond its high part.
    pub fn low(self) -> f64 {
        self.low
    }

    /// Magnitude.
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The sum of parts of which the first is not the smaller one.
    #[inline]
    fn fast((high, low): (f64, f64)) -> Self {
        let (high, low) = fast_two_sum(high, low);
        Self { high, low }
    }

    /// The angle less the nearest multiple of π/2, and how many quarters that is, modulo 4.
    ///
    /// Products with the parts of π/2 are exact but for the last, and so is the difference
    /// where most of the angle cancels; what is left loses no digits.
    fn reduced(self) -> (Self, u8) {
        let quarters = (self.high * FRAC_2_PI).round();
        let (a, b) = two_product(quarters, HALF_PI[0]);
        let (c, d) = two_product(quarters, HALF_PI[1]);
        let rest = Self::new(self.high, -a) + (Self::new(self.low, -b) - Self::new(c, d));
        let rest = rest - Self::from(quarters * HALF_PI[2]);
        (rest, quarters.rem_euclid(4.0) as u8)
    }
}

/// 1 − z/(n(n+1)) (1 − z/((n+2)(n+3)) (1 − …)), which is (sin x)/x for `first` 2 and cos x for
/// `first` 1 where z = x² is at most (π/4)², to 2⁻¹⁰⁶.
fn alternating(first: u32, z: DoubleDouble) -> DoubleDouble {
    let mut sum = DoubleDouble::one();
    for i in (0..14).rev() {
        let n = f64::from(first + 2 * i);
        sum = DoubleDouble::one() - z * sum / DoubleDouble::from(n * (n + 1.0));
    }
    sum
}

impl Real for DoubleDouble {
    fn constant(value: f64) -> Self {
        Self::from(value)
    }

    /// The root of the high part, corrected by one Newton step.
    fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        let root = self.high.sqrt();
        let rest = root.mul_add(-root, self.high) + self.low;
        Self::fast((root, rest / (2.0 * root)))
    }

    /// Reduction to π/4 by multiples of π/2, then the power series.
    fn sin_cos(self) -> (Self, Self) {
        let (x, quadrant) = self.reduced();
        let z = x * x;
        let (sine, cosine) = (x * alternating(2, z), alternating(1, z));
        match quadrant {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, of_high) = two_sum(self.high, other.high);
        let (low, of_low) = two_sum(self.low, other.low);
        let (high, rest) = fast_two_sum(high, of_high + low);
        Self::fast((high, rest + of_low))
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (high, rest) = two_product(self.high, other.high);
        // Not fused, so that factors may be exchanged.
        let crossed = self.high * other.low + self.low * other.high;
        Self::fast((high, rest + crossed))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.high / other.high;
        let (high, rest) = two_product(other.high, quotient);
        let back = Self::fast((high, other.low.mul_add(quotient, rest)));
        let rest = (self.high - back.high) + (self.low - back.low);
        Self::fast((quotient, rest / other.high))
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl AddAssign for DoubleDouble {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::SplitMix64;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use super::*;

    /// 2⁻¹⁰⁴.
    const UNIT: f64 = 1.0 / (1_u128 << 104) as f64;

    /// Random numbers that are the same everywhere.
    struct Random(SplitMix64);

    impl Random {
        /// A number between −`scale` and `scale` with a low part of its own.
        fn number(&mut self, scale: f64) -> DoubleDouble {
            let [high, low] =
                [0; 2].map(|_| self.0.next_u64() as i64 as f64 / (1_u64 << 63) as f64);
            DoubleDouble::new(scale * high, scale * low * high * f64::EPSILON / 2.0)
        }

        /// An integer of up to `bits` bits and a sign.
        fn integer(&mut self, bits: u32) -> i128 {
            let wide =
                (u128::from(self.0.next_u64()) << 64 | u128::from(self.0.next_u64())) as i128;
            wide >> (128 - 1 - bits)
        }
    }

    fn from_integer(value: i128) -> DoubleDouble {
        let high = value as f64;
        DoubleDouble::new(high, (value - high as i128) as f64)
    }

    /// The integer part of each part, added up.
    fn to_integer(value: DoubleDouble) -> i128 {
        value.high as i128 + value.low as i128
    }

    /// `whole` and three times fifteen decimals.
    fn digits(whole: f64, decimals: [i64; 3]) -> DoubleDouble {
        let shift = DoubleDouble::from(1e15);
        let after = |sum, &part| (sum + DoubleDouble::from(part as f64)) / shift;
        DoubleDouble::from(whole) + decimals.iter().rev().fold(DoubleDouble::zero(), after)
    }

    /// Asserts a difference of at most `units` of 2⁻¹⁰⁴ times `scale`.
    fn close(found: DoubleDouble, expected: DoubleDouble, units: f64, scale: DoubleDouble) {
        let off = (found - expected).to_f64().abs() / UNIT;
        let allowed = units * scale.to_f64().abs();
        assert!(off <= allowed, "{found:?} {expected:?}: {off} units, {allowed} allowed");
    }

    #[test]
    fn sums_and_products_of_integers() {
        let mut random = Random(SplitMix64::seed_from_u64(1));
        for i in 0..20_000 {
            let (a, b) = (random.integer(61), random.integer(2 + i % 60));
            let product = to_integer(from_integer(a) * from_integer(b));
            // 5/4 units, and the fractions that are cut off.
            let allowed = ((a * b).abs() >> 104) * 5 / 4 + 2;
            assert!((product - a * b).abs() <= allowed, "{a} * {b}: {product}");

            let high_bits = 106 + i % 18;
            let (x, y) = (random.integer(high_bits), random.integer(high_bits - i % 7));
            let (x, y) = (from_integer(x), from_integer(y));
            let exact = to_integer(x) + to_integer(y);
            let allowed = (exact.abs() >> 104) * 3 / 4 + 2;
            assert!((to_integer(x + y) - exact).abs() <= allowed, "{x:?} {y:?}");
            assert_eq!(x - (-y), x + y);
        }
    }

    #[test]
    fn low_parts_are_within_half_a_unit_of_high_ones() {
        let mut random = Random(SplitMix64::seed_from_u64(2));
        for i in 0..20_000 {
            let (a, mut b) = (random.number(3.0), random.number(1e3));
            if i % 2 == 0 {
                b = -a + random.number(1.0) * DoubleDouble::from(0.5_f64.powi(i % 100));
            }
            let (s, c) = b.sin_cos();
            for found in [a, b, a + b, a - b, a * b, a / b, a.abs().sqrt(), s, c] {
                assert_eq!(found.high + found.low, found.high, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn inverses_and_laws_of_arithmetic() {
        let mut random = Random(SplitMix64::seed_from_u64(3));
        for _ in 0..20_000 {
            let (a, b, c) = (random.number(7.0), random.number(1e-3), random.number(50.0));
            assert_eq!((a + b, a * b), (b + a, b * a));
            close(a / b * b, a, 5.0, a);
            close(a * b / b, a, 5.0, a);
            close(DoubleDouble::one() / (DoubleDouble::one() / a), a, 7.5, a);
            close((a + c) - c, a, 1.5, a.abs() + c.abs());
            close((a + b) + c, a + (b + c), 3.0, a.abs() + b.abs() + c.abs());
            close(a * b * c, a * (b * c), 5.0, a * b * c);
            close(a * (b + c), a * b + a * c, 4.0, (a * b).abs() + (a * c).abs());
            close(a.abs().sqrt() * a.abs().sqrt(), a.abs(), 3.25, a);
            close((a * a).sqrt(), a.abs(), 2.0, a);
        }
    }

    #[test]
    fn known_digits() {
        let (one, sin_cos) = (DoubleDouble::one(), |x| DoubleDouble::from(x).sin_cos());
        let known = [
            (
                DoubleDouble::PI,
                3.0,
                [141_592_653_589_793, 238_462_643_383_279, 502_884_197_169_399],
            ),
            (
                DoubleDouble::from(2.0).sqrt(),
                1.0,
                [414_213_562_373_095, 48_801_688_724_209, 698_078_569_671_875],
            ),
            (sin_cos(1.0).0, 0.0, [841_470_984_807_896, 506_652_502_321_630, 298_999_622_563_060]),
            (sin_cos(1.0).1, 0.0, [540_302_305_868_139, 717_400_936_607_442, 976_603_732_310_420]),
            (sin_cos(1e5).0, 0.0, [35_748_797_972_016, 509_316_470_500_695, 808_829_009_045_692]),
            (-sin_cos(1e5).1, 0.0, [999_360_807_438_212, 451_891_135_414_144, 802_203_235_386_587]),
        ];
        for (found, whole, decimals) in known {
            close(found, digits(whole, decimals), 2.0, one);
        }
        // 355/113 is close to π: four digits cancel, and the sine must not miss them.
        let sine = digits(0.0, [30_144_353_359, 488_449_214_330_280, 8_650_099_590_255]);
        close(sin_cos(-355.0).0, sine, 1e-3, one);
    }

    #[test]
    fn pi_by_machin() {
        let arctangent_of_inverse = |n: f64| {
            let (n, mut sum) = (DoubleDouble::from(n), DoubleDouble::zero());
            let mut power = DoubleDouble::one() / n;
            for i in 0..30 {
                let term = power / DoubleDouble::from(f64::from(2 * i + 1));
                sum = if i % 2 == 0 { sum + term } else { sum - term };
                power = power / (n * n);
            }
            sum
        };
        let quarter = DoubleDouble::from(4.0) * arctangent_of_inverse(5.0);
        let pi = DoubleDouble::from(4.0) * (quarter - arctangent_of_inverse(239.0));
        close(pi, DoubleDouble::PI, 10.0, pi);
    }

    #[test]
    fn identities_of_sine_and_cosine() {
        let (mut random, one) = (Random(SplitMix64::seed_from_u64(4)), DoubleDouble::one());
        for i in 0..10_000 {
            let (a, b) = (random.number([5e4, 2.0][i % 2]), random.number(5e4));
            let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
            close(sa * sa + ca * ca, one, 4.0, one);
            // The sum of the angles has rounded by 3/4 of a unit.
            let (s, c) = (a + b).sin_cos();
            let scale = one + a.abs() + b.abs();
            close(s, sa * cb + ca * sb, 8.0, scale);
            close(c, ca * cb - sa * sb, 8.0, scale);
            assert_eq!((-a).sin_cos(), (-sa, ca));
            let small = a * DoubleDouble::from(1e-14 * 0.5_f64.powi(i as i32 % 90));
            let cubic = small - small * small * small / DoubleDouble::from(6.0);
            close(small.sin_cos().0, cubic, 3.0, small);
        }
    }

    #[test]
    fn zero_and_conversions() {
        let zero = DoubleDouble::zero();
        assert_eq!(zero.sin_cos(), (zero, DoubleDouble::one()));
        assert_eq!(zero.sqrt(), zero);
        assert!(DoubleDouble::from(-1.0).sqrt().to_f64().is_nan());
        let x = DoubleDouble::new(1e-20, 1.0);
        assert_eq!((x.high(), x.low(), x.to_f64()), (1.0, 1e-20, 1.0));
        assert_eq!(<DoubleDouble as Real>::constant(0.1), DoubleDouble::from(0.1));
        assert!(x > DoubleDouble::one() && -x < -DoubleDouble::one());
        assert_eq!((-x).abs(), x);
    }
}
