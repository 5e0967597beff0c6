use super::coefficients::C;

/// The collocation polynomial of one variable over a step, less its value at the start:
/// x (c₀ + x̄ (c₁ + x c₂)), x the fraction of the step and x̄ = 1 − x.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Collocation {
    pub terms: [f64; 3],
}

impl Collocation {
    /// The one through the stages z.
    pub fn through(z: [f64; 3]) -> Self {
        let quotient = |i: usize| (z[i] / C[i] - z[2]) / (1.0 - C[i]);
        let slope = (quotient(1) - quotient(0)) / (C[1] - C[0]);
        Self { terms: [z[2], quotient(0) - C[0] * slope, slope] }
    }

    /// Its value at x, which may lie outside of the step.
    pub fn at(&self, x: f64) -> f64 {
        let [first, second, third] = self.terms;
        x * (first + (1.0 - x) * (second + x * third))
    }
}
