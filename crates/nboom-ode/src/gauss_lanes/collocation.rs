use std::sync::OnceLock;

use nboom_scalar::Eight;

use crate::gauss::coefficients::{Coefficients, STAGES};

/// A matrix with a row for each stage, by its columns, so that a product goes over all rows at once.
pub(super) type Columns<const N: usize> = [Eight; N];

/// Gauss's collocation method in terms of Kⱼ = h f(Yⱼ): Yᵢ = y + Σ aᵢⱼ Kⱼ.
#[derive(Clone, Debug)]
pub(super) struct Collocation {
    /// cᵢ on [0, 1].
    nodes: Eight,
    /// bᵢ.
    pub weights: Eight,
    /// aᵢⱼ.
    pub stages: Columns<STAGES>,
    /// From K to the Legendre coefficients of h u̇, u the collocation polynomial.
    pub spectrum: Columns<STAGES>,
    /// From K to the last of these coefficients and to the one before.
    pub last_terms: [Eight; 2],
}

impl Collocation {
    /// The only one there is, computed once.
    pub fn of_eight_stages() -> &'static Self {
        static OF_EIGHT_STAGES: OnceLock<Collocation> = OnceLock::new();
        OF_EIGHT_STAGES.get_or_init(Self::new)
    }

    fn new() -> Self {
        let Coefficients { nodes, weights, couplings, spectrum, .. } = Coefficients::new();
        let columns = |of: &dyn Fn(usize, usize) -> f64| -> Columns<STAGES> {
            std::array::from_fn(|j| Eight(std::array::from_fn(|i| weights[j] * of(i, j))))
        };
        let spectrum = columns(&|i, j| spectrum[i][j]);
        let row = |i: usize| Eight(spectrum.map(|column| column.0[i]));
        Self {
            nodes: Eight(nodes),
            weights: Eight(weights),
            stages: columns(&|i, j| 0.5 + couplings[i][j]),
            last_terms: [row(STAGES - 1), row(STAGES - 2)],
            spectrum,
        }
    }

    /// Times of the stages of a step.
    pub fn times(&self, time: f64, step: f64) -> Eight {
        Eight(self.nodes.0.map(|c| time + c * step))
    }

    /// What turns the K of one step into those of the polynomial's continuation over another, which
    /// begins at the fraction `from` of it and is `ratio` times as long.
    #[inline(always)]
    pub fn continuation(&self, from: f64, ratio: f64) -> Columns<STAGES> {
        let at = self.nodes.0.map(|c| 2.0 * (from + ratio * c) - 1.0);
        // `ratio` times two successive polynomials at all nodes.
        let (mut before, mut p) = ([0.0; STAGES], [ratio; STAGES]);
        let mut columns = [Eight::default(); STAGES];
        for k in 0..STAGES {
            for (column, spectrum) in columns.iter_mut().zip(&self.spectrum) {
                for i in 0..STAGES {
                    column.0[i] += p[i] * spectrum.0[k];
                }
            }
            let n = k as f64;
            for i in 0..STAGES {
                let next = ((2.0 * n + 1.0) * at[i] * p[i] - n * before[i]) / (n + 1.0);
                (before[i], p[i]) = (p[i], next);
            }
        }
        columns
    }
}

/// The product of a matrix and a vector.
#[inline(always)]
pub(super) fn product<const N: usize>(columns: &Columns<N>, x: &[f64; N]) -> [f64; STAGES] {
    let mut sum = [0.0; STAGES];
    for (column, x) in columns.iter().zip(x) {
        for i in 0..STAGES {
            sum[i] += column.0[i] * x;
        }
    }
    sum
}

/// The inner product, added in a fixed order.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
