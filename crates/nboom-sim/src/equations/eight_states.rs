use std::any::Any;

use nboom_dynamics::Recursive;
use nboom_elements::Commands;
use nboom_model::{Mode, RotorMotion, Scene};
use nboom_scalar::{Eight, EightNumbers, Vec3, WorkOnEight, in_vector_registers};

use crate::equations::layout::VariableLayout;
use crate::equations::rates::{ByRecursion, Rates};
use crate::equations::state::State;

/// The equations of one mode on eight states side by side: the recursion over numbers that fill the
/// registers of this processor.
pub(crate) struct EightStates {
    /// An [`OfMode`] over such numbers.
    of_mode: Box<dyn Any + Send + Sync>,
}

struct OfMode<R> {
    dynamics: Recursive<R>,
    rates: Rates<R>,
}

/// Where and when eight states are.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    pub times: &'a Eight,
    /// Velocity of what is [carried](crate::equations::variables::Variables::carried), inertial axes.
    pub carried: &'a Vec3<Eight>,
    pub y: &'a [Eight],
}

impl EightStates {
    /// Of `mode`, which is that of `dynamics`, with room for the variables of `layout`; none where there are no
    /// vector registers.
    pub fn new(
        scene: &Scene,
        mode: &Mode,
        dynamics: &Recursive<f64>,
        layout: VariableLayout,
    ) -> Option<Self> {
        let made = in_vector_registers(Make { scene, mode, dynamics, layout });
        made.ok().map(|of_mode| Self { of_mode })
    }

    /// Holds `commands` in place of those that they held.
    pub fn command(&mut self, commands: &Commands) {
        let _ = in_vector_registers(Command { eight: self, commands });
    }

    /// Makes the rotors go on from `state`.
    pub fn spin_from(&mut self, state: &State) {
        let _ = in_vector_registers(SpinFrom { eight: self, state });
    }

    /// Writes ẏ to `dy`, both as they stand in `layout`.
    pub fn rates(&mut self, layout: VariableLayout, at: At<'_>, dy: &mut [Eight]) {
        let _ = in_vector_registers(WriteRates { eight: self, layout, at, dy });
    }

    /// Writes what is left of ẏ where the rates of attitude, ω, β and τ stand in `dy` already
    /// ([`Rates::complete`]).
    pub fn complete(
        &mut self,
        layout: VariableLayout,
        power: &Eight,
        at: At<'_>,
        dy: &mut [Eight],
    ) {
        let _ = in_vector_registers(Complete { eight: self, layout, power, at, dy });
    }

    #[inline(always)]
    fn of_mode<R: EightNumbers>(&mut self) -> &mut OfMode<R> {
        self.of_mode.downcast_mut().expect("a processor has the same registers as before")
    }
}

impl At<'_> {
    #[inline(always)]
    fn time_and_carried<R: EightNumbers>(&self) -> (R, Vec3<R>) {
        let Vec3 { x, y, z } = self.carried;
        (R::load(self.times), Vec3::new(R::load(x), R::load(y), R::load(z)))
    }
}

struct Make<'a> {
    scene: &'a Scene,
    mode: &'a Mode,
    dynamics: &'a Recursive<f64>,
    layout: VariableLayout,
}

impl WorkOnEight for Make<'_> {
    type Output = Box<dyn Any + Send + Sync>;

    fn carry_out<R: EightNumbers>(self) -> Self::Output {
        let dynamics = self.dynamics.over::<R>(self.mode);
        let rates = Rates::new(self.scene, self.layout);
        Box::new(OfMode { dynamics, rates })
    }
}

struct Command<'a> {
    eight: &'a mut EightStates,
    commands: &'a Commands,
}

impl WorkOnEight for Command<'_> {
    type Output = ();

    fn carry_out<R: EightNumbers>(self) {
        self.eight.of_mode::<R>().dynamics.command(self.commands);
    }
}

struct SpinFrom<'a> {
    eight: &'a mut EightStates,
    state: &'a State,
}

impl WorkOnEight for SpinFrom<'_> {
    type Output = ();

    fn carry_out<R: EightNumbers>(self) {
        let motions = self.state.rotors.iter().map(RotorMotion::of_constant);
        let dynamics = &mut self.eight.of_mode::<R>().dynamics;
        dynamics.spin_from(R::constant(self.state.time), motions);
    }
}

struct WriteRates<'a> {
    eight: &'a mut EightStates,
    layout: VariableLayout,
    at: At<'a>,
    dy: &'a mut [Eight],
}

impl WorkOnEight for WriteRates<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { eight, layout, at, dy } = self;
        let OfMode { dynamics, rates } = eight.of_mode::<R>();
        rates.set_layout(layout);
        let (y, dy) = (R::all(at.y), R::all_mut(dy));
        rates.write(dynamics, ByRecursion, at.time_and_carried(), y, dy);
    }
}

struct Complete<'a> {
    eight: &'a mut EightStates,
    layout: VariableLayout,
    power: &'a Eight,
    at: At<'a>,
    dy: &'a mut [Eight],
}

impl WorkOnEight for Complete<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { eight, layout, power, at, dy } = self;
        let OfMode { dynamics, rates } = eight.of_mode::<R>();
        rates.set_layout(layout);
        let (y, dy) = (R::all(at.y), R::all_mut(dy));
        let (_, carried) = at.time_and_carried();
        rates.complete(dynamics, R::load(power), carried, y, dy);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::fixture::{SCENES, in_motion};
    use crate::options::Form;
    use nboom_formulation::Formulation;
    use nboom_ode::System;

    #[test]
    fn eight_states_are_what_each_would_be_alone() {
        for name in SCENES {
            for formulation in [None, Some(Form::Closed(Formulation::Momentum))] {
                each_is_as_alone(name, formulation);
            }
        }
    }

    fn each_is_as_alone(name: &str, formulation: Option<Form>) {
        let (mut equations, y) = in_motion(name, formulation);
        let layout = equations.variables.layout;
        let lane = |i: usize, lane: usize| y[i] + 0.05 * ((3 * lane + 7 * i) as f64).sin();
        let times = Eight(std::array::from_fn(|lane| 0.7 + 0.1 * lane as f64));
        let of_all = |i: usize| Eight(std::array::from_fn(|of| lane(i, of)));
        let eight: Vec<Eight> = (0..y.len()).map(of_all).collect();
        let carried = equations.variables.carried_at(&times);
        let Some(mut states) = EightStates::new(
            &equations.scene,
            &equations.entered.mode,
            &equations.entered.dynamics,
            layout,
        ) else {
            return;
        };
        states.spin_from(&equations.variables.origin);
        let mut found = vec![Eight::splat(f64::NAN); y.len()];
        states.rates(layout, At { times: &times, carried: &carried, y: &eight }, &mut found);
        for of in 0..8 {
            let one: Vec<f64> = (0..y.len()).map(|i| lane(i, of)).collect();
            let mut alone = vec![f64::NAN; y.len()];
            equations.derivative(times.0[of], &one, &mut alone);
            let scale = alone.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (i, (a, b)) in found.iter().zip(&alone).enumerate() {
                // Sines are from a polynomial here, from the mathematical library there.
                let close = (a.0[of] - b).abs() < 1e-12 * scale;
                assert!(close, "{name}: variable {i} of state {of}: {} {b}", a.0[of]);
            }
        }
    }
}
