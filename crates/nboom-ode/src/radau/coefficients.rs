use faer::c64;
use nboom_scalar::Eight;

use crate::Method;
use crate::side_by_side::Columns;

/// A method of Radau IIA with an odd number of stages, and the variables in which A⁻¹, the inverse of
/// its matrix, is block diagonal: Hairer and Wanner, Solving Ordinary Differential Equations II,
/// 2nd ed., Section IV.8. One lane for each stage; the others are zero.
#[derive(Debug)]
pub(super) struct Coefficients {
    pub method: Method,
    pub stages: usize,
    /// cᵢ, times of the stages in steps.
    pub nodes: Eight,
    /// A, from the derivatives at the stages to what they add up to.
    pub integrals: Columns<8>,
    /// The real eigenvalue of A⁻¹.
    pub real: f64,
    /// One eigenvalue of each complex pair.
    pub pairs: &'static [c64],
    /// From those variables to stages: the real one, then two of each pair.
    pub to_stages: Columns<8>,
    /// The inverse.
    pub from_stages: Columns<8>,
    /// Weights of the stages in the error estimate, by which the collocation polynomial's slope at the
    /// start is taken off the true one.
    pub error: Eight,
    /// From stages to the terms of the collocation polynomial.
    pub terms: Columns<8>,
}

impl Coefficients {
    /// Corrections after which a step is tried shorter: as many as in the RADAU of Hairer and Wanner.
    pub fn most_corrections(&self) -> usize {
        7 + 5 * (self.stages - 3) / 2
    }

    /// One over the power of the step that the estimated error goes with.
    pub fn exponent(&self) -> f64 {
        1.0 / (self.stages + 1) as f64
    }
}

/// Numbers of stages in lanes.
pub(super) const fn lanes<const N: usize>(of_stages: [f64; N]) -> Eight {
    let mut lanes = [0.0; 8];
    let mut i = 0;
    while i < N {
        lanes[i] = of_stages[i];
        i += 1;
    }
    Eight(lanes)
}

/// The columns of a matrix, given by its rows.
pub(super) const fn matrix<const N: usize>(rows: [[f64; N]; N]) -> Columns<8> {
    let mut columns = [Eight([0.0; 8]); 8];
    let mut at = 0;
    while at < N * N {
        columns[at % N].0[at / N] = rows[at / N][at % N];
        at += 1;
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::radau::collocation::Collocation;
    use crate::radau::{order_5, order_9, order_13};

    fn all() -> [&'static Coefficients; 3] {
        [&order_5::COEFFICIENTS, &order_9::COEFFICIENTS, &order_13::COEFFICIENTS]
    }

    fn times(columns: &Columns<8>, x: [f64; 8]) -> [f64; 8] {
        std::array::from_fn(|i| (0..8).map(|j| columns[j].0[i] * x[j]).sum())
    }

    /// Rounding of sums whose terms are up to 200.
    fn assert_close(found: [f64; 8], expected: [f64; 8]) {
        let differences = found.iter().zip(expected).map(|(found, e)| (found - e).abs());
        assert!(differences.fold(0.0, f64::max) < 2e-13, "{found:?} {expected:?}");
    }

    #[test]
    fn the_matrix_integrates_every_polynomial_that_the_stages_carry() {
        for coefficients in all() {
            let nodes = coefficients.nodes.0;
            assert_eq!(nodes[coefficients.stages - 1], 1.0);
            for k in 1..=coefficients.stages as i32 {
                let carried = |c: &f64| if *c > 0.0 { c.powi(k - 1) } else { 0.0 };
                let found = times(&coefficients.integrals, nodes.map(|c| carried(&c)));
                assert_close(found, nodes.map(|c| c.powi(k) / f64::from(k)));
            }
            // The end is a quadrature of the highest order with one node at the end.
            for k in 1..2 * coefficients.stages as i32 {
                let found = times(&coefficients.integrals, nodes.map(|c| c.powi(k - 1)));
                if k > 1 {
                    let end = found[coefficients.stages - 1];
                    assert!((end - 1.0 / f64::from(k)).abs() < 1e-14, "{k}: {end}");
                }
            }
        }
    }

    #[test]
    fn combinations_make_the_inverse_block_diagonal() {
        for coefficients in all() {
            let stages = coefficients.stages;
            for j in 0..stages {
                let mut unit = [0.0; 8];
                unit[j] = 1.0;
                let back = times(&coefficients.from_stages, times(&coefficients.to_stages, unit));
                assert_close(back, unit);
                // A T Λ = T, column by column.
                let mut of_block = [0.0; 8];
                if j == 0 {
                    of_block[0] = coefficients.real;
                } else {
                    let pair = coefficients.pairs[(j - 1) / 2];
                    let first = j - (j - 1) % 2;
                    let (a, b) = if j == first { (pair.re, pair.im) } else { (-pair.im, pair.re) };
                    (of_block[first], of_block[first + 1]) = (a, b);
                }
                let scaled = times(&coefficients.to_stages, of_block);
                assert_close(times(&coefficients.integrals, scaled), coefficients.to_stages[j].0);
            }
        }
    }

    #[test]
    fn polynomials_are_followed_within_and_beyond_a_step() {
        for coefficients in all() {
            for k in 1..=coefficients.stages as i32 {
                let z = [Eight(coefficients.nodes.0.map(|c| c.powi(k)))];
                let mut curve = Collocation::default();
                curve.resize(1);
                curve.pass_through(coefficients, &z);
                for x in [0.0, 0.3, 0.7, 1.0, 1.5] {
                    let found = curve.at(0, x);
                    assert!((found - x.powi(k)).abs() < 2e-12, "{k} {x}: {found}");
                }
                let mut beyond = [Eight::default()];
                curve.continue_to(coefficients, 1.0, 0.5, &mut beyond);
                let expected = |c: f64| (1.0 + 0.5 * c).powi(k) - 1.0;
                let lanes = beyond[0].0.iter().zip(coefficients.nodes.0);
                assert!(lanes.clone().all(|(found, c)| (found - expected(c)).abs() < 2e-12));
                let slope = if k == 1 { -1.0 } else { 0.0 };
                assert!((coefficients.error.dot(&z[0]) - slope).abs() < 2e-14, "{k}");
            }
        }
    }
}
