//! Roots of polynomials of degree four on an interval.

/// Highest degree.
const DEGREE: usize = 4;

/// Width of an interval that counts as a point; intervals are about 1 long.
const RESOLUTION: f64 = 1e-16;

/// More halvings than an `f64` has bits; Newton's method needs about six steps.
const MOST_STEPS: usize = 100;

/// Coefficients, the constant first.
pub(crate) type Polynomial = [f64; DEGREE + 1];

/// Points at which a polynomial changes sign, between two ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SignChanges {
    knots: [f64; DEGREE + 2],
    count: usize,
}

impl SignChanges {
    /// All of them in `from..to`.
    ///
    /// Their number is that of the sign changes of the Bernstein coefficients, or fewer by an even
    /// number (Descartes' rule), so none or one is known at once.
    pub(crate) fn of(polynomial: &Polynomial, from: f64, to: f64) -> Self {
        match signs(&bernstein(polynomial, from, to)) {
            Signs::Alike => Self { knots: [from; DEGREE + 2], count: 1 },
            Signs::ChangeOnce => {
                let mut knots = [from; DEGREE + 2];
                let root = sign_change(polynomial, from, to);
                knots[1] = root.unwrap_or(from);
                Self { knots, count: if root.is_some() { 2 } else { 1 } }
            }
            Signs::Any => Self::by_derivatives(polynomial, from, to),
        }
    }

    /// All of them in `from..to`, whatever the polynomial.
    ///
    /// Between neighbouring sign changes of its derivative a polynomial is monotone, so it changes
    /// sign there at most once, which its values at the ends show. Starting with the third
    /// derivative, which is linear, the search misses only what rounding hides: two changes between
    /// which the polynomial differs from zero by no more than the error of its values.
    fn by_derivatives(polynomial: &Polynomial, from: f64, to: f64) -> Self {
        let mut found = Self { knots: [from; DEGREE + 2], count: 1 };
        for order in (0..DEGREE).rev() {
            let derivative = derivative(polynomial, order);
            let mut next = Self { knots: [from; DEGREE + 2], count: 1 };
            found.knots[found.count] = to;
            for piece in found.knots[..=found.count].windows(2) {
                if let Some(root) = sign_change(&derivative, piece[0], piece[1]) {
                    next.knots[next.count] = root;
                    next.count += 1;
                }
            }
            found = next;
        }
        found
    }

    /// The points in order.
    pub(crate) fn into_points(self) -> impl Iterator<Item = f64> {
        self.knots.into_iter().take(self.count).skip(1)
    }
}

/// What the signs of Bernstein coefficients show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Signs {
    /// None is negative, or none is positive.
    Alike,
    /// They change sign once, and none is zero at an end.
    ChangeOnce,
    /// Anything else.
    Any,
}

fn signs(coefficients: &Polynomial) -> Signs {
    let mut changes = 0;
    let mut last = 0.0;
    for &c in coefficients.iter().filter(|c| **c != 0.0) {
        if c * last < 0.0 {
            changes += 1;
        }
        last = c.signum();
    }
    let ends = coefficients[0] * coefficients[DEGREE].signum();
    match changes {
        0 => Signs::Alike,
        1 if ends < 0.0 => Signs::ChangeOnce,
        _ => Signs::Any,
    }
}

/// Coefficients in Bernstein's basis of the interval.
fn bernstein(polynomial: &Polynomial, from: f64, to: f64) -> Polynomial {
    let mut powers = *polynomial;
    // In powers of x − from, by repeated Horner schemes, then of that over the length.
    for done in 0..DEGREE {
        for power in (done..DEGREE).rev() {
            powers[power] += from * powers[power + 1];
        }
    }
    let mut scale = 1.0;
    for (power, over) in powers.iter_mut().zip([1.0, 4.0, 6.0, 4.0, 1.0]) {
        *power *= scale / over;
        scale *= to - from;
    }
    // b_j = Σ_i binomial(j, i) a_i / binomial(4, i): repeated sums of neighbours.
    for done in 1..=DEGREE {
        for j in (done..=DEGREE).rev() {
            powers[j] += powers[j - 1];
        }
    }
    powers
}

fn derivative(polynomial: &Polynomial, order: usize) -> Polynomial {
    let mut derived = *polynomial;
    for _ in 0..order {
        for power in 0..DEGREE {
            derived[power] = derived[power + 1] * (power + 1) as f64;
        }
        derived[DEGREE] = 0.0;
    }
    derived
}

/// Value and slope (Horner).
fn evaluate(polynomial: &Polynomial, x: f64) -> (f64, f64) {
    polynomial.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c, slope * x + value))
}

/// The sign change of a polynomial that is monotone in `from..to`: Newton's method, halving the
/// bracket wherever it would leave it.
fn sign_change(polynomial: &Polynomial, mut from: f64, mut to: f64) -> Option<f64> {
    let is_negative = |x: f64| evaluate(polynomial, x).0 < 0.0;
    let starts_negative = is_negative(from);
    if starts_negative == is_negative(to) {
        return None;
    }
    let mut x = 0.5 * (from + to);
    for _ in 0..MOST_STEPS {
        let (value, slope) = evaluate(polynomial, x);
        if (value < 0.0) == starts_negative {
            from = x;
        } else {
            to = x;
        }
        let newton = x - value / slope;
        let next = if from < newton && newton < to { newton } else { 0.5 * (from + to) };
        if (next - x).abs() <= RESOLUTION {
            break;
        }
        x = next;
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of a (x − r₁)(x − r₂)…
    fn with_roots(factor: f64, roots: &[f64]) -> Polynomial {
        let mut p = [0.0; DEGREE + 1];
        p[0] = factor;
        for root in roots {
            for power in (0..=DEGREE).rev() {
                let lower = if power > 0 { p[power - 1] } else { 0.0 };
                p[power] = lower - root * p[power];
            }
        }
        p
    }

    fn found(p: &Polynomial) -> Vec<f64> {
        SignChanges::of(p, 0.0, 1.0).into_points().collect()
    }

    #[test]
    fn all_roots_inside_are_found_and_none_outside() {
        for roots in [
            &[0.1, 0.2, 0.7, 0.9][..],
            &[-0.5, 0.3, 0.30001, 1.7],
            &[0.0, 0.5, 0.999],
            &[0.25],
            &[-1.0, 2.0],
            &[],
        ] {
            for factor in [1.0, -3.0, 1e-200, 1e200] {
                let inside: Vec<f64> =
                    roots.iter().copied().filter(|r| *r > 0.0 && *r < 1.0).collect();
                let found = found(&with_roots(factor, roots));
                // A root on an end may be told as one.
                let found: Vec<f64> = found.into_iter().filter(|r| *r > 1e-9).collect();
                assert_eq!(found.len(), inside.len(), "{factor} {roots:?}: {found:?}");
                for (root, right) in found.iter().zip(&inside) {
                    // Rounding of values, 1e-16, over the slope at roots 1e-5 apart.
                    assert!((root - right).abs() < 1e-10, "{roots:?}: {found:?}");
                }
            }
        }
    }

    #[test]
    fn bernstein_coefficients_have_the_polynomials_values() {
        let p = [0.3, -1.7, 2.9, 0.4, -1.1];
        let (from, to) = (-0.4, 0.3);
        let b = bernstein(&p, from, to);
        for step in 0..=10 {
            let u = f64::from(step) / 10.0;
            // De Casteljau.
            let mut level = b;
            for last in (0..DEGREE).rev() {
                for j in 0..=last {
                    level[j] = (1.0 - u) * level[j] + u * level[j + 1];
                }
            }
            let value = evaluate(&p, from + u * (to - from)).0;
            assert!((level[0] - value).abs() < 1e-14, "{u}: {} {value}", level[0]);
        }
    }

    /// Cubics, which walls have: with any coefficients, some of them zero, and with three roots.
    #[test]
    fn descartes_rule_finds_what_derivatives_find() {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        let mut number = || {
            bits ^= bits << 13;
            bits ^= bits >> 7;
            bits ^= bits << 17;
            if bits.is_multiple_of(7) {
                0.0
            } else {
                (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
            }
        };
        let mut counts = [0; 4];
        for case in 0..20_000 {
            let p = if case % 2 == 0 {
                [number(), number(), 2.0 * number(), number(), 0.0]
            } else {
                with_roots(number(), &[0.5 + number(), 0.5 + number(), 0.5 + number()])
            };
            // A root on an end may be told as one.
            let inside = |found: SignChanges| -> Vec<f64> {
                found.into_points().filter(|x| *x > 1e-9 && *x < 1.0 - 1e-9).collect()
            };
            let quick = inside(SignChanges::of(&p, 0.0, 1.0));
            let sure = inside(SignChanges::by_derivatives(&p, 0.0, 1.0));
            assert_eq!(quick.len(), sure.len(), "{p:?}: {quick:?} {sure:?}");
            for (quick, sure) in quick.iter().zip(&sure) {
                let slope = evaluate(&p, *sure).1.abs();
                // Rounding of values over the slope.
                assert!((quick - sure).abs() * slope < 1e-14, "{p:?}: {quick} {sure}");
            }
            counts[sure.len()] += 1;
        }
        assert!(counts.iter().all(|&count| count > 20), "{counts:?}");
    }

    #[test]
    fn a_triple_root_is_one_change_and_a_double_root_none() {
        let triple = found(&with_roots(1.0, &[0.5, 0.5, 0.5]));
        assert_eq!(triple.len(), 1);
        // The cube root of rounding.
        assert!((triple[0] - 0.5).abs() < 1e-5);
        assert!(found(&with_roots(1.0, &[0.5, 0.5])).is_empty());
        assert!(found(&[0.0; DEGREE + 1]).is_empty());
    }
}
