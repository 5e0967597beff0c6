use super::HIGHEST;
use super::differences::Differences;
use super::formulas::Formulas;
use crate::Bernstein;

/// The polynomial of a step, of a degree that is its order: through its start, with the slopes at the ends of the steps
/// before, and the slope at its end where the predictor ends. It ends where the corrector does.
#[derive(Clone, Debug, Default)]
pub(super) struct Curve {
    step: f64,
    order: usize,
    /// Integrals, from the start of the step, of the polynomials that differences are multiplied by: coefficients of the
    /// powers of the share of the step, from the first one on.
    integrals: [[f64; HIGHEST + 1]; HIGHEST + 1],
    correction: Vec<f64>,
    is_there: bool,
}

impl Curve {
    /// Makes room for so many variables.
    pub fn start(&mut self, room: usize) {
        self.correction.clear();
        self.correction.resize(room, 0.0);
        self.is_there = false;
    }

    /// Finds that of a step by these formulas.
    pub fn prepare(&mut self, differences: &Differences, formulas: &Formulas, correction: &[f64]) {
        (self.step, self.order, self.is_there) = (formulas.step, formulas.order, true);
        self.correction.copy_from_slice(correction);
        self.integrals = polynomials(differences.since(), formulas);
        for (j, row) in self.integrals.iter_mut().enumerate() {
            // The correction is one over this step already.
            let carried = if j < self.order { formulas.carried[j] } else { 1.0 };
            for (m, coefficient) in row.iter_mut().enumerate() {
                *coefficient *= self.step * carried / (m + 1) as f64;
            }
        }
    }

    pub fn is_there(&self) -> bool {
        self.is_there
    }

    pub fn forget(&mut self) {
        self.is_there = false;
    }

    /// Length of the step.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The variables at this share of the step.
    pub fn interpolate(&self, of: &Differences, start: &[f64], fraction: f64, out: &mut [f64]) {
        let integral = |row: &[f64; HIGHEST + 1]| {
            row.iter().rev().fold(0.0, |sum, coefficient| (sum + coefficient) * fraction)
        };
        let weights = self.integrals.each_ref().map(integral);
        for (i, (out, start)) in out.iter_mut().zip(start).enumerate() {
            let change: f64 = (0..self.order).map(|j| weights[j] * of.of(j, i)).sum();
            *out = start + (change + weights[self.order] * self.correction[i]);
        }
    }

    /// Variable `i`, which starts at `start`.
    pub fn polynomial(&self, of: &Differences, start: f64, i: usize) -> Bernstein {
        let mut powers = [0.0; HIGHEST + 2];
        powers[0] = start;
        for (j, row) in self.integrals[..=self.order].iter().enumerate() {
            let value = if j < self.order { of.of(j, i) } else { self.correction[i] };
            for (power, coefficient) in powers[1..].iter_mut().zip(&row[..=j]) {
                *power += coefficient * value;
            }
        }
        Bernstein::of_powers(&powers[..self.order + 2])
    }
}

/// What the difference of each row is multiplied by where a share of the step is over: coefficients of powers of that
/// share, none of which is negative. `since` is from the start of the step back to those before.
fn polynomials(
    since: &[f64; HIGHEST + 2],
    formulas: &Formulas,
) -> [[f64; HIGHEST + 1]; HIGHEST + 1] {
    let mut found = [[0.0; HIGHEST + 1]; HIGHEST + 1];
    found[0][0] = 1.0;
    for j in 1..=formulas.order {
        let [constant, linear] = [since[j - 1], formulas.step].map(|x| x / formulas.since[j]);
        for m in 0..=j {
            let lower = if m > 0 { found[j - 1][m - 1] } else { 0.0 };
            found[j][m] = constant * found[j - 1][m] + linear * lower;
        }
    }
    found
}
