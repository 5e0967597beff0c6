use crate::stepper::root_mean_square;
use crate::{System, Tolerance, Window};

/// Share of the time in which the slope changes the variables by what they are, after which it is evaluated again.
const AHEAD: f64 = 0.01;

/// How the variables begin to change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Onset {
    /// The shorter one of the times in which the first and the second derivative change them by what they are (Hairer,
    /// Nørsett, Wanner, Section II.4, who measure them in units of time).
    pub time: f64,
    /// What they are, in units of the error allowed.
    pub size: f64,
}

impl Onset {
    /// Finds it where the `slope` is known, by one evaluation; none where nothing moves. Errors are measured by `norm`.
    /// Writes the second derivative to the last room.
    pub fn find(
        system: &mut dyn System,
        window: &mut Window,
        slope: &[f64],
        [state, bend]: [&mut [f64]; 2],
        norm: impl Fn(&Window, &[f64]) -> f64,
    ) -> Option<Self> {
        for (i, state) in state.iter_mut().enumerate() {
            *state = window.magnitude(i);
        }
        let size = norm(window, state);
        let by_slope = size / norm(window, slope);
        if !by_slope.is_finite() {
            return None;
        }
        let ahead = AHEAD * by_slope;
        for (i, state) in state.iter_mut().enumerate() {
            *state = window.state[i] + ahead * slope[i];
        }
        system.derivative(window.time + ahead, state, bend);
        window.counts.evaluations += 1;
        for (bend, slope) in bend.iter_mut().zip(slope) {
            *bend = (*bend - slope) / ahead;
        }
        let by_bend = (size / norm(window, bend)).sqrt();
        Some(Self { time: by_slope.min(by_bend), size })
    }

    /// The step that errs by about this `share` of what is allowed, by a method whose error goes with the power 1/`exponent` of
    /// the step.
    pub fn step(self, share: f64, exponent: f64) -> f64 {
        self.time * (share / self.size).powf(exponent)
    }
}

/// The root mean square of the first `controlled` values, in units of what `tolerance` allows where a step starts.
pub(crate) fn in_units_of(
    tolerance: Tolerance,
    controlled: usize,
) -> impl Fn(&Window, &[f64]) -> f64 {
    move |window, values| {
        let allowed = |i| tolerance.allowed(window.sizes[i], window.state[i]);
        root_mean_square(controlled, |i| values[i] / allowed(i))
    }
}
