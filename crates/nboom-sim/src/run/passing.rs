//! The order in which a run goes through an instant.

use super::Run;
use crate::equations::Equations;
use crate::error::SimError;
use crate::events::situation::Situation;
use crate::run::finite;

impl Run<'_> {
    /// Goes through the present instant: what has arrived changes the motion and its mode, and integration starts
    /// anew.
    pub(super) fn pass_instant(&mut self) -> Result<(), SimError> {
        let is_first = self.situation.is_at_start(&self.equations.scene);
        let has_before = self.before_instant()?;
        self.note_closing();
        self.change_motion()?;
        self.enter_mode(is_first)?;
        self.check_regular()?;
        self.check_lines()?;
        self.select()?;
        self.start_integration(is_first);
        self.watch();
        let Situation { state, outcome, .. } = &*self.situation;
        finite::check_instant(&self.equations.scene, state.time, outcome)?;
        self.tell_instant(has_before)?;
        self.report()?;
        self.check_chatter()
    }

    /// Lets go what friction and stops hold, goes through impulses, releases and changes of force laws, and finds what
    /// sticks then.
    fn change_motion(&mut self) -> Result<(), SimError> {
        self.rest.loosen(self.equations, self.situation);
        let Equations { scene, entered, .. } = &mut *self.equations;
        self.situation.pass(scene, &mut entered.dynamics)?;
        // All hinges at rest are looked at together, after everything else.
        self.rest.find_sticking(self.equations, self.situation)
    }

    /// Enters the mode that the instant has made, and asks the control law there, which may make another.
    fn enter_mode(&mut self, is_first: bool) -> Result<(), SimError> {
        let Situation { state, mode, outcome, .. } = &mut *self.situation;
        // The mode in which a run begins is entered already.
        let goes_on = is_first && outcome.events.is_empty() && self.equations.is_in(mode);
        if !goes_on {
            // Until now nothing has been held by friction or a stop.
            if is_first && !self.rest.is_none() {
                self.equations.forget_sizes();
            }
            self.equations.enter(mode, state, self.variables);
        }
        if self.ask_control()? && !self.rest.is_none() {
            self.rest.find_sticking(self.equations, self.situation)?;
            let Situation { state, mode, .. } = &mut *self.situation;
            self.equations.enter(mode, state, self.variables);
        }
        // What sticks is told once, when commands, too, are known.
        self.rest.tell(self.equations, self.situation);
        Ok(())
    }

    /// Chooses the code for the mode, and notes when that is a change.
    fn select(&mut self) -> Result<(), SimError> {
        let selection = self.equations.select(&self.options);
        let selection =
            selection.map_err(|error| SimError::from_code(error, self.situation.state.time))?;
        self.count_evaluations();
        let selections = &mut self.summary.selections;
        if !selections.last().is_some_and(|last| last.is_same_code(&selection)) {
            selections.push(selection);
        }
        Ok(())
    }

    /// Starts integration in the mode that was entered, by the code that was chosen for it.
    fn start_integration(&mut self, is_first: bool) {
        let Self { situation, equations, stepper, variables, .. } = self;
        let (time, layout) = (situation.state.time, equations.variables.layout);
        if layout.has_momenta() {
            // Lock-ups and impacts leave momenta; rates follow from them and not from impulses.
            equations.read(time, variables, &mut situation.state);
            situation.forget_invariants();
        }
        if is_first {
            stepper.start(*equations, time, variables, layout.controlled());
        } else {
            stepper.restart(*equations, time, variables, layout.controlled());
        }
        self.attitude_norm.put_back();
        self.begins_anew = true;
    }

    /// Watches all that may end the mode.
    fn watch(&mut self) {
        let Equations { scene, entered, .. } = &*self.equations;
        self.situation.watch(scene, &entered.dynamics);
        let Situation { guards, state, .. } = &mut *self.situation;
        // The slopes at its beginning are the stepper's.
        guards.expect_from(self.equations, self.stepper, state);
    }
}
