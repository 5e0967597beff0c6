use super::Run;
use crate::events::situation::Situation;

/// The share of its fastest rate below which a hinge that locks is asked how far it would have gone. A faster one has
/// a hundredth of the energy left that carries it on.
const SLOW: f64 = 0.1;

impl Run<'_> {
    /// Notes how the hinges come that lock or hit stops in this instant, before it changes anything: how fast, and of
    /// slow ones that lock how far they would have gone.
    pub(super) fn note_closing(&mut self) {
        let Self { equations, situation, summary, .. } = self;
        let Situation { state, arrivals, .. } = &mut **situation;
        let verdict = &mut summary.verdict;
        for impact in arrivals.impacts() {
            verdict.note_impact(impact.hinge, state.tau[impact.hinge]);
        }
        if arrivals.locks().is_empty() {
            return;
        }
        for &hinge in arrivals.locks() {
            verdict.note_closing(hinge, state.tau[hinge]);
        }
        let is_slow =
            |&hinge: &usize| state.tau[hinge].abs() <= SLOW * verdict.hinges[hinge].largest_rate;
        if !arrivals.locks().iter().any(is_slow) {
            return;
        }
        equations.entered.dynamics.set_outside(state.attitude, state.time);
        let motion = state.motion(&equations.entered.dynamics);
        equations.accelerations(&motion);
        for &hinge in arrivals.locks() {
            if let Some(tau_dot) = equations.hinge_acceleration(hinge) {
                verdict.note_stopping(hinge, tau_dot);
            }
        }
    }
}
