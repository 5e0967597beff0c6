use std::sync::Arc;

use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_elements::{Commands, OwnLaws, Reach};
use nboom_formulation::{Recognised, Seats, Uncovered, recognise};
use nboom_model::{Mode, Scene};
use nboom_ode::Pace;
use nboom_scalar::{Eight, Vec3};

use crate::code::fit::Repertoire;
use crate::code::right_side::RightSides;
use crate::code::selection::Selection;
use crate::code::{AccelerationCode, CodeError, under_own_laws};
use crate::equations::eight_states::{At, EightStates};
use crate::equations::jacobian::Jacobian;
use crate::equations::layout::{Unknowns, VariableLayout};
use crate::equations::rates::Rates;
use crate::equations::state::State;
use crate::options::Options;

/// What a mode needs that does not depend on how it is entered.
pub(crate) struct PreparedMode {
    pub mode: Mode,
    /// β of every hinge; those of held ones are built in.
    beta: Vec<f64>,
    /// What a control law acts on, for which not all code has a place.
    reach: Reach,
    pub dynamics: Recursive<f64>,
    /// What computes accelerations, once it has been chosen.
    code: AccelerationCode,
    /// What computes all rates of change, if something does.
    right_sides: Option<RightSides>,
    selection: Option<Selection>,
    /// The tree as it was recognised when code was chosen last, if it was.
    recognised: Option<(Recognised, Seats)>,
    /// Whether the code has the numbers of the mode, and not those of one of the same kind.
    is_fitted: bool,
    /// Made when an integrator asks for it.
    jacobian: Option<Jacobian>,
    /// Likewise; none where there are no registers for them.
    eight_states: Option<Option<EightStates>>,
}

/// How a mode was entered.
#[derive(Clone, Copy)]
pub(crate) struct Entry<'a> {
    /// The scene that it is a mode of.
    pub scene: &'a Scene,
    /// What it holds.
    pub commands: &'a Commands,
    /// The state in which it began.
    pub origin: &'a State,
}

impl PreparedMode {
    /// The mode of `satellite` in which held hinges are at `beta`, for what `commands` act on.
    pub fn new(
        mut dynamics: Recursive<f64>,
        satellite: &Arc<Scene>,
        mode: &Mode,
        commands: &Commands,
        beta: impl Fn(usize) -> f64,
    ) -> Self {
        let beta: Vec<f64> = (0..mode.hinges.len()).map(beta).collect();
        dynamics.set_scene(satellite, mode, &beta);
        Self {
            mode: mode.clone(),
            beta,
            reach: commands.reach(),
            dynamics,
            code: AccelerationCode::Recursion,
            right_sides: None,
            selection: None,
            recognised: None,
            is_fitted: false,
            jacobian: None,
            eight_states: None,
        }
    }

    /// Whether it is this mode of some satellite, for what `commands` act on.
    pub fn is_alike(&self, mode: &Mode, commands: &Commands) -> bool {
        self.mode == *mode && self.reach == commands.reach()
    }

    /// Makes it that of `satellite` with held hinges at `beta`, of which it [is one](Self::is_alike), in the
    /// room that it has.
    pub fn make(&mut self, satellite: &Arc<Scene>, beta: impl Fn(usize) -> f64) {
        let is_held_there = |i: usize| self.mode.is_free(i) || self.beta[i] == beta(i);
        if Arc::ptr_eq(self.dynamics.scene(), satellite) && (0..self.beta.len()).all(is_held_there)
        {
            return;
        }
        for (i, angle) in self.beta.iter_mut().enumerate() {
            *angle = beta(i);
        }
        self.dynamics.set_scene(satellite, &self.mode, &self.beta);
        self.is_fitted = false;
        (self.jacobian, self.eight_states) = (None, None);
    }

    /// Holds `commands`, which act on what it is [for](Self::is_alike), in place of those that it held.
    pub fn command(&mut self, commands: &Commands) {
        if self.reach == Reach::Nothing {
            return;
        }
        self.dynamics.command(commands);
        if let Some(jacobian) = &mut self.jacobian {
            jacobian.command(commands);
        }
        if let Some(Some(eight_states)) = &mut self.eight_states {
            eight_states.command(commands);
        }
    }

    /// Makes the rotors go on from `state`.
    pub fn spin_from(&mut self, state: &State) {
        if !state.rotors.is_empty() {
            let known = self.dynamics.tree().rotors.iter().map(|rotor| rotor.motion);
            // Their momentum is built into right sides, which have no place for one that changes.
            let goes_on = self.right_sides.is_none() || known.eq(state.rotors.iter().copied());
            let spun_up = self.dynamics.spins_up();
            self.dynamics.spin_from(state.time, state.rotors.iter().copied());
            if !goes_on || self.dynamics.spins_up() != spun_up {
                self.is_fitted = false;
            }
            if let Some(jacobian) = &mut self.jacobian {
                jacobian.spin_from(state);
            }
            if let Some(Some(eight_states)) = &mut self.eight_states {
                eight_states.spin_from(state);
            }
        }
    }

    /// Chooses the code that computes accelerations from the time `since` on, unless it was chosen
    /// before.
    ///
    /// # Errors
    /// When the code that is demanded does not fit.
    pub fn select(
        &mut self,
        scene: &Scene,
        own: &OwnLaws,
        repertoire: &mut Repertoire,
        options: &Options,
        since: f64,
    ) -> Result<Selection, CodeError> {
        if let (Some(known), true) = (&self.selection, self.is_fitted) {
            return Ok(Selection { since, ..known.clone() });
        }
        let found = self.recognise();
        let recognised = found.as_ref().map(|(recognised, _)| recognised).map_err(|&why| why);
        let same = self.selection.take().filter(|_| self.renew(recognised, repertoire));
        let chosen = match same {
            Some(same) => Selection { since, ..same },
            None => self.choose(scene, own, recognised, (repertoire, options), since)?,
        };
        self.recognised = found.ok();
        (self.selection, self.is_fitted) = (Some(chosen.clone()), true);
        Ok(chosen)
    }

    /// Writes the tree as chains, paddles and limbs.
    fn recognise(&mut self) -> Result<(Recognised, Seats), Uncovered> {
        let (tree, known) = (self.dynamics.tree(), self.recognised.take());
        if let Some((mut recognised, seats)) = known
            && recognised.renew(&seats, tree)
        {
            return Ok((recognised, seats));
        }
        let recognised = recognise(tree)?;
        let seats = Seats::of(&recognised, tree);
        Ok((recognised, seats))
    }

    /// Takes the numbers of another satellite to the code that was chosen before, if it would be chosen again;
    /// then the reason is the same, too.
    fn renew(
        &mut self,
        recognised: Result<&Recognised, Uncovered>,
        repertoire: &mut Repertoire,
    ) -> bool {
        let Self { dynamics, code, right_sides, reach, .. } = self;
        let (AccelerationCode::Generated(routine), Ok(recognised)) = (code, recognised) else {
            return false;
        };
        routine.renew(dynamics, recognised, repertoire)
            && match right_sides {
                Some(sides) => sides.renew(dynamics, recognised, repertoire),
                None => *reach != Reach::Nothing,
            }
    }

    fn choose(
        &mut self,
        scene: &Scene,
        own: &OwnLaws,
        recognised: Result<&Recognised, Uncovered>,
        (repertoire, options): (&mut Repertoire, &Options),
        since: f64,
    ) -> Result<Selection, CodeError> {
        let dynamics = &self.dynamics;
        let (code, mut selection) = if own.is_empty() {
            AccelerationCode::choose(scene, dynamics, recognised, repertoire, options, since)?
        } else {
            AccelerationCode::under_own_laws(own, since)
        };
        self.right_sides = None;
        if let (AccelerationCode::Generated(_), Ok(recognised)) = (&code, recognised) {
            // Hinge laws are built into right sides.
            if self.reach == Reach::Nothing {
                let batches = options.batches;
                self.right_sides = RightSides::fit(dynamics, recognised, repertoire, batches);
            }
            let told = match &self.right_sides {
                Some(sides) if sides.takes_eight() => "whole right side, also of eight states",
                Some(_) => "whole right side",
                None => "accelerations only",
            };
            selection.reason = format!("{}; {told}", selection.reason).into();
        }
        self.code = code;
        Ok(selection)
    }

    /// Notes that momenta are integrated from the time `since` on.
    pub fn select_momenta(&mut self, since: f64) -> Selection {
        let selection = self.selection.get_or_insert_with(|| Selection::of_momenta(since));
        Selection { since, ..selection.clone() }
    }

    /// Writes ẏ at `y` to `dy`, in the layout of `rates`; at `time` the velocity of what is
    /// [carried](crate::equations::variables::Variables::carried) is `carried`, inertial axes.
    pub fn rates(
        &mut self,
        rates: &mut Rates<f64>,
        (time, carried): (f64, Vec3<f64>),
        y: &[f64],
        dy: &mut [f64],
    ) {
        let Self { dynamics, code, right_sides, .. } = self;
        match right_sides {
            Some(right_sides) if rates.layout.unknowns == Unknowns::Velocities => {
                let power = right_sides.of_one.write(y, dy);
                rates.complete(dynamics, power, carried, y, dy);
            }
            _ => {
                let accelerate =
                    |dynamics: &mut Recursive<f64>, motion: &Motion<'_, f64>, out: &mut _| {
                        code.accelerations(dynamics, motion, out);
                    };
                rates.write(dynamics, accelerate, (time, carried), y, dy);
                if let (AccelerationCode::UnderOwnLaws(own), [work]) =
                    (code, &mut dy[rates.layout.dashpot_work()])
                {
                    let motion = [&y[rates.layout.beta()], &y[rates.layout.hinge_motion()]];
                    *work += own.power(dynamics.free_hinges(), motion);
                }
            }
        }
    }

    /// Whether there is code for eight states at once in `layout`.
    pub fn takes_eight(&self, layout: &VariableLayout) -> bool {
        match self.code {
            AccelerationCode::Recursion => true,
            AccelerationCode::Generated(_) => {
                let of_eight = self.right_sides.as_ref().is_some_and(RightSides::takes_eight);
                layout.unknowns == Unknowns::Velocities && of_eight
            }
            AccelerationCode::ClosedForm(_) | AccelerationCode::UnderOwnLaws(_) => false,
        }
    }

    /// What evaluations in `layout` cost.
    pub fn pace(&self, layout: &VariableLayout) -> Pace {
        let suits_lanes = self.right_sides.as_ref().is_some_and(RightSides::suits_lanes);
        match self.code {
            AccelerationCode::Recursion => Pace::SideBySide,
            AccelerationCode::Generated(_) if suits_lanes && self.takes_eight(layout) => {
                Pace::SideBySide
            }
            AccelerationCode::Generated(_) => Pace::Fast,
            AccelerationCode::ClosedForm(_) | AccelerationCode::UnderOwnLaws(_) => Pace::Slow,
        }
    }

    /// The right sides by which explicit steps are better taken beside those of other runs in `layout`, if
    /// there are such.
    pub fn side_by_side(&self, layout: &VariableLayout) -> Option<&RightSides> {
        let is_all = layout.unknowns == Unknowns::Velocities && !layout.thrust && !layout.held;
        self.right_sides.as_ref().filter(|right_sides| is_all && right_sides.suits_lanes())
    }

    /// Makes ready what [`rates_of_eight`](Self::rates_of_eight) needs in `layout`.
    pub fn prepare_eight(&mut self, entry: Entry<'_>, layout: &VariableLayout) {
        let has_right_side = self.right_sides.as_ref().is_some_and(RightSides::takes_eight);
        if !has_right_side || layout.thrust {
            self.eight_states(entry, layout);
        }
    }

    /// Writes ẏ of eight states to `dy`, if there is code for them in `layout`; returns whether
    /// there is. The mode was entered by `entry`.
    pub fn rates_of_eight(
        &mut self,
        entry: Entry<'_>,
        layout: &VariableLayout,
        at: At<'_>,
        dy: &mut [Eight],
    ) -> bool {
        if !self.takes_eight(layout) {
            return false;
        }
        let right_side = self.right_sides.as_mut().and_then(RightSides::of_eight);
        let power = right_side.map(|right_side| right_side.write(at.y, dy));
        match power {
            Some(power) if !layout.thrust => {
                if let [work] = &mut dy[layout.dashpot_work()] {
                    *work = power;
                }
                return true;
            }
            _ => {}
        }
        let Some(eight_states) = self.eight_states(entry, layout) else { return false };
        match power {
            Some(power) => eight_states.complete(*layout, &power, at, dy),
            None => eight_states.rates(*layout, at, dy),
        }
        true
    }

    /// The recursion on eight states, where there are registers for them.
    fn eight_states(
        &mut self,
        entry: Entry<'_>,
        layout: &VariableLayout,
    ) -> Option<&mut EightStates> {
        let Self { mode, dynamics, reach, eight_states, .. } = self;
        let made = eight_states.get_or_insert_with(|| {
            let mut made = EightStates::new(entry.scene, mode, dynamics, *layout);
            if let Some(made) = &mut made {
                if *reach != Reach::Nothing {
                    made.command(entry.commands);
                }
                made.spin_from(entry.origin);
            }
            made
        });
        made.as_mut()
    }

    /// Derivatives of the equations of the mode, which was entered by `entry`.
    pub fn jacobian(&mut self, entry: Entry<'_>) -> &mut Jacobian {
        let Entry { scene, commands, origin } = entry;
        let Self { mode, dynamics, reach, jacobian, .. } = self;
        jacobian.get_or_insert_with(|| {
            let mut jacobian = Jacobian::new(scene, mode, dynamics);
            if *reach != Reach::Nothing {
                jacobian.command(commands);
            }
            jacobian.spin_from(origin);
            jacobian
        })
    }

    /// Accelerations: ω̇, a_O without gravity, τ̇. Until code has been chosen they are those of the recursion, under the
    /// laws of the program's `own`, too.
    pub fn accelerations(
        &mut self,
        own: &OwnLaws,
        motion: &Motion<'_, f64>,
        out: &mut Accelerations<f64>,
    ) {
        let Self { dynamics, code, is_fitted, .. } = self;
        if *is_fitted {
            code.accelerations(dynamics, motion, out);
        } else {
            under_own_laws(own, dynamics, motion, out);
            dynamics.hold(out);
        }
    }
}
