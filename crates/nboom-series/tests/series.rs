//! Coefficients against closed forms, over `f64` and in double-double.

use nboom_expr::{Expr, Graph};
use nboom_scalar::{DoubleDouble, Real};
use nboom_series::Series;

/// More than the sums that have code of their own are long.
const ORDER: usize = 30;

/// Coefficients of the first variable.
fn first<R: Real>(rates: fn(Expr, &[Expr]) -> Vec<Expr>, t: f64, y: &[f64]) -> Vec<R> {
    let graph = Graph::trace(y.len() + 1, |x| rates(x[y.len()], &x[..y.len()]));
    let y: Vec<R> = y.iter().map(|&y| R::constant(y)).collect();
    let mut series = Series::new(&graph, &[], ORDER);
    let mut found = vec![R::zero(); (ORDER + 1) * y.len()];
    // What is left of an earlier start must not matter.
    let elsewhere: Vec<R> = y.iter().map(|&y| y + R::constant(0.125)).collect();
    series.write(R::constant(t + 0.5), &elsewhere, &mut found);
    series.write(R::constant(t), &y, &mut found);
    found.into_iter().step_by(y.len()).collect()
}

/// c₀ = `start` and c_k = ratio(k) c_(k − 1).
fn by_ratios<R: Real>(start: R, ratio: impl Fn(f64) -> R) -> Vec<R> {
    let next = |(k, c): &(f64, R)| Some((k + 1.0, *c * ratio(k + 1.0)));
    std::iter::successors(Some((0.0, start)), next).take(ORDER + 1).map(|(_, c)| c).collect()
}

/// Recurrences add up about as many roundings as there are coefficients.
fn assert_near(found: &[DoubleDouble], expected: &[DoubleDouble], unit: f64) {
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        let (off, size) = ((*found - *expected).abs().to_f64(), expected.abs().to_f64());
        assert!(off <= 100.0 * unit * size, "power {k}: {found:?} {expected:?}");
    }
}

/// Compares in double-double, and then what `f64` gives with that.
fn check(rates: fn(Expr, &[Expr]) -> Vec<Expr>, t: f64, y: &[f64], expected: &[DoubleDouble]) {
    assert_near(&first(rates, t, y), expected, 1e-31);
    let plain = first::<f64>(rates, t, y).into_iter().map(DoubleDouble::from);
    assert_near(&plain.collect::<Vec<_>>(), expected, f64::EPSILON);
}

fn exact(value: f64) -> DoubleDouble {
    DoubleDouble::from(value)
}

#[test]
fn an_exponential() {
    check(|_, y| vec![y[0]], 0.0, &[1.0], &by_ratios(exact(1.0), |k| exact(1.0) / exact(k)));
}

/// ẏ = y² from 1: the geometric series.
#[test]
fn a_product() {
    check(|_, y| vec![y[0] * y[0]], 0.0, &[1.0], &by_ratios(exact(1.0), |_| exact(1.0)));
}

/// ẏ = 1/y from 2: √(4 + 2t), whose coefficients follow from the binomial series.
#[test]
fn a_quotient() {
    let ratio = |k: f64| exact(1.5 - k) / exact(k) * exact(0.5);
    check(|_, y| vec![Expr::one() / y[0]], 0.0, &[2.0], &by_ratios(exact(2.0), ratio));
}

/// ẏ = √y (y/y) + √y from 4: (t + 2)².
#[test]
fn a_root() {
    let rates: fn(Expr, &[Expr]) -> Vec<Expr> = |_, y| {
        let root = y[0].sqrt();
        vec![root * (y[0] / y[0]) + root]
    };
    let found = first::<f64>(rates, 0.0, &[4.0]);
    assert_eq!(found[..3], [4.0, 4.0, 1.0]);
    assert!(found[3..].iter().all(|c| c.abs() < 1e-15), "{found:?}");
}

/// ẏ = √(1 + t) / (1 + t) / 2, whose solution from 1 at t = 0 is √(1 + t): the binomial series.
#[test]
fn roots_quotients_and_constants_together() {
    let rates: fn(Expr, &[Expr]) -> Vec<Expr> = |t, _| {
        let from_one = Expr::one() + t;
        vec![from_one.sqrt() / from_one / Expr::constant(2.0)]
    };
    check(rates, 0.0, &[1.0], &by_ratios(exact(1.0), |k| exact(1.5 - k) / exact(k)));
}

/// ẏ = cos t and ẏ = sin t, each alone and at another time than zero.
#[test]
fn sines_and_cosines() {
    let t = 0.75;
    let (s, c) = exact(t).sin_cos();
    let cycle = |of: [DoubleDouble; 4]| -> Vec<DoubleDouble> {
        let factorial = by_ratios(exact(1.0), |k| exact(1.0) / exact(k));
        let coefficient = |(k, inverse): (usize, DoubleDouble)| of[(k + 3) % 4] * inverse;
        let mut all: Vec<_> = factorial.into_iter().enumerate().map(coefficient).collect();
        all[0] = exact(0.5);
        all
    };
    check(|t, _| vec![t.sin_cos().1], t, &[0.5], &cycle([c, -s, -c, s]));
    check(|t, _| vec![t.sin_cos().0], t, &[0.5], &cycle([s, c, -s, -c]));
}

/// ẏ = sin(a) y/3 from 1 with a fixed and a third made of whole numbers: neither may be rounded
/// to `f64` on the way.
#[test]
fn what_is_fixed_and_what_constants_make_have_all_digits() {
    let graph = Graph::trace_exactly(3, |x| {
        let third = Expr::one() / Expr::constant(3.0);
        vec![x[0] * (third * x[2].sin_cos().0)]
    });
    let angle = exact(0.5) / exact(7.0);
    let mut out = vec![exact(0.0); ORDER + 1];
    Series::new(&graph, &[angle], ORDER).write(exact(0.0), &[exact(1.0)], &mut out);
    let rate = angle.sin_cos().0 / exact(3.0);
    assert_near(&out, &by_ratios(exact(1.0), |k| rate / exact(k)), 1e-31);
}

/// ÿ = −sin y, whose energy ½ẏ² − cos y is constant along the series.
#[test]
fn a_pendulum_keeps_its_energy() {
    let graph = Graph::trace(3, |x| vec![x[1], -x[0].sin_cos().0]);
    let mut out = vec![DoubleDouble::zero(); (ORDER + 1) * 2];
    let start = [exact(1.0), exact(0.5)];
    Series::new(&graph, &[], ORDER).write(exact(0.0), &start, &mut out);
    let at = |t: f64, i: usize| {
        let terms = out.iter().skip(i).step_by(2).rev();
        terms.fold(exact(0.0), |sum, &c| sum * exact(t) + c)
    };
    let energy =
        |angle: DoubleDouble, rate: DoubleDouble| rate * rate * exact(0.5) - angle.sin_cos().1;
    let (before, after) = (energy(start[0], start[1]), energy(at(0.0625, 0), at(0.0625, 1)));
    // The radius of convergence is above 1: what is left out is below 0.0625³¹, rounding 1e-31.
    assert!((after - before).abs().to_f64() < 1e-30, "{:e}", (after - before).to_f64());
}
