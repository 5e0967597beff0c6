use super::HIGHEST;
use super::differences::Differences;

/// |γ*ₖ|, the coefficients of the corrector's errors with constant steps, by order from 0 on; Σ γ*ⱼ/(k + 1 − j) over j up
/// to k is zero.
const ERRORS: [f64; HIGHEST + 1] = {
    let mut errors = [1.0; HIGHEST + 1];
    let mut k = 1;
    while k <= HIGHEST {
        let (mut sum, mut j) = (1.0 / (k + 1) as f64, 1);
        while j < k {
            sum -= errors[j] / (k + 1 - j) as f64;
            j += 1;
        }
        errors[k] = sum;
        k += 1;
    }
    errors
};

/// Adams' formulas for a step of one order and length.
#[derive(Clone, Debug, Default)]
pub(super) struct Formulas {
    pub order: usize,
    pub step: f64,
    /// β, which makes a difference over the last steps one over those before and the next one, row by row.
    pub carried: [f64; HIGHEST + 1],
    /// g: what each difference adds to the variables, in steps; the last one is the corrector's.
    pub weights: [f64; HIGHEST + 1],
    /// From the end of the step back to its start and those before.
    pub since: [f64; HIGHEST + 2],
    /// σ: how much larger errors are than with constant steps, by order.
    spread: [f64; HIGHEST + 2],
}

impl Formulas {
    /// Finds those of this order for a step of this length.
    pub fn prepare(&mut self, differences: &Differences, order: usize, step: f64) {
        (self.order, self.step) = (order, step);
        let before = differences.since();
        let mut shares = [0.0; HIGHEST + 2];
        (self.carried[0], self.spread[0]) = (1.0, 1.0);
        for j in 1..=order + 1 {
            self.since[j] = step + before[j - 1];
            shares[j] = step / self.since[j];
            self.spread[j] = self.spread[j - 1] * shares[j] * j as f64;
        }
        for j in 1..=order {
            let known = j < differences.rows();
            let ratio = if known { self.since[j] / before[j] } else { 0.0 };
            self.carried[j] = self.carried[j - 1] * ratio;
        }
        self.integrate(&shares);
    }

    /// Finds the weights: g of row j is the first of the repeated integrals of its polynomial, which follow from those
    /// of the row before.
    fn integrate(&mut self, shares: &[f64; HIGHEST + 2]) {
        let mut integrals = INTEGRALS;
        self.weights[..2].copy_from_slice(&[1.0, 0.5]);
        for j in 2..=self.order {
            for q in 0..=self.order - j {
                integrals[q] -= shares[j] * integrals[q + 1];
            }
            self.weights[j] = integrals[0];
        }
    }

    /// What the correction adds to the variables, in steps.
    pub fn last_weight(&self) -> f64 {
        self.weights[self.order]
    }

    /// What makes a correction the error by which a step is judged, that of its last correction.
    pub fn judged(&self) -> f64 {
        self.step.abs() * (self.weights[self.order - 1] - self.last_weight())
    }

    /// Error of a step of this order whose difference beyond it has this norm.
    pub fn error(&self, order: usize, norm: f64) -> f64 {
        self.step.abs() * ERRORS[order] * self.spread[order] * norm
    }
}

/// 1 / (q (q + 1)): the repeated integrals of the share of a step, over it.
const INTEGRALS: [f64; HIGHEST + 1] = {
    let mut integrals = [0.0; HIGHEST + 1];
    let mut q = 1;
    while q <= HIGHEST + 1 {
        integrals[q - 1] = 1.0 / (q * (q + 1)) as f64;
        q += 1;
    }
    integrals
};
