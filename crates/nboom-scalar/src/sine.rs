//! Sine and cosine without branches, so that loops over them become vector code.

pub(crate) const TWO_OVER_PI: f64 = std::f64::consts::FRAC_2_PI;
/// π/2 in three parts.
pub(crate) const HALF_PI: [f64; 3] =
    [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_711_166_5e-21];
/// sin r = r + r z (…), z = r², highest power first.
pub(crate) const SINE: [f64; 6] = [
    1.589_623_015_765_465_7e-10,
    -2.505_074_776_285_780_7e-8,
    2.755_731_362_138_572_5e-6,
    -1.984_126_982_958_954e-4,
    8.333_333_333_322_118e-3,
    -1.666_666_666_666_663e-1,
];
/// cos r = 1 − z/2 + z² (…).
pub(crate) const COSINE: [f64; 6] = [
    -1.135_853_652_138_768_2e-11,
    2.087_570_084_197_473e-9,
    -2.755_731_417_929_674e-7,
    2.480_158_728_885_170_5e-5,
    -1.388_888_888_887_305_6e-3,
    4.166_666_666_666_659e-2,
];
/// Adding this puts the integer part into the lowest bits.
pub(crate) const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// Sine and cosine of an angle \[rad\] of magnitude up to 1e5, to about one unit in the last
/// place.
///
/// The angle is reduced by multiples of π/2 in three parts (Cody and Waite) and the remainder
/// put into the minimax polynomials of Sun's fdlibm. Products and sums are fused; where the
/// processor cannot do that the call is slow but the result the same. Beyond 1e5 the reduction
/// loses digits in proportion to the angle.
#[inline(always)]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    let shifted = angle.mul_add(TWO_OVER_PI, TO_INTEGER);
    let quarters = shifted - TO_INTEGER;
    let r = (-quarters).mul_add(HALF_PI[0], angle);
    let r = (-quarters).mul_add(HALF_PI[1], r);
    let r = (-quarters).mul_add(HALF_PI[2], r);
    let z = r * r;
    let horner = |c: [f64; 6]| {
        let [a, b, c, d, e, f] = c;
        a.mul_add(z, b).mul_add(z, c).mul_add(z, d).mul_add(z, e).mul_add(z, f)
    };
    let sine = (r * z).mul_add(horner(SINE), r);
    let cosine = (z * z).mul_add(horner(COSINE), (-0.5_f64).mul_add(z, 1.0));
    let quadrant = shifted.to_bits();
    let odd = (quadrant & 1).wrapping_neg();
    let (s, c) = (sine.to_bits(), cosine.to_bits());
    let swapped = (s ^ c) & odd;
    let sine_sign = (quadrant & 2) << 62;
    let cosine_sign = (quadrant.wrapping_add(1) & 2) << 62;
    (f64::from_bits(s ^ swapped ^ sine_sign), f64::from_bits(c ^ swapped ^ cosine_sign))
}

#[cfg(test)]
mod tests {
    use super::sin_cos;

    #[test]
    fn agrees_with_the_standard_library() {
        let mut worst = 0.0_f64;
        for i in -200_000..200_000 {
            let angle = f64::from(i) * 0.499_371;
            let ((s, c), (es, ec)) = (sin_cos(angle), angle.sin_cos());
            worst = worst.max((s - es).abs()).max((c - ec).abs());
        }
        // Both err by less than one unit in the last place of 1.
        assert!(worst < 2.3e-16, "{worst:e}");
    }

    #[test]
    fn exact_at_zero_and_right_in_every_quadrant() {
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        for quarter in -8..=8 {
            let (s, c) = sin_cos(f64::from(quarter) * std::f64::consts::FRAC_PI_2);
            let expected: [(f64, f64); 4] = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
            let (es, ec) = expected[usize::try_from(quarter + 8).expect("not negative") % 4];
            assert!((s - es).abs() < 1e-14 && (c - ec).abs() < 1e-14, "{quarter}: {s} {c}");
        }
    }
}
