use nboom_scalar::{Eight, EightNumbers, Real, WorkOnEight, in_registers};

use super::coefficients::Coefficients;
use crate::side_by_side::multiply;

/// The collocation polynomials of a step, less their values at the start: of each variable the terms of
/// x (c₀ + x̄ (c₁ + x (c₂ + x̄ (…)))), x the fraction of the step and x̄ = 1 − x.
#[derive(Clone, Debug, Default)]
pub(super) struct Collocation {
    pub terms: Vec<Eight>,
}

impl Collocation {
    pub fn resize(&mut self, size: usize) {
        self.terms.clear();
        self.terms.resize(size, Eight::default());
    }

    /// Takes those through the stages z.
    pub fn pass_through(&mut self, coefficients: &Coefficients, z: &[Eight]) {
        multiply(&coefficients.terms, z, &mut self.terms);
    }

    /// The value of variable `i` at x.
    pub fn at(&self, i: usize, x: f64) -> f64 {
        at(&self.terms[i], x)
    }

    /// Writes to `z` where the polynomials lead from the fraction `from` of their step, over `ratio` times
    /// its length.
    pub fn continue_to(&self, coefficients: &Coefficients, from: f64, ratio: f64, z: &mut [Eight]) {
        in_registers(Continue { coefficients, terms: &self.terms, from, ratio, z });
    }
}

struct Continue<'a> {
    coefficients: &'a Coefficients,
    terms: &'a [Eight],
    from: f64,
    ratio: f64,
    z: &'a mut [Eight],
}

impl WorkOnEight for Continue<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let from = R::constant(self.from);
        let to = R::load(&self.coefficients.nodes).mul_add(R::constant(self.ratio), from);
        for (z, terms) in self.z.iter_mut().zip(self.terms) {
            (at(terms, to) - at(terms, from)).store(z);
        }
    }
}

/// The value at x of the polynomial with these terms.
#[inline(always)]
fn at<R: Real>(terms: &Eight, x: R) -> R {
    let (rest, mut inner) = (R::one() - x, R::zero());
    for pair in terms.0.chunks_exact(2).rev() {
        inner = rest * (R::constant(pair[1]) + inner);
        inner = x * (R::constant(pair[0]) + inner);
    }
    inner
}
