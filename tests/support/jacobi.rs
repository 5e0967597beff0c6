//! Jacobi's elliptic functions by the arithmetic-geometric mean (Abramowitz and Stegun 16.4,
//! 17.6), with checks against the integral that defines them.
#![allow(dead_code, reason = "each test binary uses its own part")]

use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of the mean; it doubles its digits with each.
const STEPS: usize = 8;

/// (a, c) of the arithmetic-geometric mean of 1 and √(1 − m).
fn means(m: f64) -> [(f64, f64); STEPS + 1] {
    let mut table = [(0.0, 0.0); STEPS + 1];
    let (mut a, mut b, mut c) = (1.0, (1.0 - m).sqrt(), m.sqrt());
    for entry in &mut table {
        *entry = (a, c);
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
    }
    table
}

/// K(m), the complete integral of the first kind; 0 ≤ m < 1.
pub fn complete(m: f64) -> f64 {
    PI / (2.0 * means(m)[STEPS].0)
}

/// sn, cn and dn of `u` at the parameter m = k²; 0 ≤ m < 1.
pub fn sn_cn_dn(u: f64, m: f64) -> (f64, f64, f64) {
    let table = means(m);
    // The amplitude gains π with every 2 K, which the recursion below would round off.
    let half_periods = (u / (2.0 * complete(m))).round();
    let rest = u - half_periods * 2.0 * complete(m);
    let mut phi = f64::from(1 << STEPS) * table[STEPS].0 * rest;
    for &(a, c) in table[1..].iter().rev() {
        phi = 0.5 * (phi + (c / a * phi.sin()).asin());
    }
    let sign = if half_periods % 2.0 == 0.0 { 1.0 } else { -1.0 };
    let (sn, cn) = phi.sin_cos();
    (sign * sn, sign * cn, (1.0 - m * sn * sn).sqrt())
}

/// F(φ | m), the integral that `sn_cn_dn` inverts, by Gauss's rule of three points.
fn incomplete(phi: f64, m: f64) -> f64 {
    let parts = 2000;
    let half = 0.5 * phi / f64::from(parts);
    let slope = |x: f64| 1.0 / (1.0 - m * x.sin().powi(2)).sqrt();
    let reach = half * 0.6_f64.sqrt();
    let part = |i: i32| {
        let middle = half * f64::from(2 * i + 1);
        (5.0 * (slope(middle - reach) + slope(middle + reach)) + 8.0 * slope(middle)) / 9.0
    };
    (0..parts).map(part).sum::<f64>() * half
}

#[test]
fn inverse_of_the_integral() {
    for m in [0.0, 0.1, 0.5, 0.9, 0.999] {
        for phi in [-1.5, -0.3, 0.2, 1.0, 1.5] {
            let (sn, cn, dn) = sn_cn_dn(incomplete(phi, m), m);
            // The rule's error is below 1e-15; K'(m) near m = 1 magnifies rounding.
            assert!((sn - phi.sin()).abs() < 2e-14, "{m} {phi}");
            assert!((cn - phi.cos()).abs() < 2e-14, "{m} {phi}");
            assert!((dn - (1.0 - m * phi.sin().powi(2)).sqrt()).abs() < 2e-14, "{m} {phi}");
        }
        assert!((complete(m) - incomplete(FRAC_PI_2, m)).abs() < 2e-14 * complete(m));
    }
}

#[test]
fn printed_values_and_periods() {
    // Abramowitz and Stegun, table 17.1: K(0.5), and example 16.1: sn(0.20 | 0.81).
    assert!((complete(0.5) - 1.854_074_677_301_37).abs() < 1e-14);
    assert!((sn_cn_dn(0.2, 0.81).0 - 0.197_62).abs() < 5e-6);
    for m in [0.2, 0.7] {
        for u in [0.1, 0.9, 1.7] {
            let quarter = complete(m);
            let (sn, cn, dn) = sn_cn_dn(u, m);
            let half_on = sn_cn_dn(u + 2.0 * quarter, m);
            let full_on = sn_cn_dn(u + 400.0 * quarter, m);
            let quarter_on = sn_cn_dn(u + quarter, m);
            for (found, expected) in [
                (half_on, (-sn, -cn, dn)),
                (full_on, (sn, cn, dn)),
                (quarter_on, (cn / dn, -(1.0 - m).sqrt() * sn / dn, (1.0 - m).sqrt() / dn)),
            ] {
                // Rounding of u + 400 K, some 700 units, is 1e-13.
                assert!((found.0 - expected.0).abs() < 3e-13);
                assert!((found.1 - expected.1).abs() < 3e-13);
                assert!((found.2 - expected.2).abs() < 3e-13);
            }
        }
    }
}
