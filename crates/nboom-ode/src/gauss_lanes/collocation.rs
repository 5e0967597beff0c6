use std::sync::OnceLock;

use nboom_scalar::{Eight, EightNumbers};

use crate::gauss::coefficients::{Coefficients, STAGES};
use crate::side_by_side::Columns;

/// Gauss's collocation method in terms of Kⱼ = h f(Yⱼ): Yᵢ = y + Σ aᵢⱼ Kⱼ.
#[derive(Clone, Debug)]
pub(super) struct Collocation {
    /// cᵢ on [0, 1].
    pub nodes: Eight,
    /// bᵢ.
    pub weights: Eight,
    /// bᵢ (1 − cᵢ), the weights of integrals of integrals.
    pub weights_twice: Eight,
    /// aᵢⱼ.
    pub stages: Columns<STAGES>,
    /// Its square.
    pub stages_twice: Columns<STAGES>,
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
        let stages = columns(&|i, j| 0.5 + couplings[i][j]);
        let entry = |i: usize, j: usize| (0..STAGES).map(|k| stages[k].0[i] * stages[j].0[k]).sum();
        Self {
            nodes: Eight(nodes),
            weights: Eight(weights),
            weights_twice: Eight(std::array::from_fn(|i| weights[i] * (1.0 - nodes[i]))),
            stages_twice: std::array::from_fn(|j| Eight(std::array::from_fn(|i| entry(i, j)))),
            stages,
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
    pub fn continuation<R: EightNumbers>(&self, from: f64, ratio: f64) -> [R; STAGES] {
        let number = R::constant;
        let at = R::load(&self.nodes).mul_add(number(2.0 * ratio), number(2.0 * from - 1.0));
        // `ratio` times two successive polynomials at all nodes.
        let (mut before, mut p) = (R::zero(), number(ratio));
        let mut columns = [R::zero(); STAGES];
        for k in 0..STAGES {
            for (column, spectrum) in columns.iter_mut().zip(&self.spectrum) {
                *column = p.mul_add(number(spectrum.0[k]), *column);
            }
            let n = k as f64;
            let [up, down] = [(2.0 * n + 1.0) / (n + 1.0), n / (n + 1.0)].map(number);
            (before, p) = (p, up * at * p - down * before);
        }
        columns
    }
}

/// The inner product, added in a fixed order.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
