use nboom_dynamics::{Accelerations, Invariants, Motion, Recursive};
use nboom_elements::HingeLaw;
use nboom_model::{Mode, Scene, Thrust};
use nboom_ode::System;
use nboom_scalar::{Quaternion, Real, Vec3};
use nboom_series::Series;

use crate::code::Code;
use crate::error::SimError;
use crate::fit::Repertoire;
use crate::jacobian::Jacobian;
use crate::layout::Layout;
use crate::ledger::totals;
use crate::options::Options;
use crate::rates::Rates;
use crate::record::Selection;
use crate::series;
use crate::state::{MassCenter, State};

/// The differential equations of one mode, and the way from their variables to a [`State`].
pub(crate) struct Equations {
    scene: Scene,
    mode: Mode,
    pub dynamics: Recursive<f64>,
    /// What computes the accelerations of the mode.
    code: Code,
    repertoire: Repertoire,
    pub layout: Layout,
    /// The state in which the mode began; held hinges keep its angles.
    origin: State,
    thrust: Option<Thrust>,
    gravity: Vec3<f64>,
    total_mass: f64,
    laws: Vec<HingeLaw<f64>>,
    accelerations: Accelerations<f64>,
    rates: Rates<f64>,
    /// Made when an integrator asks for it in the mode.
    jacobian: Option<Jacobian>,
    /// The same.
    series: Option<Series<f64>>,
    /// Whether the angular momentum stands for the rate where nothing changes it.
    momentum_for_rate: bool,
}

impl Equations {
    pub fn new(scene: &Scene, state: &State, options: &Options) -> Self {
        let laws: Vec<HingeLaw<f64>> = scene
            .bodies
            .iter()
            .map(|body| HingeLaw::new(&body.hinge.spring, &body.hinge.dashpot))
            .collect();
        let layout = Layout { momentum: None, free: 0, thrust: false, dashpots: false };
        Self {
            scene: scene.clone(),
            mode: Mode::at_start(scene),
            dynamics: Recursive::new(scene),
            code: Code::Recursion,
            repertoire: Repertoire::new(options),
            layout,
            origin: state.clone(),
            thrust: None,
            gravity: scene.gravity.map_or(Vec3::zero(), |g| g.up * -g.acceleration),
            total_mass: scene.total_mass(),
            laws,
            accelerations: Accelerations::for_hinges(0),
            rates: Rates::new(scene, layout, &[], None),
            jacobian: None,
            series: None,
            momentum_for_rate: options.integrator.keeps_invariants(),
        }
    }

    /// Goes on from `state` in `mode`; writes the variables to `y`.
    pub fn enter(&mut self, scene: &Scene, mode: &Mode, state: &State, y: &mut Vec<f64>) {
        self.mode.clone_from(mode);
        self.dynamics.set_mode(mode, &state.beta);
        self.origin.clone_from(state);
        self.thrust = scene.thrust.filter(|_| mode.thrust);
        // Springs, dashpots and uniform gravity exert no moment about the mass centre.
        let momentum = (self.momentum_for_rate && self.thrust.is_none())
            .then(|| totals(state, &self.invariants(state)).angular_momentum_inertial);
        let free = self.dynamics.free_hinges();
        self.layout = Layout {
            momentum,
            free: free.len(),
            thrust: self.thrust.is_some(),
            dashpots: free.iter().any(|&i| self.laws[i].depends_on_rate()),
        };
        self.accelerations = Accelerations::for_hinges(free.len());
        self.rates = Rates::new(scene, self.layout, free, self.thrust);
        (self.jacobian, self.series) = (None, None);
        y.clear();
        let q = state.attitude;
        y.push(q.scalar);
        y.extend(q.vector.to_array());
        if self.layout.momentum.is_none() {
            y.extend(state.omega_body.to_array());
        }
        y.extend(free.iter().map(|&i| state.beta[i]));
        y.extend(free.iter().map(|&i| state.tau[i]));
        y.resize(self.layout.len(), 0.0);
    }

    /// The state that the variables `y` at time `t` stand for.
    pub fn read(&mut self, t: f64, y: &[f64], state: &mut State) {
        let layout = &self.layout;
        state.time = t;
        state.attitude = attitude(y).normalized();
        state.omega_body = motion(layout, &mut self.dynamics, y).omega_body;
        state.beta.clone_from(&self.origin.beta);
        state.tau.fill(0.0);
        for (j, &i) in self.dynamics.free_hinges().iter().enumerate() {
            state.beta[i] = y[layout.beta()][j];
            state.tau[i] = y[layout.tau()][j];
        }
        state.center = self.center(t, y);
        state.work = self.origin.work;
        if let [work] = y[layout.dashpot_work()] {
            state.work.dashpots += work;
        }
        if let [work, mx, my, mz] = y[layout.thrust_work()] {
            state.work.thrust += work;
            state.work.thrust_angular_impulse += Vec3::new(mx, my, mz);
        }
        if let [_, _, _, vx, vy, vz] = y[layout.thrust_motion()] {
            state.work.thrust_impulse += Vec3::new(vx, vy, vz) * self.total_mass;
        }
    }

    /// The system mass centre: free fall since the mode began, and what the thrust added.
    fn center(&self, t: f64, y: &[f64]) -> MassCenter {
        let mut center = self.free_fall(t);
        if let [x, y, z, vx, vy, vz] = y[self.layout.thrust_motion()] {
            center.position += Vec3::new(x, y, z);
            center.velocity += Vec3::new(vx, vy, vz);
        }
        center
    }

    /// The system mass centre as if there were no thrust.
    fn free_fall(&self, t: f64) -> MassCenter {
        self.origin.center.after(t - self.origin.time, self.gravity)
    }

    /// Chooses the code that computes accelerations in the mode that was entered.
    ///
    /// # Errors
    /// When the code that is demanded does not fit.
    pub fn select(&mut self, scene: &Scene, options: &Options) -> Result<Selection, SimError> {
        let Self { dynamics, repertoire, origin, .. } = self;
        let (code, selection) = Code::choose(scene, dynamics, repertoire, options, origin.time)?;
        self.code = code;
        Ok(selection)
    }

    fn compute(&mut self, motion: &Motion<'_, f64>) {
        self.code.accelerations(&mut self.dynamics, motion, &mut self.accelerations);
    }

    /// The free hinges' share of a vector over all hinges.
    pub fn of_free(&self, all: &[f64]) -> Vec<f64> {
        self.dynamics.free_hinges().iter().map(|&i| all[i]).collect()
    }

    /// Energy and momenta in main-body axes.
    pub fn invariants(&mut self, state: &State) -> Invariants<f64> {
        let (beta, tau) = (self.of_free(&state.beta), self.of_free(&state.tau));
        let motion = Motion { omega_body: state.omega_body, beta: &beta, tau: &tau };
        let to_body = state.attitude.to_matrix().transpose();
        self.dynamics.invariants(&motion, to_body * state.center.velocity)
    }

    /// Accelerations without gravity in the mode that was entered.
    pub fn accelerations(&mut self, state: &State) -> &Accelerations<f64> {
        let (beta, tau) = (self.of_free(&state.beta), self.of_free(&state.tau));
        let motion = Motion { omega_body: state.omega_body, beta: &beta, tau: &tau };
        self.compute(&motion);
        &self.accelerations
    }

    /// Length of the kick-off spring of hinge `i` and its rate; zero without one.
    pub fn spring_length(&mut self, state: &State, i: usize) -> (f64, f64) {
        let (beta, tau) = (self.of_free(&state.beta), self.of_free(&state.tau));
        let motion = Motion { omega_body: state.omega_body, beta: &beta, tau: &tau };
        let Some(found) = self.dynamics.spring_length(&motion, i) else { return (0.0, 0.0) };
        let length = found.squared.sqrt();
        (length, found.squared_rate / (length + length))
    }

    /// The acceleration of the mass centre, inertial axes.
    pub fn center_acceleration(&self, state: &State) -> Vec3<f64> {
        let thrust = self.thrust.map_or(Vec3::zero(), |thrust| {
            state.attitude.to_matrix() * thrust.force * (1.0 / self.total_mass)
        });
        self.gravity + thrust
    }

    /// The spring and dashpot law of each hinge.
    pub fn laws(&self) -> &[HingeLaw<f64>] {
        &self.laws
    }

    /// Uniform gravity as an acceleration, inertial axes.
    pub fn gravity(&self) -> Vec3<f64> {
        self.gravity
    }
}

impl System for Equations {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        let motion = motion(&self.layout, &mut self.dynamics, y);
        if self.layout.needs_accelerations() {
            self.compute(&motion);
        }
        let free_fall = self.free_fall(t).velocity;
        self.rates.write(&mut self.dynamics, (&motion, &self.accelerations), free_fall, y, dy);
    }

    fn jacobian(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> bool {
        let free_fall = self.free_fall(t).velocity;
        let Self { scene, mode, origin, layout, thrust, .. } = self;
        let of_mode = || Jacobian::new(scene, mode, &origin.beta, *layout, *thrust);
        self.jacobian.get_or_insert_with(of_mode).write(free_fall, y, out);
        true
    }

    fn series(&mut self, t: f64, y: &[f64], order: usize, out: &mut [f64]) -> bool {
        self.series.take_if(|series| series.order() != order);
        let Self { scene, mode, origin, layout, thrust, gravity, .. } = self;
        let of_mode =
            || Series::new(&series::graph(scene, mode, origin, *layout, *thrust, *gravity), order);
        self.series.get_or_insert_with(of_mode).write(t, y, out);
        true
    }
}

/// The motion that the variables stand for; `dynamics` is in their mode.
pub(crate) fn motion<'a, R: Real>(
    layout: &Layout,
    dynamics: &mut Recursive<R>,
    y: &'a [R],
) -> Motion<'a, R> {
    let (beta, tau) = (&y[layout.beta()], &y[layout.tau()]);
    let omega_body = match layout.momentum {
        None => Vec3::new(y[4], y[5], y[6]),
        Some(momentum) => {
            let to_inertial = attitude(y).normalized().to_matrix();
            let momentum_body = to_inertial.transpose_mul(Vec3::constant(momentum));
            dynamics.angular_rate(momentum_body, beta, tau)
        }
    };
    Motion { omega_body, beta, tau }
}

/// The attitude among the variables, whose norm is near 1.
pub(crate) fn attitude<R: Real>(y: &[R]) -> Quaternion<R> {
    Quaternion { scalar: y[0], vector: Vec3::new(y[1], y[2], y[3]) }
}
