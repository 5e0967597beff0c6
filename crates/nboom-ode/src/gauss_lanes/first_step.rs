use nboom_scalar::Eight;

use super::{Curve, GaussLanes};
use crate::System;
use crate::first_step::Onset;
use crate::gauss::coefficients::STAGES;
use crate::side_by_side::SideBySide;
use crate::stepper::root_mean_square;

impl GaussLanes {
    /// A first step; infinite where nothing moves. Leaves the second derivative among the stages.
    pub(super) fn first_step(&mut self, system: &mut dyn System) -> f64 {
        let Self { ends, window, stages, per_tolerance, controlled, .. } = self;
        let slope = ends.start(system, window);
        let SideBySide { argument, derivative, .. } = &mut stages.states;
        let onset = Onset::find(system, window, slope, [argument, derivative], |_, values| {
            root_mean_square(*controlled, |i| values[i] * per_tolerance[i])
        });
        onset.map_or(f64::INFINITY, |onset| onset.step(1.0, 0.5 / STAGES as f64))
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
