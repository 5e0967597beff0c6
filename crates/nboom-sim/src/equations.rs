use std::sync::{Arc, PoisonError};

use nboom_dynamics::{Accelerations, Motion, Recursive, Singularity};
use nboom_elements::{Commands, OwnLaws, friction_torques, gravity};
use nboom_model::{Mode, Scene};
use nboom_scalar::{Vec3, Wrench};
use nboom_series::Series;

use crate::code::closed_form::without_momenta;
use crate::code::fit::SharedRepertoire;
use crate::code::right_side::RightSides;
use crate::code::selection::Selection;
use crate::code::{CodeError, under_own_laws};
use crate::equations::layout::{Unknowns, VariableLayout};
use crate::equations::prepared_mode::PreparedMode;
use crate::equations::rates::Rates;
use crate::equations::sizes::{Sizes, balanced, reach};
use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::equations::variables::Variables;
use crate::options::Options;

pub(crate) mod at_rest;
pub(crate) mod attitude_norm;
pub(crate) mod eight_states;
#[cfg(test)]
mod fixture;
pub(crate) mod hold;
pub(crate) mod jacobian;
pub(crate) mod layout;
pub(crate) mod prepared_mode;
pub(crate) mod rates;
pub(crate) mod series;
pub(crate) mod sizes;
pub(crate) mod state;
pub(crate) mod totals;
pub(crate) mod variables;

mod system;

/// Modes that are kept beside the one entered. Few scenes have more, but springs that engage again
/// and again make any number.
const MOST_MODES: usize = 63;

/// Thousands of bytes, in a box, since modes change places at each event.
type Prepared = Box<PreparedMode>;

/// The differential equations of one mode, and the way from their variables to a [`State`].
pub(crate) struct Equations {
    pub scene: Arc<Scene>,
    /// A scene of the satellite that modes are prepared for, which differs in its initial state and its times
    /// alone.
    satellite: Arc<Scene>,
    /// The mode in which the scene starts.
    pub start: Mode,
    /// The mode that was entered last.
    pub entered: Prepared,
    /// Others that were entered, the last one last.
    others: Vec<Prepared>,
    /// Runs of one kind may share it.
    pub repertoire: SharedRepertoire,
    /// Hinge laws of the program's own.
    pub own: OwnLaws,
    /// What a control law commands; they act from the next time a mode is entered.
    pub commands: Commands,
    pub variables: Variables<f64>,
    gravity: Vec3<f64>,
    total_mass: f64,
    /// How far from O matter can be, about.
    pub reach: f64,
    /// Which hinged bodies turn without an effect on any other.
    is_balanced: Vec<bool>,
    accelerations: Accelerations<f64>,
    rates: Rates<f64>,
    /// Made when an integrator asks for it in the mode.
    series: Option<Series<f64>>,
    sizes: Sizes,
    /// What had no inertia when the mode was entered, if something had none.
    pub singularity: Option<Singularity>,
    /// Evaluations of accelerations, and series of them, that integration has asked for.
    evaluations: usize,
    /// Whether momenta are integrated.
    momenta: bool,
    /// Whether the angular momentum stands for the rate where nothing changes it.
    momentum_for_rate: bool,
    /// Whether explicit steps are taken in lanes.
    lanes: bool,
}

impl Equations {
    /// Those of `scene`, in the mode in which it starts, under hinge laws of the program's own as
    /// well, by the routines of `repertoire`, which are those that `options` allow.
    pub fn new(
        scene: &Scene,
        own: OwnLaws,
        repertoire: SharedRepertoire,
        options: &Options,
    ) -> Self {
        let layout = VariableLayout::of_no_hinges();
        // Bodies whose inertia turns otherwise than they do have no momenta.
        let is_rigid = scene.departures().turned.is_empty();
        let uses_momenta = is_rigid && without_momenta(scene).is_none();
        let state = State::initial(scene);
        let at_start = Mode::at_start(scene);
        let commands = Commands::none(scene);
        let shared = Arc::new(scene.clone());
        let dynamics = Recursive::of_scene(Arc::clone(&shared));
        let entered = PreparedMode::new(dynamics, &shared, &at_start, &commands, |i| state.beta[i]);
        Self {
            scene: Arc::clone(&shared),
            satellite: shared,
            entered: entered.into(),
            others: Vec::new(),
            repertoire,
            own,
            commands,
            variables: Variables::new(scene, &at_start, layout, &state),
            gravity: gravity(scene),
            total_mass: scene.total_mass(),
            reach: reach(scene),
            is_balanced: balanced(scene),
            start: at_start,
            accelerations: Accelerations::for_hinges(0),
            rates: Rates::new(scene, layout),
            series: None,
            sizes: Sizes::of(scene),
            singularity: None,
            evaluations: 0,
            momenta: uses_momenta && options.integrates_momenta(),
            momentum_for_rate: uses_momenta && options.integrator.keeps_invariants(),
            lanes: options.lanes,
        }
    }

    /// Takes another scene, whose satellite is that of all runs so far.
    pub fn set_scene(&mut self, scene: &Scene) {
        self.scene = Arc::new(scene.clone());
        self.start = Mode::at_start(scene);
    }

    /// Takes a scene of another satellite, which has as many of everything. Its modes take the places of those
    /// that are prepared.
    pub fn set_satellite(&mut self, scene: &Scene) {
        self.set_scene(scene);
        self.satellite = Arc::clone(&self.scene);
        self.gravity = gravity(scene);
        self.total_mass = scene.total_mass();
        self.reach = reach(scene);
        self.is_balanced = balanced(scene);
        self.rates = Rates::new(scene, self.variables.layout);
        self.sizes = Sizes::of(scene);
    }

    /// Begins anew in the mode in which the scene starts.
    pub fn begin(&mut self) {
        self.sizes.begin(&self.scene);
        self.evaluations = 0;
        self.commands.clear();
        let Self { scene, satellite, start, entered, others, commands, .. } = self;
        let angle = |i: usize| scene.bodies[i].hinge.start.angle;
        change_mode(entered, others, (satellite, start), commands, angle);
    }

    /// Whether `mode` is the one that was entered.
    pub fn is_in(&self, mode: &Mode) -> bool {
        self.entered.mode == *mode
    }

    /// Goes on from `state` in `mode`, under the commands; writes the variables to `y`.
    pub fn enter(&mut self, mode: &Mode, state: &mut State, y: &mut Vec<f64>) {
        let Self { entered, others, satellite, commands, own, .. } = self;
        change_mode(entered, others, (satellite, mode), commands, |i| state.beta[i]);
        state.spin_up(&self.scene, mode, Some(commands.rotor_accelerations()));
        entered.spin_from(state);
        let free = entered.dynamics.free_hinges();
        let of_elements = entered.dynamics.elements().has_rate_power(free);
        let dashpots = of_elements || free.iter().any(|&i| own.act_about(i));
        let mut layout = VariableLayout::of_velocities(&self.scene, &entered.dynamics, state);
        layout.unknowns = self.unknowns(state, layout.thrust);
        layout.dashpots = dashpots;
        self.accelerations.tau_dot.resize(layout.free, 0.0);
        self.rates.set_layout(layout);
        self.series = None;
        self.variables.begin(&self.scene, mode, layout, state);
        self.variables.write(&mut self.entered.dynamics, y);
        self.size_up(state);
    }

    /// The work of friction up to `state`, which is in the mode that was entered.
    pub fn friction_work(&self, state: &State) -> f64 {
        let (mode, since) = (&self.entered.mode, &self.variables.origin.beta);
        let torques = friction_torques(&self.scene, mode).filter(|&(i, _)| mode.is_free(i));
        let work = torques.map(|(i, torque)| torque * (state.beta[i] - since[i]));
        state.work.friction + work.sum::<f64>()
    }

    /// Enters the work of friction in `state`, where a mode begins in which it may act otherwise.
    pub fn book_friction(&mut self, state: &mut State) {
        state.work.friction = self.friction_work(state);
        self.variables.origin.beta.copy_from_slice(&state.beta);
    }

    /// Goes to `mode` at `state`, which does not begin there.
    pub fn go_to(&mut self, mode: &Mode, state: &State) {
        let Self { entered, others, satellite, commands, .. } = self;
        change_mode(entered, others, (satellite, mode), commands, |i| state.beta[i]);
        entered.spin_from(state);
    }

    /// Forgets how fast the motion was, where it has not begun yet.
    pub fn forget_sizes(&mut self) {
        self.sizes.begin(&self.scene);
    }

    /// What is integrated for rates in a mode that begins at `state`.
    fn unknowns(&mut self, state: &mut State, thrust: bool) -> Unknowns {
        // Springs, dashpots and uniform gravity exert no moment about the mass centre.
        if !self.momenta && (thrust || !self.momentum_for_rate) {
            return Unknowns::Velocities;
        }
        let angular = state.momenta.angular_inertial.unwrap_or_else(|| {
            let found = state.invariants(&mut self.entered.dynamics);
            Totals::of(state, &found).angular_momentum_inertial
        });
        if self.momenta { Unknowns::Momenta(angular) } else { Unknowns::HingeRates(angular) }
    }

    /// Notes how fast `state` is, and how fast it soon will be.
    fn size_up(&mut self, state: &mut State) {
        self.entered.dynamics.set_outside(state.attitude, state.time);
        let motion = state.motion(&self.entered.dynamics);
        self.sizes.enter(self.entered.dynamics.free_hinges());
        self.sizes.saw_omega(&motion.omega_body.to_array());
        self.sizes.saw_tau(motion.tau);
        let Self { entered, own, accelerations, .. } = self;
        under_own_laws(own, &mut entered.dynamics, &motion, accelerations);
        self.singularity = entered.dynamics.singularity_as_computed();
        let Accelerations { omega_dot_body, tau_dot, .. } = &self.accelerations;
        let force = self.entered.dynamics.outside_force(motion.beta);
        let linear = force.unwrap_or(Vec3::zero()) * (1.0 / self.total_mass);
        self.sizes.saw_accelerations(*omega_dot_body, tau_dot, linear);
        let has_momenta = self.variables.layout.has_momenta();
        self.sizes
            .weigh(has_momenta.then(|| self.entered.dynamics.effective_inertias(motion.beta)));
    }

    /// The state that the variables `y` at time `t` stand for.
    pub fn read(&mut self, t: f64, y: &[f64], state: &mut State) {
        self.variables.read(&mut self.entered.dynamics, t, y, state);
    }

    /// Chooses the code that computes accelerations in the mode that was entered.
    ///
    /// # Errors
    /// When the code that is demanded does not fit.
    pub fn select(&mut self, options: &Options) -> Result<Selection, CodeError> {
        let Self { scene, entered, own, repertoire, variables, .. } = self;
        let since = variables.origin.time;
        if variables.layout.has_momenta() {
            return Ok(entered.select_momenta(since));
        }
        let mut repertoire = repertoire.lock().unwrap_or_else(PoisonError::into_inner);
        entered.select(scene, own, &mut repertoire, options, since)
    }

    /// Accelerations without gravity in the mode that was entered, under what [acts from
    /// outside](Recursive::set_outside).
    pub fn accelerations(&mut self, motion: &Motion<'_, f64>) -> &Accelerations<f64> {
        self.entered.accelerations(&self.own, motion, &mut self.accelerations);
        &self.accelerations
    }

    /// τ̇ of a hinge as computed last; none of one that is not free.
    pub fn hinge_acceleration(&self, hinge: usize) -> Option<f64> {
        let position = self.entered.dynamics.position_of(hinge);
        position.map(|position| self.accelerations.tau_dot[position])
    }

    /// Writes β, τ and τ̇ of the free hinges, τ̇ as computed last, among those of all hinges.
    pub fn spread(&self, motion: &Motion<'_, f64>, all: [&mut [f64]; 3]) {
        let [beta, tau, tau_dot] = all;
        for (j, &i) in self.entered.dynamics.free_hinges().iter().enumerate() {
            beta[i] = motion.beta[j];
            tau[i] = motion.tau[j];
            tau_dot[i] = self.accelerations.tau_dot[j];
        }
    }

    /// The acceleration of the mass centre, inertial axes, under what [acts from
    /// outside](Recursive::set_outside) and the `reaction` of what holds the main body.
    pub fn center_acceleration(
        &mut self,
        state: &mut State,
        reaction: Option<Wrench<f64>>,
    ) -> Vec3<f64> {
        let beta = state.motion(&self.entered.dynamics).beta;
        let outside = self.entered.dynamics.outside_force(beta).unwrap_or(Vec3::zero());
        let force = outside + reaction.map_or(Vec3::zero(), |reaction| reaction.force);
        self.gravity + state.attitude.to_matrix() * force * (1.0 / self.total_mass)
    }

    /// What holds the main body exerts on it at O, main-body axes, in a motion with the
    /// accelerations computed last; none where nothing holds it.
    pub fn reaction(&mut self, motion: &Motion<'_, f64>) -> Option<Wrench<f64>> {
        let Self { scene, entered, accelerations, .. } = self;
        let held = scene.base.is_held();
        held.then(|| entered.dynamics.reaction(motion, accelerations))
    }

    /// Sets `out` to the torques of the motors of all rotors in a motion with the accelerations
    /// computed last.
    pub fn motor_torques(&mut self, motion: &Motion<'_, f64>, out: &mut Vec<f64>) {
        self.entered.dynamics.motor_torques(motion, &self.accelerations, out);
    }

    /// The right sides of the mode by which explicit steps are taken in lanes, and the layout of the variables;
    /// none where they are taken alone.
    pub fn in_lanes(&self) -> Option<(&RightSides, &VariableLayout)> {
        let layout = &self.variables.layout;
        let right_sides = self.entered.side_by_side(layout).filter(|_| self.lanes);
        right_sides.map(|right_sides| (right_sides, layout))
    }

    /// Counts evaluations for a step in lanes.
    pub fn count(&mut self, evaluations: usize) {
        self.evaluations += evaluations;
    }

    /// The largest rate so far.
    pub fn fastest(&self) -> f64 {
        self.sizes.rate()
    }

    /// Evaluations of accelerations, and series of them, that integration has asked for.
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// Uniform gravity as an acceleration, inertial axes.
    pub fn gravity(&self) -> Vec3<f64> {
        self.gravity
    }
}

/// Makes that `entered` which is prepared for this mode of this satellite with held hinges at `beta`, one of the
/// `others` if it is among them, and holds `commands` there.
fn change_mode(
    entered: &mut Prepared,
    others: &mut Vec<Prepared>,
    (satellite, mode): (&Arc<Scene>, &Mode),
    commands: &Commands,
    beta: impl Fn(usize) -> f64 + Copy,
) {
    let is_it = |prepared: &PreparedMode| prepared.is_alike(mode, commands);
    if !is_it(entered) {
        let next = match others.iter().position(|prepared| is_it(prepared)) {
            Some(at) => others.remove(at),
            None => {
                let dynamics = entered.dynamics.clone();
                PreparedMode::new(dynamics, satellite, mode, commands, beta).into()
            }
        };
        if others.len() == MOST_MODES {
            others.remove(0);
        }
        others.push(std::mem::replace(entered, next));
    }
    entered.make(satellite, beta);
    entered.command(commands);
}
