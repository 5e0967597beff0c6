//! Roots of polynomials of degree four on an interval.

/// Highest degree.
const DEGREE: usize = 4;

/// Width of an interval that counts as a point; intervals are about 1 long.
const RESOLUTION: f64 = 1e-16;

/// More halvings than a double has digits; Newton's method needs about six steps.
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
    /// Between neighbouring sign changes of its derivative a polynomial is monotone, so it changes
    /// sign there at most once, and does if its ends say so. Starting with the third derivative,
    /// which is linear, none is missed on the way to the polynomial itself but what rounding hides:
    /// two changes between which it differs from zero by no more than the error of its values.
    pub(crate) fn of(polynomial: &Polynomial, from: f64, to: f64) -> Self {
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
    fn a_triple_root_is_one_change_and_a_double_root_none() {
        let triple = found(&with_roots(1.0, &[0.5, 0.5, 0.5]));
        assert_eq!(triple.len(), 1);
        // The cube root of rounding.
        assert!((triple[0] - 0.5).abs() < 1e-5);
        assert!(found(&with_roots(1.0, &[0.5, 0.5])).is_empty());
        assert!(found(&[0.0; DEGREE + 1]).is_empty());
    }
}
