//! Variables that vary together: a Gaussian copula.

use crate::distribution::{normal_probability, normal_score};
use crate::study::Correlation;

/// Makes independent uniform numbers correlated ones.
#[derive(Clone, Debug)]
pub(crate) struct Copula {
    /// Variables that are correlated with another, ascending.
    members: Vec<usize>,
    /// The lower Cholesky factor of their correlations, row by row.
    factor: Vec<Vec<f64>>,
}

/// Coefficients that no numbers can have together, between these variables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Contradiction {
    /// The variables up to the one whose correlations contradict the others.
    pub members: Vec<usize>,
}

impl Copula {
    /// # Errors
    /// When the matrix of the coefficients is not positive definite.
    pub fn new(correlations: &[Correlation]) -> Result<Self, Contradiction> {
        let mut members: Vec<usize> = correlations.iter().flat_map(|of| of.between).collect();
        members.sort_unstable();
        members.dedup();
        let coefficient = |i: usize, j: usize| {
            let is_pair = |of: &&Correlation| {
                of.between == [members[i], members[j]] || of.between == [members[j], members[i]]
            };
            correlations.iter().find(is_pair).map_or(0.0, |of| of.coefficient)
        };
        let mut factor: Vec<Vec<f64>> = Vec::new();
        for i in 0..members.len() {
            let mut row = Vec::with_capacity(i + 1);
            for j in 0..i {
                let known: f64 = row.iter().zip(&factor[j]).map(|(a, b)| a * b).sum();
                row.push((coefficient(i, j) - known) / factor[j][j]);
            }
            let left = 1.0 - row.iter().map(|a| a * a).sum::<f64>();
            // Rounding leaves something of what is singular.
            if left < 1e-12 {
                return Err(Contradiction { members: members[..=i].to_vec() });
            }
            row.push(left.sqrt());
            factor.push(row);
        }
        Ok(Self { members, factor })
    }

    /// Correlates uniform numbers, one of each variable; those of other variables stay as they are.
    pub fn correlate(&self, numbers: &mut [f64]) {
        let scores: Vec<f64> = self.members.iter().map(|&i| normal_score(numbers[i])).collect();
        for (&i, row) in self.members.iter().zip(&self.factor) {
            let score: f64 = row.iter().zip(&scores).map(|(a, b)| a * b).sum();
            numbers[i] =
                normal_probability(score).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::draw::Numbers;

    fn of(pairs: &[(usize, usize, f64)]) -> Vec<Correlation> {
        let one = |&(a, b, coefficient): &(usize, usize, f64)| Correlation {
            between: [a, b],
            coefficient,
        };
        pairs.iter().map(one).collect()
    }

    #[test]
    fn scores_have_the_coefficients() {
        let copula = Copula::new(&of(&[(0, 2, 0.8), (2, 3, -0.5)])).expect("possible");
        let count = 40_000;
        let mut sums = [[0.0; 4]; 4];
        for draw in 0..count {
            let mut numbers = Numbers::of_draw(1, draw).take(4);
            let alone = numbers[1];
            copula.correlate(&mut numbers);
            assert_eq!(numbers[1], alone);
            let scores: Vec<f64> = numbers.iter().map(|&u| normal_score(u)).collect();
            for i in 0..4 {
                for j in 0..4 {
                    sums[i][j] += scores[i] * scores[j] / count as f64;
                }
            }
        }
        let expected = [
            [1.0, 0.0, 0.8, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.8, 0.0, 1.0, -0.5],
            [0.0, 0.0, -0.5, 1.0],
        ];
        // Five standard deviations of a mean of products of two standard normal numbers.
        let allowed = 5.0 * (2.0 / count as f64).sqrt();
        for i in 0..4 {
            for j in 0..4 {
                assert!((sums[i][j] - expected[i][j]).abs() < allowed, "{i} {j} {}", sums[i][j]);
            }
        }
    }

    #[test]
    fn coefficients_that_contradict_each_other_are_refused() {
        let found = Copula::new(&of(&[(0, 1, 0.9), (1, 2, 0.9), (0, 2, -0.9)]));
        assert_eq!(found.expect_err("impossible").members, [0, 1, 2]);
    }
}
