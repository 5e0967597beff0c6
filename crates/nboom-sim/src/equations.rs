use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_elements::gravity;
use nboom_model::{Mode, Scene};
use nboom_ode::System;
use nboom_scalar::Vec3;
use nboom_series::Series;

use crate::code::fit::Repertoire;
use crate::code::selection::Selection;
use crate::code::{AccelerationCode, CodeError};
use crate::equations::jacobian::Jacobian;
use crate::equations::layout::{Unknowns, VariableLayout};
use crate::equations::rates::Rates;
use crate::equations::sizes::Sizes;
use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::equations::variables::Variables;
use crate::options::Options;

pub(crate) mod attitude_norm;
pub(crate) mod jacobian;
pub(crate) mod layout;
pub(crate) mod rates;
pub(crate) mod series;
pub(crate) mod sizes;
pub(crate) mod state;
pub(crate) mod totals;
pub(crate) mod variables;

/// The differential equations of one mode, and the way from their variables to a [`State`].
pub(crate) struct Equations {
    scene: Scene,
    mode: Mode,
    pub dynamics: Recursive<f64>,
    /// What computes the accelerations of the mode.
    code: AccelerationCode,
    repertoire: Repertoire,
    pub variables: Variables<f64>,
    gravity: Vec3<f64>,
    total_mass: f64,
    accelerations: Accelerations<f64>,
    rates: Rates<f64>,
    /// Made when an integrator asks for it in the mode.
    jacobian: Option<Jacobian>,
    /// The same.
    series: Option<Series<f64>>,
    sizes: Sizes,
    /// Evaluations of accelerations, and series of them, that integration has asked for.
    evaluations: usize,
    /// Whether momenta are integrated.
    momenta: bool,
    /// Whether the angular momentum stands for the rate where nothing changes it.
    momentum_for_rate: bool,
}

impl Equations {
    pub fn new(scene: &Scene, state: &State, options: &Options) -> Self {
        let layout = VariableLayout {
            unknowns: Unknowns::Velocities,
            free: 0,
            thrust: false,
            dashpots: false,
        };
        // Bodies whose inertia turns otherwise than they do have no momenta.
        let rigid = scene.departures().turned.is_empty();
        Self {
            scene: scene.clone(),
            mode: Mode::at_start(scene),
            dynamics: Recursive::new(scene),
            code: AccelerationCode::Recursion,
            repertoire: Repertoire::new(options),
            variables: Variables::new(scene, layout, state),
            gravity: gravity(scene),
            total_mass: scene.total_mass(),
            accelerations: Accelerations::for_hinges(0),
            rates: Rates::new(scene, layout),
            jacobian: None,
            series: None,
            sizes: Sizes::of(scene),
            evaluations: 0,
            momenta: rigid && options.integrates_momenta(),
            momentum_for_rate: rigid && options.integrator.keeps_invariants(),
        }
    }

    /// Goes on from `state` in `mode`; writes the variables to `y`.
    pub fn enter(&mut self, scene: &Scene, mode: &Mode, state: &State, y: &mut Vec<f64>) {
        self.mode.clone_from(mode);
        self.dynamics.set_mode(mode, &state.beta);
        let elements = self.dynamics.elements();
        let (thrust, torques) = (elements.thrust().is_some(), elements.torques());
        let free = self.dynamics.free_hinges();
        let dashpots = free.iter().any(|&i| torques[i].depends_on_rate());
        let free = free.len();
        let unknowns = self.unknowns(state, thrust);
        let layout = VariableLayout { unknowns, free, thrust, dashpots };
        self.accelerations = Accelerations::for_hinges(free);
        self.rates = Rates::new(scene, layout);
        (self.jacobian, self.series) = (None, None);
        self.variables = Variables::new(scene, layout, state);
        self.variables.write(&mut self.dynamics, y);
        self.size_up(state);
    }

    /// What is integrated for rates in a mode that begins at `state`.
    fn unknowns(&mut self, state: &State, thrust: bool) -> Unknowns {
        // Springs, dashpots and uniform gravity exert no moment about the mass centre.
        if !self.momenta && (thrust || !self.momentum_for_rate) {
            return Unknowns::Velocities;
        }
        let angular = state.momenta.angular_inertial.unwrap_or_else(|| {
            Totals::of(state, &state.invariants(&mut self.dynamics)).angular_momentum_inertial
        });
        if self.momenta { Unknowns::Momenta(angular) } else { Unknowns::HingeRates(angular) }
    }

    /// Notes how fast `state` is, and how fast it soon will be.
    fn size_up(&mut self, state: &State) {
        self.sizes.saw(&state.omega_body.to_array());
        self.sizes.saw(&state.tau);
        let [beta, tau] = state.of_free(&self.dynamics);
        let motion = Motion { omega_body: state.omega_body, beta: &beta, tau: &tau };
        self.dynamics.accelerations(&motion, &mut self.accelerations);
        let Accelerations { omega_dot_body, tau_dot, .. } = &self.accelerations;
        let angular = omega_dot_body.to_array().into_iter().chain(tau_dot.iter().copied());
        let thrust = self.dynamics.elements().thrust();
        let force = thrust.map_or(Vec3::zero(), |thrust| thrust.force);
        self.sizes.saw_accelerations(angular, force * (1.0 / self.total_mass));
        let has_momenta = self.variables.layout.has_momenta();
        self.sizes.weigh(has_momenta.then(|| self.dynamics.effective_inertias(&beta)));
    }

    /// The state that the variables `y` at time `t` stand for.
    pub fn read(&mut self, t: f64, y: &[f64], state: &mut State) {
        self.variables.read(&mut self.dynamics, t, y, state);
    }

    /// Chooses the code that computes accelerations in the mode that was entered.
    ///
    /// # Errors
    /// When the code that is demanded does not fit.
    pub fn select(&mut self, scene: &Scene, options: &Options) -> Result<Selection, CodeError> {
        let Self { dynamics, repertoire, variables, .. } = self;
        let since = variables.origin.time;
        if variables.layout.has_momenta() {
            self.code = AccelerationCode::Recursion;
            return Ok(Selection::of_momenta(since));
        }
        let (code, selection) =
            AccelerationCode::choose(scene, dynamics, repertoire, options, since)?;
        self.code = code;
        Ok(selection)
    }

    fn compute(&mut self, motion: &Motion<'_, f64>) {
        self.code.accelerations(&mut self.dynamics, motion, &mut self.accelerations);
    }

    /// Accelerations without gravity in the mode that was entered.
    pub fn accelerations(&mut self, motion: &Motion<'_, f64>) -> &Accelerations<f64> {
        self.compute(motion);
        &self.accelerations
    }

    /// Writes β, τ and τ̇ of the free hinges, τ̇ as computed last, among those of all hinges.
    pub fn spread(&self, motion: &Motion<'_, f64>, all: [&mut [f64]; 3]) {
        let [beta, tau, tau_dot] = all;
        for (j, &i) in self.dynamics.free_hinges().iter().enumerate() {
            beta[i] = motion.beta[j];
            tau[i] = motion.tau[j];
            tau_dot[i] = self.accelerations.tau_dot[j];
        }
    }

    /// The acceleration of the mass centre, inertial axes.
    pub fn center_acceleration(&self, state: &State) -> Vec3<f64> {
        let thrust = self.dynamics.elements().thrust().map_or(Vec3::zero(), |thrust| {
            state.attitude.to_matrix() * thrust.force * (1.0 / self.total_mass)
        });
        self.gravity + thrust
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

impl System for Equations {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        let Self { variables, dynamics, code, rates, evaluations, .. } = self;
        *evaluations += usize::from(variables.layout.needs_elimination());
        let free_fall = variables.free_fall(t).velocity;
        rates.write(
            dynamics,
            |dynamics, motion, out| code.accelerations(dynamics, motion, out),
            free_fall,
            y,
            dy,
        );
    }

    fn sizes(&mut self, y: &[f64], sizes: &mut [f64]) {
        let layout = self.variables.layout;
        if layout.has_momenta() {
            let motion = self.variables.motion(&mut self.dynamics, y);
            self.sizes.saw(&motion.omega_body.to_array());
            self.sizes.saw(motion.tau);
        } else {
            self.sizes.saw(&y[layout.omega()]);
            self.sizes.saw(&y[layout.hinge_motion()]);
        }
        self.sizes.write(&layout, sizes);
    }

    fn jacobian(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> bool {
        let free_fall = self.variables.free_fall(t).velocity;
        let Self { scene, mode, variables: Variables { layout, origin, .. }, .. } = self;
        let of_mode = || Jacobian::new(scene, mode, &origin.beta, *layout);
        self.jacobian.get_or_insert_with(of_mode).write(free_fall, y, out);
        true
    }

    fn series(&mut self, t: f64, y: &[f64], order: usize, out: &mut [f64]) -> bool {
        self.evaluations += 1;
        self.series.take_if(|series| series.order() != order);
        let Self { scene, mode, variables, .. } = self;
        let of_mode = || Series::new(&series::graph(scene, mode, variables), &[], order);
        self.series.get_or_insert_with(of_mode).write(t, y, out);
        true
    }
}
