use nboom_scalar::Eight;

use super::{Curve, GaussLanes};
use crate::System;
use crate::gauss::coefficients::STAGES;
use crate::side_by_side::SideBySide;

/// Share of the time in which the slope changes the variables by what they are, after which the
/// slope is evaluated again.
const AHEAD: f64 = 0.01;

impl GaussLanes {
    /// A first step from the times in which the first and the second derivative change the variables
    /// by what they are; infinite where nothing moves.
    pub(super) fn first_step(&mut self, system: &mut dyn System) -> f64 {
        let slope = self.ends.start(system, &mut self.window);
        self.stages.states.derivative.copy_from_slice(slope);
        let size = self.norm(|i| self.window.magnitude(i));
        let by_slope = size / self.norm(|i| self.stages.states.derivative[i]);
        if !by_slope.is_finite() {
            return f64::INFINITY;
        }
        let ahead = AHEAD * by_slope;
        let Self { stages, window, ends, .. } = self;
        let SideBySide { argument, derivative, .. } = &mut stages.states;
        for i in 0..argument.len() {
            argument[i] = window.state[i] + ahead * derivative[i];
        }
        system.derivative(window.time + ahead, argument, derivative);
        window.counts.evaluations += 1;
        for (second, first) in derivative.iter_mut().zip(ends.start(system, window)) {
            *second = (*second - first) / ahead;
        }
        let by_curvature = (size / self.norm(|i| self.stages.states.derivative[i])).sqrt();
        by_slope.min(by_curvature) * size.powf(-0.5 / STAGES as f64)
    }

    /// Takes for the first guess that the derivative goes on changing as it does at the start, which the
    /// [first step](Self::first_step) has found out, if it could.
    pub(super) fn guess_straight(&mut self, system: &mut dyn System) {
        let length = self.window.next_step;
        if !(length.is_finite()
            && self.stages.states.derivative.iter().all(|change| change.is_finite()))
        {
            return;
        }
        let Self { stages, window, ends, known, collocation, .. } = self;
        let slopes = ends.start(system, window).iter().zip(&stages.states.derivative);
        for (known, (slope, change)) in known.iter_mut().zip(slopes) {
            *known = Eight(collocation.nodes.0.map(|c| length * (slope + c * length * change)));
        }
        self.curve = Curve { length, from: 0.0 };
    }
}
