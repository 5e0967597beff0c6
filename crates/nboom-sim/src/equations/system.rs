use nboom_ode::{Pace, System};
use nboom_scalar::{Eight, Vec3};
use nboom_series::Series;

use crate::equations::eight_states::At;
use crate::equations::prepared_mode::Entry;
use crate::equations::{Equations, series};

impl System for Equations {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        let Self { variables, entered, rates, evaluations, .. } = self;
        *evaluations += usize::from(variables.layout.needs_elimination());
        // Without thrust nothing asks for it.
        let moves = variables.layout.thrust;
        let carried = if moves { variables.carried(t).velocity } else { Vec3::zero() };
        entered.rates(rates, (t, carried), y, dy);
    }

    fn derivatives(&mut self, times: &Eight, y: &[Eight], dy: &mut [Eight]) -> bool {
        let Self { scene, commands, variables, entered, evaluations, .. } = self;
        let carried = variables.carried_at(times);
        let at = At { times, carried: &carried, y };
        let entry = Entry { scene, commands, origin: &variables.origin };
        let in_lanes = entered.rates_of_eight(entry, &variables.layout, at, dy);
        *evaluations += if in_lanes { 8 } else { 0 };
        in_lanes
    }

    fn takes_eight(&mut self) -> bool {
        let Self { scene, commands, variables, entered, .. } = self;
        let takes = entered.takes_eight(&variables.layout);
        if takes {
            let entry = Entry { scene, commands, origin: &variables.origin };
            entered.prepare_eight(entry, &variables.layout);
        }
        takes
    }

    fn pace(&mut self) -> Pace {
        self.entered.pace(&self.variables.layout)
    }

    fn rate_of(&self, i: usize) -> Option<usize> {
        self.variables.layout.rate_of(i)
    }

    fn sizes(&mut self, y: &[f64], sizes: &mut [f64]) {
        let layout = self.variables.layout;
        if layout.has_momenta() {
            let motion = self.variables.motion(&mut self.entered.dynamics, y);
            self.sizes.saw_omega(&motion.omega_body.to_array());
            self.sizes.saw_tau(motion.tau);
        } else {
            self.sizes.saw_omega(&y[layout.omega()]);
            self.sizes.saw_tau(&y[layout.hinge_motion()]);
        }
        self.sizes.write(&layout, sizes);
    }

    fn jacobian(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> bool {
        if !self.own.is_empty() {
            return false;
        }
        let carried = self.variables.carried(t).velocity;
        let Self { scene, entered, commands, variables, .. } = self;
        let entry = Entry { scene, commands, origin: &variables.origin };
        entered.jacobian(entry).write(variables.layout, (t, carried), y, out);
        true
    }

    fn series(&mut self, t: f64, y: &[f64], order: usize, out: &mut [f64]) -> bool {
        self.evaluations += 1;
        self.series.take_if(|series| series.order() != order);
        let Self { scene, entered, commands, variables, .. } = self;
        let graph = || series::graph(scene, &entered.mode, commands, variables);
        let of_mode = || Series::new(&graph(), &[], order);
        self.series.get_or_insert_with(of_mode).write(t, y, out);
        true
    }
}
