//! Control laws of a program's own.

use std::fmt;

use nboom_elements::Commands;

use super::Run;
use crate::error::SimError;
use crate::events::situation::Situation;
use crate::options::OptionError;
use crate::run::finite::Check;
use crate::run::record::Snapshot;

/// A control law that is asked at regular times; what it commands is held from one to the next.
///
/// Certificates ([`trust`](crate::trust())) are of runs without one.
pub struct Control<'a> {
    /// Time between two samples \[T\]; the first is at the initial time.
    pub period: f64,
    /// Sees the motion after all events of the instant, and changes the commands. They begin with
    /// nothing.
    pub law: &'a mut dyn FnMut(&Snapshot, &mut Commands),
}

impl fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Control").field("period", &self.period).finish_non_exhaustive()
    }
}

/// A control law, and how often it was asked.
pub(super) struct Sampling<'a> {
    control: Control<'a>,
    samples: usize,
}

impl<'a> Sampling<'a> {
    pub fn new(control: Control<'a>) -> Self {
        Self { control, samples: 0 }
    }
}

impl Run<'_> {
    /// Refuses a period with which no run comes to its end in the steps that are allowed.
    pub(super) fn check_period(&self) -> Result<(), OptionError> {
        let Some(Sampling { control: Control { period, .. }, .. }) = &self.sampling else {
            return Ok(());
        };
        let scene = &self.equations.scene;
        let span = scene.end_time - scene.initial.time;
        let reaches = period.is_finite() && span <= period * self.options.max_steps as f64;
        let (option, value) = ("sample period", *period);
        let expected = "a finite one that reaches the end in the steps that are allowed";
        if reaches && value > 0.0 { Ok(()) } else { Err(OptionError { option, value, expected }) }
    }

    /// Asks the control law, if it is due in this instant, and goes on with what it commands; the
    /// mode has been entered. Returns whether it was asked.
    pub(super) fn ask_control(&mut self) -> Result<bool, SimError> {
        let is_over = self.situation.is_at_end(&self.equations.scene);
        if is_over || self.sampling.is_none() || !self.situation.is_sampled() {
            return Ok(false);
        }
        let found = self.show_present();
        self.see(&found, false, None)?;
        let Self { equations, situation, sampling, seen, ledger, variables, .. } = self;
        let Some(Sampling { control, samples }) = sampling else { return Ok(false) };
        (control.law)(seen, &mut equations.commands);
        if !equations.commands.are_for(&equations.scene) {
            equations.commands = Commands::none(&equations.scene);
            return Err(SimError::OtherCommands { time: seen.time });
        }
        let Commands { main_body, .. } = &equations.commands;
        let check = Check { scene: &equations.scene, time: seen.time };
        let torques = equations.commands.hinge_torques();
        let first = torques.iter().position(|torque| !torque.is_finite());
        check.of(first, "commanded torque", first.is_none())?;
        let rotors = equations.commands.rotor_accelerations();
        let are_finite = rotors.iter().all(|acceleration| acceleration.is_finite());
        check.of(None, "commanded acceleration of a rotor", are_finite)?;
        let is_finite = main_body.force.is_finite() && main_body.moment.is_finite();
        check.of(None, "commanded wrench", is_finite)?;
        let Situation { state, mode, .. } = &mut **situation;
        ledger.set_aside(equations, state);
        equations.book_friction(state);
        equations.enter(mode, state, variables);
        ledger.take_up(equations, state);
        while situation.is_sampled() {
            *samples += 1;
            let start = equations.scene.initial.time;
            situation.sample_at(start + *samples as f64 * control.period);
        }
        Ok(true)
    }
}
