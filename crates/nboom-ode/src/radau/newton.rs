use std::slice::{from_mut, from_ref};

use faer::c64;
use nboom_scalar::{Eight, EightNumbers, WorkOnEight, in_registers};

use super::coefficients::Coefficients;
use super::collocation::Collocation;
use super::iteration_matrix::IterationMatrix;
use crate::side_by_side::{SideBySide, Variables, load, multiply, product};
use crate::{System, Window};

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

/// The stages of a step side by side, and the simplified Newton iteration for them.
///
/// Unknowns are the variables whose derivatives are evaluated, in the combinations w of stages in which A⁻¹ is
/// block diagonal. Integrals of unknowns follow from them in each iteration, quadratures once they are found.
#[derive(Clone, Debug)]
pub(super) struct Stages {
    coefficients: &'static Coefficients,
    pub variables: Variables,
    /// Stages less the step's start, of each variable.
    pub z: Vec<Eight>,
    /// Those of unknowns; of other variables they are stale.
    w: Vec<Eight>,
    pub states: SideBySide,
    /// Right sides, then corrections, of each unknown.
    of_real: Vec<f64>,
    of_pairs: Vec<Vec<c64>>,
    /// Ratio of the last two corrections.
    pub contraction: f64,
    /// Sum of all further corrections relative to the last one, as the contraction has it.
    tail: f64,
    /// Whether derivatives are those at the last iterate.
    followed: bool,
}

/// The step whose stages are looked for.
pub(super) struct Attempt<'a> {
    pub window: &'a mut Window,
    pub step: f64,
    /// Error allowed in each controlled variable.
    pub scales: &'a [f64],
}

impl Stages {
    pub fn new(coefficients: &'static Coefficients) -> Self {
        Self {
            coefficients,
            variables: Variables::default(),
            z: Vec::new(),
            w: Vec::new(),
            states: SideBySide::default(),
            of_real: Vec::new(),
            of_pairs: vec![Vec::new(); coefficients.pairs.len()],
            contraction: 0.0,
            tail: 1.0,
            followed: false,
        }
    }

    pub fn start(&mut self, system: &dyn System, size: usize, controlled: usize) {
        self.variables.assign(system, size, controlled);
        self.states.resize(size);
        for buffer in [&mut self.z, &mut self.w] {
            buffer.clear();
            buffer.resize(size, Eight::default());
        }
        let unknowns = self.variables.evaluated.len();
        self.of_real.clear();
        self.of_real.resize(unknowns, 0.0);
        for of_pair in &mut self.of_pairs {
            of_pair.clear();
            of_pair.resize(unknowns, c64::default());
        }
        (self.contraction, self.tail, self.followed) = (0.0, 1.0, false);
    }

    /// Begins where nothing moves.
    pub fn guess_rest(&mut self) {
        self.followed = false;
        self.z.fill(Eight::default());
        self.w.fill(Eight::default());
    }

    /// Begins where polynomials lead from a fraction of their step, over `ratio` times its length.
    pub fn guess(&mut self, curves: &Collocation, from: f64, ratio: f64) {
        self.followed = false;
        curves.continue_to(self.coefficients, from, ratio, &mut self.z);
        multiply(&self.coefficients.from_stages, &self.z, &mut self.w);
    }

    /// Takes the next iteration to converge no better than it turns out to, as it does over a longer step.
    pub fn forget_contraction(&mut self) {
        self.tail = 1.0;
    }

    /// Iterates until what is left to correct is below `goal` in units of the scales.
    pub fn iterate(
        &mut self,
        system: &mut dyn System,
        matrix: &mut IterationMatrix,
        mut attempt: Attempt<'_>,
        goal: f64,
    ) -> Outcome {
        self.place(&attempt);
        self.contraction = 0.0;
        self.tail = self.tail.max(f64::EPSILON).powf(0.8);
        let most = self.coefficients.most_corrections();
        let (mut last, mut last_ratio) = (0.0, 0.0);
        for count in 1..=most {
            let change = self.correction(system, matrix, &mut attempt);
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
                let more = (most - count) as i32;
                let at_the_end = self.tail * change * self.contraction.powi(more - 1) / goal;
                if more > 0 && at_the_end >= 1.0 {
                    let order = f64::from(self.coefficients.stages as i32 + more);
                    return Outcome::Slow(0.8 * at_the_end.clamp(1e-4, 20.0).powf(-1.0 / order));
                }
            }
            last = change.max(f64::EPSILON);
            self.correct(&attempt);
            if self.tail * change <= goal {
                return Outcome::Converged(count);
            }
        }
        Outcome::Diverged
    }

    /// Iterates until corrections reach `rounding`, in units of the scales, or shrink no more.
    pub fn settle(
        &mut self,
        system: &mut dyn System,
        matrix: &mut IterationMatrix,
        mut attempt: Attempt<'_>,
        rounding: f64,
    ) {
        self.place(&attempt);
        let mut last = f64::INFINITY;
        for count in 1..=SETTLING {
            let change = self.correction(system, matrix, &mut attempt);
            if count <= 2 {
                self.contraction = change / last;
            }
            if change.is_nan() || change >= last {
                // The correction has taken the states' room.
                self.place(&attempt);
                break;
            }
            self.correct(&attempt);
            if change <= rounding {
                break;
            }
            last = change;
        }
        self.follow(system, &mut attempt);
    }

    /// Finds the stages of quadratures from the derivatives at the stages that were found. As unknowns they would get
    /// linear corrections, mostly a single one, and work goes with the square of rates.
    pub fn follow(&mut self, system: &mut dyn System, attempt: &mut Attempt<'_>) {
        if self.variables.quadratures.is_empty() {
            return;
        }
        self.evaluate(system, attempt);
        let Self { coefficients, variables, z, states, .. } = self;
        for &i in &variables.quadratures {
            let (rates, z) = (from_ref(&states.derivatives[i]), &mut z[i]);
            multiply(&coefficients.integrals, rates, from_mut(z));
            z.0.iter_mut().for_each(|z| *z *= attempt.step);
        }
        self.followed = true;
    }

    /// Writes the derivatives at the last stage, whose state is `end`; returns whether they are known, as after
    /// [`follow`](Self::follow).
    pub fn write_slope(&self, end: &[f64], slope: &mut [f64]) -> bool {
        let Self { coefficients, variables, states, .. } = self;
        for &i in variables.evaluated.iter().chain(&variables.quadratures) {
            slope[i] = states.derivatives[i].0[coefficients.stages - 1];
        }
        for &(i, rate) in &variables.integrals {
            slope[i] = end[rate];
        }
        self.followed
    }

    /// Computes the next correction of w; returns its root mean square.
    fn correction(
        &mut self,
        system: &mut dyn System,
        matrix: &mut IterationMatrix,
        attempt: &mut Attempt<'_>,
    ) -> f64 {
        self.evaluate(system, attempt);
        let Self { coefficients, variables, states, w, of_real, of_pairs, .. } = self;
        // The states have been evaluated and give room.
        let SideBySide { values: f, derivatives, .. } = states;
        multiply(&coefficients.from_stages, derivatives, f);
        let (step, scales) = (attempt.step, attempt.scales);
        let of_pair = |x: &Eight, k: usize| c64::new(x.0[2 * k + 1], x.0[2 * k + 2]);
        for (at, &i) in variables.evaluated.iter().enumerate() {
            of_real[at] = step * f[i].0[0] - coefficients.real * w[i].0[0];
            for (k, (pair, right)) in coefficients.pairs.iter().zip(&mut *of_pairs).enumerate() {
                right[at] = step * of_pair(&f[i], k) - *pair * of_pair(&w[i], k);
            }
        }
        matrix.real.solve(of_real);
        for (factors, right) in matrix.complex.iter_mut().zip(&mut *of_pairs) {
            factors.solve(right);
        }
        let mut sum = 0.0;
        for (at, (&i, integral)) in
            variables.evaluated.iter().zip(&variables.integral_of).enumerate()
        {
            if let Some(scale) = scales.get(i) {
                let of_pairs = of_pairs.iter().map(|of_pair| of_pair[at].norm_sqr());
                sum += (of_real[at] * of_real[at] + of_pairs.sum::<f64>()) / (scale * scale);
            }
            if let Some(scale) = integral.and_then(|integral| scales.get(integral)) {
                // An integral is corrected by h/λ times that.
                let pairs = coefficients.pairs.iter().zip(&*of_pairs);
                let of_pairs =
                    pairs.map(|(pair, of_pair)| of_pair[at].norm_sqr() / pair.norm_sqr());
                let of_real = (of_real[at] / coefficients.real).powi(2);
                sum += (step / scale).powi(2) * (of_real + of_pairs.sum::<f64>());
            }
        }
        let count = coefficients.stages * scales.len();
        (sum / count.max(1) as f64).sqrt()
    }

    /// Puts the integrals where the stages of their derivatives lead, and all states where the stages are.
    fn place(&mut self, attempt: &Attempt<'_>) {
        self.followed = false;
        let Self { coefficients, variables, z, states, .. } = self;
        let (start, step) = (&*attempt.window.state, attempt.step);
        in_registers(Place { coefficients, variables, start, step, z, values: &mut states.values });
    }

    fn evaluate(&mut self, system: &mut dyn System, attempt: &mut Attempt<'_>) {
        let Coefficients { nodes, stages, .. } = self.coefficients;
        let times = Eight(nodes.0.map(|c| attempt.window.time + c * attempt.step));
        self.states.evaluate(system, &times, *stages);
        attempt.window.counts.evaluations += stages;
    }

    fn correct(&mut self, attempt: &Attempt<'_>) {
        let Self { coefficients, variables, z, w, of_real, of_pairs, .. } = self;
        for (at, &i) in variables.evaluated.iter().enumerate() {
            let w = &mut w[i].0;
            w[0] += of_real[at];
            for (k, of_pair) in of_pairs.iter().enumerate() {
                w[2 * k + 1] += of_pair[at].re;
                w[2 * k + 2] += of_pair[at].im;
            }
        }
        // Those of integrals are placed next.
        multiply(&coefficients.to_stages, w, z);
        self.place(attempt);
    }

    /// Puts into the argument the first stage at which a derivative is not finite, else the last one; `start` is
    /// where the step begins.
    pub fn recall(&mut self, start: &[f64]) {
        let last = self.coefficients.stages - 1;
        let Self { variables, z, states: SideBySide { argument, derivatives, .. }, .. } = self;
        let is_broken = |stage: &usize| {
            variables.evaluated.iter().any(|&i| !derivatives[i].0[*stage].is_finite())
        };
        let stage = (0..last).find(is_broken).unwrap_or(last);
        for (out, (y, z)) in argument.iter_mut().zip(start.iter().zip(&*z)) {
            *out = y + z.0[stage];
        }
    }

    /// Whether the derivative of variable `i` is finite at all stages.
    pub fn is_finite(&self, i: usize) -> bool {
        let of_stages = &self.states.derivatives[i].0[..self.coefficients.stages];
        let is_integral = self.variables.integrals.iter().any(|&(integral, _)| integral == i);
        is_integral || of_stages.iter().all(|derivative| derivative.is_finite())
    }
}

/// Finds the stages of integrals, and the states at all stages.
struct Place<'a> {
    coefficients: &'a Coefficients,
    variables: &'a Variables,
    start: &'a [f64],
    step: f64,
    z: &'a mut [Eight],
    values: &'a mut [Eight],
}

impl WorkOnEight for Place<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { coefficients, variables, start, step, z, values } = self;
        let (matrix, step) = (load::<R, 8>(&coefficients.integrals), R::constant(step));
        let nodes = R::load(&coefficients.nodes);
        for &(i, rate) in &variables.integrals {
            let mean_rate = nodes.mul_add(R::constant(start[rate]), product(&matrix, &z[rate].0));
            (step * mean_rate).store(&mut z[i]);
        }
        for (value, (z, start)) in values.iter_mut().zip(z.iter().zip(start)) {
            (R::constant(*start) + R::load(z)).store(value);
        }
    }
}
