use nboom_scalar::Eight;

use super::super::collocation::Collocation;
use crate::gauss::coefficients::STAGES;
use crate::legendre::{bernstein_of_legendre, legendre};
use crate::side_by_side::Columns;

/// Lobatto's nodes, ends included.
pub(super) const NODES: usize = 11;
/// The one at which nothing is evaluated.
pub(super) const MIDDLE: usize = NODES / 2;
/// What is known before the evaluation: K of all stages and of both ends.
pub(super) const KNOWN: usize = STAGES + 2;

/// A number for each node, or for each Legendre polynomial up to the degree of a polynomial
/// through all nodes.
pub(super) type Spectrum = [f64; NODES];

/// How the motion inside a step is found again from a few more evaluations.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    /// Where the evaluations are, on [0, 1].
    pub nodes: Eight,
    /// From what is known to the increments at these nodes.
    pub once: Columns<KNOWN>,
    /// From what is known to the integrals of the increments.
    pub twice: Columns<KNOWN>,
    /// Lobatto's weights.
    pub weights: Spectrum,
    /// From values at all nodes to Legendre coefficients, by columns.
    pub spectrum: [Spectrum; NODES],
    /// For each Legendre polynomial its Bernstein coefficients.
    pub bernstein: [Spectrum; NODES],
}

impl Rule {
    pub fn new(collocation: &Collocation) -> Self {
        let points: Spectrum = std::array::from_fn(root);
        let at: [Spectrum; NODES] = points.map(legendre);
        let degree = (NODES - 1) as f64;
        let weights = at.map(|p| 1.0 / (degree * (degree + 1.0) * p[NODES - 1] * p[NODES - 1]));
        // Lobatto's quadrature is exact for all products of two but the square of the last.
        let norm = |k: usize| if k == NODES - 1 { degree } else { (2 * k + 1) as f64 };
        let column = |j: usize| std::array::from_fn(|k| norm(k) * weights[j] * at[j][k]);
        let nodes: [f64; STAGES] = std::array::from_fn(|i| 0.5 + 0.5 * points[node(i)]);
        let from_known = |basis: fn(f64) -> [f64; KNOWN]| -> Columns<KNOWN> {
            std::array::from_fn(|j| {
                let terms = through_known(collocation, j);
                Eight(nodes.map(|x| basis(x).iter().zip(&terms).map(|(b, c)| b * c).sum()))
            })
        };
        Self {
            nodes: Eight(nodes),
            once: from_known(integrals),
            twice: from_known(second_integrals),
            weights,
            spectrum: std::array::from_fn(column),
            bernstein: std::array::from_fn(bernstein_of_legendre),
        }
    }
}

/// Which of all nodes evaluation `i` is at.
pub(super) const fn node(i: usize) -> usize {
    if i + 1 < MIDDLE { i + 1 } else { i + 2 }
}

/// Legendre coefficients of the polynomial of degree 9 that is 1 at stage `j`, or at an end for the
/// last two, and 0 at the others: the one through the stages, and (α + βx) P₈, which is zero there.
fn through_known(collocation: &Collocation, j: usize) -> [f64; KNOWN] {
    let mut terms = [0.0; KNOWN];
    let mut missing = [f64::from(j == STAGES), f64::from(j == STAGES + 1)];
    if let Some(column) = collocation.spectrum.get(j) {
        for (k, c) in column.0.into_iter().enumerate() {
            terms[k] = c;
            missing[0] -= if k.is_multiple_of(2) { c } else { -c };
            missing[1] -= c;
        }
    }
    let (alpha, beta) = (0.5 * (missing[1] + missing[0]), 0.5 * (missing[1] - missing[0]));
    let s = STAGES as f64;
    terms[STAGES - 1] += beta * s / (2.0 * s + 1.0);
    terms[STAGES] = alpha;
    terms[STAGES + 1] = beta * (s + 1.0) / (2.0 * s + 1.0);
    terms
}

/// Enough for all integrals.
const TERMS: usize = NODES + 3;

/// Integrals of Legendre polynomials of 2x − 1 from 0 to x.
pub(super) fn integrals<const N: usize>(x: f64) -> [f64; N] {
    let p: [f64; TERMS] = legendre(2.0 * x - 1.0);
    let integral = |k: usize| 0.5 * (p[k + 1] - p[k - 1]) / (2 * k + 1) as f64;
    std::array::from_fn(|k| if k == 0 { x } else { integral(k) })
}

/// Integrals of these.
pub(super) fn second_integrals<const N: usize>(x: f64) -> [f64; N] {
    let q: [f64; TERMS - 1] = integrals(x);
    let integral = |k: usize| 0.5 * (q[k + 1] - q[k - 1]) / (2 * k + 1) as f64;
    std::array::from_fn(|k| if k == 0 { 0.5 * x * x } else { integral(k) })
}

/// Enough from Chebyshev's points.
const NEWTON_STEPS: usize = 8;

/// Node `i` in ascending order on [−1, 1], by Newton's method; those of each pair are opposite.
fn root(i: usize) -> f64 {
    let mirrored = NODES - 1 - i;
    if mirrored < i {
        return -root(mirrored);
    }
    if i == 0 || i == MIDDLE {
        return if i == 0 { -1.0 } else { 0.0 };
    }
    let n = NODES - 1;
    let mut x = -(std::f64::consts::PI * i as f64 / n as f64).cos();
    for _ in 0..NEWTON_STEPS {
        // (1 − x²) P′_n = n (P_{n−1} − x P_n), whose derivative is −n (n + 1) P_n.
        let p: Spectrum = legendre(x);
        x += (p[n - 1] - x * p[n]) / ((n + 1) as f64 * p[n]);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lobattos_conditions_hold() {
        let rule = Rule::new(Collocation::of_eight_stages());
        let mut nodes = [0.0, 1.0, 0.5].to_vec();
        let mut weights = [0, NODES - 1, MIDDLE].map(|i| rule.weights[i]).to_vec();
        nodes.extend(rule.nodes.0);
        weights.extend((0..STAGES).map(|i| rule.weights[node(i)]));
        for degree in 0..2 * NODES - 2 {
            let terms = nodes.iter().zip(&weights);
            let found: f64 = terms.map(|(x, w)| w * x.powi(degree as i32)).sum();
            let error = found - 1.0 / (degree + 1) as f64;
            assert!(error.abs() < 4.0 * f64::EPSILON, "{degree}: {error:e}");
        }
    }

    #[test]
    fn a_polynomial_through_what_is_known_is_found_again() {
        let collocation = Collocation::of_eight_stages();
        let rule = Rule::new(collocation);
        let stages = collocation.times(0.0, 1.0).0;
        for degree in 0..KNOWN {
            let power = degree as i32;
            let mut known = [0.0; KNOWN];
            known[..STAGES].copy_from_slice(&stages.map(|x| x.powi(power)));
            known[STAGES] = f64::from(degree == 0);
            known[STAGES + 1] = 1.0;
            for (i, x) in rule.nodes.0.into_iter().enumerate() {
                let (first, second) = ((degree + 1) as f64, (degree + 2) as f64);
                for (columns, exact) in [
                    (&rule.once, x.powi(power + 1) / first),
                    (&rule.twice, x.powi(power + 2) / (first * second)),
                ] {
                    let found: f64 = columns.iter().zip(&known).map(|(c, k)| c.0[i] * k).sum();
                    assert!((found - exact).abs() < 1e-14, "{degree} {i}: {found} {exact}");
                }
            }
        }
    }
}
