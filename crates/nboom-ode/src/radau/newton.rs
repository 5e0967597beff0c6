use faer::c64;

use super::coefficients::{C, COMPLEX, REAL, T, T_INVERSE, times};
use super::iteration_matrix::IterationMatrix;
use crate::{System, Window};

/// Iterations after which a step is tried shorter.
pub(super) const MOST: usize = 7;

/// Iterations until rounding is reached, at one binary digit each.
const SETTLING: usize = 52;

/// A contraction from which on there is no hope.
const HOPELESS: f64 = 0.99;

/// How an iteration ended.
pub(super) enum Outcome {
    /// After so many corrections.
    Converged(usize),
    /// It would take too many corrections; a step shorter by this factor would not.
    Slow(f64),
    /// It does not converge, or the derivative is not finite.
    Diverged,
}

/// The stages of a step, and the simplified Newton iteration for them in the variables
/// w = T⁻¹z, in which A⁻¹ is block diagonal.
#[derive(Clone, Debug, Default)]
pub(super) struct Stages {
    /// Stages less the step's start: z₁, z₂, z₃ of each variable.
    pub z: Vec<[f64; 3]>,
    w: Vec<[f64; 3]>,
    derivatives: [Vec<f64>; 3],
    /// Where the derivative was evaluated last.
    pub argument: Vec<f64>,
    of_real: Vec<f64>,
    of_complex: Vec<c64>,
    /// Ratio of the last two corrections.
    pub contraction: f64,
    /// Sum of all further corrections relative to the last one, as the contraction has it.
    tail: f64,
}

impl Stages {
    pub fn resize(&mut self, size: usize) {
        let zero = [0.0; 3];
        for buffer in [&mut self.z, &mut self.w] {
            buffer.clear();
            buffer.resize(size, zero);
        }
        let [first, second, third] = &mut self.derivatives;
        for buffer in [first, second, third, &mut self.argument, &mut self.of_real] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
        self.of_complex.clear();
        self.of_complex.resize(size, c64::default());
        (self.contraction, self.tail) = (0.0, 1.0);
    }

    /// Where the iteration begins.
    pub fn guess(&mut self, z_of: impl Fn(usize) -> [f64; 3]) {
        for i in 0..self.z.len() {
            self.z[i] = z_of(i);
            self.w[i] = times(&T_INVERSE, self.z[i]);
        }
    }

    /// Iterates until what is left to correct is below `goal` in units of `scales`.
    pub fn iterate(
        &mut self,
        system: &mut dyn System,
        matrix: &mut IterationMatrix,
        (window, step): (&mut Window, f64),
        (scales, goal): (&[f64], f64),
    ) -> Outcome {
        self.contraction = 0.0;
        self.tail = self.tail.max(f64::EPSILON).powf(0.8);
        let (mut last, mut last_ratio) = (0.0, 0.0);
        for count in 1..=MOST {
            let change = self.correction(system, matrix, window, step, scales);
            if !change.is_finite() {
                return Outcome::Diverged;
            }
            if count > 1 {
                let ratio = change / last;
                self.contraction = if count == 2 { ratio } else { f64::sqrt(ratio * last_ratio) };
                last_ratio = ratio;
                if self.contraction >= HOPELESS {
                    return Outcome::Diverged;
                }
                self.tail = self.contraction / (1.0 - self.contraction);
                let more = (MOST - count) as i32;
                let at_the_end = self.tail * change * self.contraction.powi(more - 1) / goal;
                if more > 0 && at_the_end >= 1.0 {
                    let order = f64::from(3 + more);
                    return Outcome::Slow(0.8 * at_the_end.clamp(1e-4, 20.0).powf(-1.0 / order));
                }
            }
            last = change.max(f64::EPSILON);
            self.correct();
            if self.tail * change <= goal {
                return Outcome::Converged(count);
            }
        }
        Outcome::Diverged
    }

    /// Iterates until corrections reach `rounding`, in units of `scales`, or shrink no more.
    pub fn settle(
        &mut self,
        system: &mut dyn System,
        matrix: &mut IterationMatrix,
        (window, step): (&mut Window, f64),
        (scales, rounding): (&[f64], f64),
    ) {
        let mut last = f64::INFINITY;
        for count in 1..=SETTLING {
            let change = self.correction(system, matrix, window, step, scales);
            if change.is_nan() || change >= last {
                return;
            }
            if count == 2 {
                self.contraction = change / last;
            }
            self.correct();
            if change <= rounding {
                return;
            }
            last = change;
        }
    }

    /// Computes the next correction of w; returns its root mean square.
    fn correction(
        &mut self,
        system: &mut dyn System,
        matrix: &mut IterationMatrix,
        window: &mut Window,
        step: f64,
        scales: &[f64],
    ) -> f64 {
        self.evaluate(system, window, step);
        let [first, second, third] = &self.derivatives;
        for (i, w) in self.w.iter().enumerate() {
            let f = times(&T_INVERSE, [first[i], second[i], third[i]]);
            self.of_real[i] = step * f[0] - REAL * w[0];
            self.of_complex[i] = step * c64::new(f[1], f[2]) - COMPLEX * c64::new(w[1], w[2]);
        }
        matrix.real.solve(&mut self.of_real);
        matrix.complex.solve(&mut self.of_complex);
        let corrections = self.of_real.iter().zip(&self.of_complex).zip(scales);
        let square =
            |((a, b), scale): ((&f64, &c64), &f64)| (a * a + b.norm_sqr()) / (scale * scale);
        let sum: f64 = corrections.map(square).sum();
        (sum / (3 * scales.len()).max(1) as f64).sqrt()
    }

    fn evaluate(&mut self, system: &mut dyn System, window: &mut Window, step: f64) {
        for (stage, derivative) in self.derivatives.iter_mut().enumerate() {
            for (out, (y, z)) in self.argument.iter_mut().zip(window.state.iter().zip(&self.z)) {
                *out = y + z[stage];
            }
            system.derivative(window.time + C[stage] * step, &self.argument, derivative);
        }
        window.counts.evaluations += 3;
    }

    fn correct(&mut self) {
        for (i, w) in self.w.iter_mut().enumerate() {
            w[0] += self.of_real[i];
            w[1] += self.of_complex[i].re;
            w[2] += self.of_complex[i].im;
            self.z[i] = times(&T, *w);
        }
    }

    /// Whether the derivatives of variable `i` are finite at all stages.
    pub fn is_finite(&self, i: usize) -> bool {
        self.derivatives.iter().all(|derivative| derivative[i].is_finite())
    }
}
