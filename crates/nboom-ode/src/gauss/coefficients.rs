use crate::legendre::{bernstein_of_legendre, legendre};

/// Stages of the method, whose order is twice as high.
pub(crate) const STAGES: usize = 8;

/// Values of the Legendre polynomials P₀, P₁, … up to the degree of the nodes.
type Values = [f64; STAGES + 1];

/// One number for each pair of stages, row by row.
pub(crate) type Matrix = [[f64; STAGES]; STAGES];

/// Gauss's collocation method in terms of the stages' increments Lⱼ = h bⱼ f(Yⱼ).
///
/// Yᵢ = y + ½ ΣLⱼ + Σ dᵢⱼ Lⱼ with dᵢⱼ = aᵢⱼ/bⱼ − ½. The method keeps quadratic invariants when
/// d is antisymmetric, and is its own reverse when d and the weights are the same with the
/// stages counted backwards; in this form both hold for the rounded numbers too, so rounding of
/// coefficients does not add up (Antoñana, Makazaga, Murua, Numer. Algorithms 76, 2017).
#[derive(Clone, Debug)]
pub(crate) struct Coefficients {
    /// cᵢ on [0, 1].
    pub nodes: [f64; STAGES],
    /// bᵢ.
    pub weights: [f64; STAGES],
    /// dᵢⱼ.
    pub couplings: Matrix,
    /// From increments to the Legendre coefficients of h u̇, u the collocation polynomial.
    pub spectrum: Matrix,
    /// From increments to the Bernstein coefficients of u less its value at the start.
    bernstein: [[f64; STAGES]; STAGES + 1],
}

impl Coefficients {
    pub fn new() -> Self {
        let points: [f64; STAGES] = std::array::from_fn(root);
        let at: [Values; STAGES] = points.map(legendre);
        let spectrum: Matrix = std::array::from_fn(|k| at.map(|p| (2 * k + 1) as f64 * p[k]));
        // Christoffel's numbers, sums of positive terms.
        let weight = |i: usize| 1.0 / (0..STAGES).map(|k| spectrum[k][i] * at[i][k]).sum::<f64>();
        // From aᵢⱼ = bⱼ Σ (2k + 1) P_k(ξⱼ) ∫P_k up to cᵢ, whose integrals are differences of
        // the polynomials beside P_k.
        let coupling = |i: usize, j: usize| -> f64 {
            let (p, q) = (&at[i], &at[j]);
            (0..STAGES - 1).map(|k| 0.5 * (p[k + 1] * q[k] - p[k] * q[k + 1])).sum()
        };
        Self {
            nodes: points.map(|x| 0.5 + 0.5 * x),
            weights: std::array::from_fn(weight),
            couplings: std::array::from_fn(|i| std::array::from_fn(|j| coupling(i, j))),
            bernstein: std::array::from_fn(|row| {
                std::array::from_fn(|j| {
                    (0..STAGES).map(|k| integral_of_legendre(k)[row] * spectrum[k][j]).sum()
                })
            }),
            spectrum,
        }
    }

    /// What turns the increments of one step into those of the polynomial's continuation over
    /// another, which begins at the fraction `from` of it and is `ratio` times as long.
    pub fn continuation(&self, from: f64, ratio: f64) -> Matrix {
        std::array::from_fn(|i| {
            let p: Values = legendre(2.0 * (from + ratio * self.nodes[i]) - 1.0);
            std::array::from_fn(|j| {
                let value: f64 = (0..STAGES).map(|k| p[k] * self.spectrum[k][j]).sum();
                ratio * self.weights[i] * value
            })
        })
    }

    /// Bernstein coefficients of the polynomial with these increments that starts at `start`.
    pub fn bernstein(&self, start: f64, increments: &[f64; STAGES]) -> [f64; STAGES + 1] {
        self.bernstein.map(|row| start + dot(&row, increments))
    }
}

pub(crate) fn dot(a: &[f64; STAGES], b: &[f64; STAGES]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Root `i` of P_s in ascending order, by Newton's method; those of each pair are opposite.
fn root(i: usize) -> f64 {
    let mirrored = STAGES - 1 - i;
    if mirrored < i {
        return -root(mirrored);
    }
    let angle = std::f64::consts::PI * (i as f64 + 0.75) / (STAGES as f64 + 0.5);
    let mut x = -angle.cos();
    for _ in 0..NEWTON_STEPS {
        let p: Values = legendre(x);
        let slope = STAGES as f64 * (p[STAGES - 1] - x * p[STAGES]) / (1.0 - x * x);
        x -= p[STAGES] / slope;
    }
    x
}

/// Enough from a guess with two digits.
const NEWTON_STEPS: usize = 6;

/// Bernstein coefficients of ∫P_k(2x − 1) from 0, of degree s.
fn integral_of_legendre(k: usize) -> [f64; STAGES + 1] {
    let slope: [f64; STAGES] = bernstein_of_legendre(k);
    let mut sums = [0.0; STAGES + 1];
    for i in 0..STAGES {
        sums[i + 1] = sums[i] + slope[i] / STAGES as f64;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_conditions_of_order_hold_and_those_of_structure_hold_exactly() {
        let Coefficients { nodes, weights, couplings, .. } = Coefficients::new();
        for degree in 0..2 * STAGES {
            let power = |c: &f64| c.powi(degree as i32);
            let found: f64 = nodes.iter().zip(&weights).map(|(c, b)| b * power(c)).sum();
            assert!(
                (found - 1.0 / (degree + 1) as f64).abs() < 4.0 * f64::EPSILON,
                "{degree}: {:e}",
                found - 1.0 / (degree + 1) as f64
            );
        }
        for (i, c) in nodes.iter().enumerate() {
            for degree in 0..STAGES {
                let term =
                    |j: usize| (0.5 + couplings[i][j]) * weights[j] * nodes[j].powi(degree as i32);
                let found: f64 = (0..STAGES).map(term).sum();
                let expected = c.powi(degree as i32 + 1) / (degree + 1) as f64;
                assert!((found - expected).abs() < 4.0 * f64::EPSILON, "{i} {degree}");
            }
            for j in 0..STAGES {
                let (back_i, back_j) = (STAGES - 1 - i, STAGES - 1 - j);
                assert_eq!(couplings[i][j], -couplings[j][i]);
                assert_eq!(couplings[i][j], -couplings[back_i][back_j]);
            }
            assert_eq!(weights[i], weights[STAGES - 1 - i]);
        }
    }

    #[test]
    fn a_polynomial_is_continued_as_itself() {
        let coefficients = Coefficients::new();
        // u = x⁸, whose derivative is of the degree of the method.
        let increments = |from: f64, ratio: f64| -> [f64; STAGES] {
            std::array::from_fn(|i| {
                let x = from + ratio * coefficients.nodes[i];
                ratio * coefficients.weights[i] * 8.0 * x.powi(7)
            })
        };
        let here = increments(0.0, 1.0);
        for (from, ratio) in [(0.0, 0.3), (1.0, 1.0), (1.0, 0.5)] {
            let continued = coefficients.continuation(from, ratio).map(|row| dot(&row, &here));
            for (found, expected) in continued.iter().zip(increments(from, ratio)) {
                // Legendre polynomials of degree 7 reach 5e4 at the end of a doubled interval.
                assert!((found - expected).abs() < 1e-11, "{from} {ratio}: {found} {expected}");
            }
        }
        let bernstein = coefficients.bernstein(0.5, &here);
        for (i, c) in bernstein.iter().enumerate() {
            let expected = if i == STAGES { 1.5 } else { 0.5 };
            assert!((c - expected).abs() < 1e-13, "{i}: {c}");
        }
    }
}
