use std::ops::Range;

use crate::method::Description;
use crate::{Bernstein, Choice, Method, StepError, Stepper, System, Tolerance, Window};

/// The row of [`Method`]'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "taylor",
    about: "Taylor series of an order that fits the tolerance, down to rounding",
    order: |tolerance| Taylor::order(tolerance) as u32,
    dense_order: |tolerance| Taylor::order(tolerance) as u32,
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Taylor::new(tolerance)),
};

/// The Taylor series method: the solution's power series about the start of each step, which is
/// also the dense output.
///
/// The order follows from the relative tolerance and the step from the last two coefficients
/// (Jorba and Zou 2005), so that no step is refused. It needs [`System::series`].
#[derive(Clone, Debug)]
pub struct Taylor {
    tolerance: Tolerance,
    order: usize,
    controlled: usize,
    window: Window,
    step: f64,
    /// Length of the step that dense output was prepared for.
    dense: f64,
    /// y⁽ᵏ⁾/k! at the start of the step, power by power.
    coefficients: Vec<f64>,
    /// Whether they belong to the start of the step.
    expanded: bool,
}

/// Orders from which and up to which it pays to fit the order to the tolerance; the highest is
/// that of [`Bernstein`], and leaves out less than rounding does.
const ORDERS: Range<usize> = 6..crate::bernstein::HIGHEST;

impl Taylor {
    /// The method for this tolerance.
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            order: Self::order(tolerance),
            controlled: 0,
            window: Window::default(),
            step: 0.0,
            dense: 0.0,
            coefficients: Vec::new(),
            expanded: false,
        }
    }

    /// The order for this tolerance: steps of e⁻² of the radius of convergence have the fewest
    /// operations per unit of time, and then the last term but one is as large as the tolerance.
    pub(crate) fn order(tolerance: Tolerance) -> usize {
        let order = (1.0 - 0.5 * tolerance.relative.ln()).ceil();
        order.clamp(ORDERS.start as f64, ORDERS.end as f64) as usize
    }

    fn size(&self) -> usize {
        self.window.state.len()
    }

    /// Coefficients of all variables for one power.
    fn of_power(&self, power: usize) -> &[f64] {
        &self.coefficients[power * self.size()..][..self.size()]
    }

    /// Finds the power series at the start of the step, unless it is there.
    fn expand(&mut self, system: &mut dyn System) -> Result<(), StepError> {
        if self.expanded {
            return Ok(());
        }
        let Window { time, state, counts, .. } = &mut self.window;
        if !system.series(*time, state, self.order, &mut self.coefficients) {
            return Err(StepError::NoSeries { time: *time });
        }
        counts.evaluations += 1;
        self.expanded = true;
        Ok(())
    }

    /// The step at whose end neither of the last two terms of a series of order `order` exceeds the
    /// error allowed, and somewhat less (Jorba and Zou 2005). `largest` has the largest coefficients
    /// of the last power and of the one before, in units of the error allowed.
    pub fn step_within(order: usize, largest: [f64; 2]) -> f64 {
        let [last, before] = largest;
        let reach = |size: f64, power: usize| size.recip().powf(1.0 / power as f64);
        let safety = (-0.7 / (order - 1) as f64).exp();
        safety * reach(last, order).min(reach(before, order - 1))
    }

    fn reach(&self) -> f64 {
        let largest = [self.order, self.order - 1].map(|power| self.largest(power));
        Self::step_within(self.order, largest)
    }

    /// The largest coefficient of a power, in units of the tolerance.
    fn largest(&self, power: usize) -> f64 {
        let sizes = self.of_power(power)[..self.controlled].iter().enumerate();
        sizes.map(|(i, c)| c.abs() / self.allowed(i)).fold(0.0, f64::max)
    }

    /// The error allowed in variable `i`.
    fn allowed(&self, i: usize) -> f64 {
        self.tolerance.allowed(self.window.sizes[i], self.window.state[i])
    }

    fn first_not_finite(&self) -> Option<usize> {
        let at = self.coefficients.iter().position(|c| !c.is_finite())?;
        Some(at % self.size())
    }

    /// Writes the variables `time` after the start of the step.
    fn evaluate(&self, time: f64, out: &mut [f64]) {
        out.copy_from_slice(self.of_power(self.order));
        for power in (0..self.order).rev() {
            for (out, c) in out.iter_mut().zip(self.of_power(power)) {
                *out = *out * time + c;
            }
        }
    }

    fn take(&mut self, step: f64) {
        let mut end = std::mem::take(&mut self.window.end_state);
        self.evaluate(step, &mut end);
        self.window.end_state = end;
        self.step = step;
    }
}

impl Stepper for Taylor {
    fn start(&mut self, system: &mut dyn System, t: f64, y: &[f64], controlled: usize) {
        self.controlled = controlled;
        self.window.start(system, t, y);
        self.coefficients.clear();
        self.coefficients.resize((self.order + 1) * y.len(), 0.0);
        self.expanded = false;
    }

    fn begin_step(
        &mut self,
        system: &mut dyn System,
        limit: f64,
    ) -> Result<Option<f64>, StepError> {
        self.window.measure(system);
        self.expand(system)?;
        let time = self.window.time;
        if let Some(variable) = self.first_not_finite() {
            return Err(StepError::NotFinite { time, variable });
        }
        let reach = self.reach();
        // Nothing is left out of what ends before the last two powers.
        let next = if reach.is_finite() { reach } else { limit - time };
        self.window.next_step = next.min(self.window.longest);
        let Some((step, reaches)) = self.window.attempt(limit) else {
            let error_of = |i| self.error_of(i);
            return Err(StepError::underflow(time, reach, 0..self.controlled, error_of));
        };
        self.take(step);
        let end = if reaches { limit } else { time + step };
        self.window.accept(end, reaches, self.window.next_step);
        Ok(None)
    }

    fn prepare_dense(&mut self, _system: &mut dyn System) {
        self.dense = self.step;
    }

    fn interpolate(&self, fraction: f64, out: &mut [f64]) {
        self.evaluate(fraction * self.dense, out);
    }

    fn polynomial(&self, i: usize) -> Bernstein {
        let mut terms = [0.0; crate::bernstein::HIGHEST + 1];
        let mut power_of_step = 1.0;
        for (power, term) in terms[..=self.order].iter_mut().enumerate() {
            *term = self.of_power(power)[i] * power_of_step;
            power_of_step *= self.dense;
        }
        Bernstein::of_powers(&terms[..=self.order])
    }

    fn retake(&mut self, system: &mut dyn System, step: f64) {
        if self.expand(system).is_err() {
            self.coefficients.fill(f64::NAN);
        }
        self.take(step);
        self.window.end_time = self.window.time + step;
    }

    fn advance(&mut self) {
        self.window.advance();
        self.expanded = false;
    }

    fn scale(&mut self, range: Range<usize>, factor: f64) {
        self.window.state[range].iter_mut().for_each(|y| *y *= factor);
        self.expanded = false;
    }

    fn window(&self) -> &Window {
        &self.window
    }

    fn window_mut(&mut self) -> &mut Window {
        &mut self.window
    }

    fn error_of(&self, i: usize) -> f64 {
        let before_last = self.step.abs().powi(self.order as i32 - 1);
        self.of_power(self.order)[i].abs() * before_last / self.allowed(i)
    }

    fn choice(&self) -> Choice {
        Choice::demanded(Method::Taylor)
    }

    fn last_evaluated(&self) -> &[f64] {
        &self.window.state
    }
}
