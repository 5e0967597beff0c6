//! Steps as recorders see them that look for the worst within each.

use nboom_dynamics::Recursive;
use nboom_elements::{HingeLaw, KickOffLaw};
use nboom_model::{HingeState, Mode, Scene};
use nboom_ode::Stepper;
use nboom_scalar::Vec3;

use crate::equations::Equations;
use crate::record::{Detail, Snapshot};
use crate::variables::motion;

/// A step of the motion, from its start to its end or to the instant that cuts it off; in between
/// everything is smooth.
pub trait StepMotion {
    /// When it starts and when it ends.
    fn span(&self) -> [f64; 2];

    /// The motion at a time from its start to its end, by dense output and one evaluation of the
    /// equations of motion; the library's recursion and generated code allocate nothing for it.
    fn at(&mut self, time: f64) -> MotionAt<'_>;
}

/// What loads follow from, at one time; slices have one entry for each hinge of the scene.
#[derive(Clone, Copy, Debug)]
pub struct MotionAt<'a> {
    /// Time.
    pub time: f64,
    /// State of each hinge.
    pub hinges: &'a [HingeState],
    /// Angular rate of the main body, main-body axes \[rad/T\].
    pub omega_body: Vec3<f64>,
    /// β: angle of each hinge relative to its inboard body \[rad\].
    pub beta: &'a [f64],
    /// τ: rate of each hinge relative to its inboard body \[rad/T\].
    pub tau: &'a [f64],
    /// Angular acceleration of the main body, main-body axes \[rad/T²\].
    pub omega_dot_body: Vec3<f64>,
    /// Inertial acceleration of O without that of gravity, main-body axes.
    pub origin_acceleration_body: Vec3<f64>,
    /// Acceleration of each β; zero while held.
    pub beta_ddot: &'a [f64],
    /// Spring and dashpot torque by the law of eq. (6.1), whether or not the hinge is held.
    pub hinge_torque: &'a [f64],
    /// Force of each kick-off spring; zero where there is none.
    pub kick_off_force: &'a [f64],
    /// Length of each kick-off spring; zero where there is none.
    pub kick_off_length: &'a [f64],
}

impl<'a> MotionAt<'a> {
    /// That of a snapshot with its detail.
    pub fn of(snapshot: &'a Snapshot, detail: &'a Detail) -> Self {
        Self {
            time: snapshot.time,
            hinges: &snapshot.hinges,
            omega_body: snapshot.omega_body,
            beta: &snapshot.beta,
            tau: &snapshot.tau,
            omega_dot_body: detail.omega_dot_body,
            origin_acceleration_body: detail.origin_acceleration_body,
            beta_ddot: &detail.beta_ddot,
            hinge_torque: &detail.hinge_torque,
            kick_off_force: &detail.kick_off_force,
            kick_off_length: &detail.kick_off_length,
        }
    }
}

/// Torques of springs and dashpots, and forces and lengths of kick-off springs, hinge by hinge.
#[derive(Clone, Debug)]
pub(crate) struct HingeForces {
    pub torque: Vec<f64>,
    pub kick_off_force: Vec<f64>,
    pub kick_off_length: Vec<f64>,
    /// The hinges with kick-off springs, and the squares of their lengths.
    springs: Vec<usize>,
    squared: Vec<f64>,
}

impl HingeForces {
    pub fn new(scene: &Scene) -> Self {
        let has_spring = |&i: &usize| scene.bodies[i].hinge.kick_off.is_some();
        let springs: Vec<usize> = (0..scene.bodies.len()).filter(has_spring).collect();
        let none = vec![0.0; scene.bodies.len()];
        Self {
            torque: none.clone(),
            kick_off_force: none.clone(),
            kick_off_length: none,
            squared: vec![0.0; springs.len()],
            springs,
        }
    }

    /// Torques by the law of each hinge at its angle and rate.
    pub fn set_torques(&mut self, laws: &[HingeLaw<f64>], [beta, tau]: [&[f64]; 2]) {
        let rates = laws.iter().zip(beta.iter().zip(tau));
        for (torque, (law, (&b, &t))) in self.torque.iter_mut().zip(rates) {
            *torque = law.torque(b, t);
        }
    }

    /// Kick-off springs at the angles of the free hinges of `dynamics`, which is in `mode`.
    pub fn set_springs(
        &mut self,
        scene: &Scene,
        mode: &Mode,
        dynamics: &mut Recursive<f64>,
        free_beta: &[f64],
    ) {
        if self.springs.is_empty() {
            return;
        }
        dynamics.spring_lengths_squared(free_beta, &self.springs, &mut self.squared);
        for (&i, squared) in self.springs.iter().zip(&self.squared) {
            let length = squared.sqrt();
            let acting = scene.bodies[i].hinge.kick_off.filter(|_| mode.kick_off[i]);
            self.kick_off_length[i] = length;
            self.kick_off_force[i] =
                acting.map_or(0.0, |spring| KickOffLaw::new(spring.coefficients).force(length));
        }
    }
}

/// Room for the motion at one time of a step.
#[derive(Clone, Debug)]
pub(crate) struct Room {
    variables: Vec<f64>,
    beta: Vec<f64>,
    tau: Vec<f64>,
    beta_ddot: Vec<f64>,
    forces: HingeForces,
}

impl Room {
    pub fn new(scene: &Scene) -> Self {
        let none = vec![0.0; scene.bodies.len()];
        let forces = HingeForces::new(scene);
        Self {
            variables: Vec::new(),
            beta: none.clone(),
            tau: none.clone(),
            beta_ddot: none,
            forces,
        }
    }
}

/// The step that a stepper has dense output of, up to `end`.
pub(crate) struct DenseStep<'a> {
    hinges: &'a [HingeState],
    equations: &'a mut Equations,
    stepper: &'a dyn Stepper,
    room: &'a mut Room,
    start: f64,
    /// Length of the step that dense output is of.
    full: f64,
    end: f64,
}

impl<'a> DenseStep<'a> {
    /// `full` is the length of the step that dense output is of.
    pub fn new(
        hinges: &'a [HingeState],
        equations: &'a mut Equations,
        stepper: &'a dyn Stepper,
        full: f64,
        room: &'a mut Room,
    ) -> Self {
        let (start, end) = (stepper.window().time, stepper.window().end_time);
        room.variables.resize(equations.variables.layout.len(), 0.0);
        room.beta.copy_from_slice(&equations.variables.origin.beta);
        room.tau.fill(0.0);
        room.beta_ddot.fill(0.0);
        Self { hinges, equations, stepper, room, start, full, end }
    }
}

impl StepMotion for DenseStep<'_> {
    fn span(&self) -> [f64; 2] {
        [self.start, self.end]
    }

    fn at(&mut self, time: f64) -> MotionAt<'_> {
        let Self { hinges, equations, stepper, room, start, full, .. } = self;
        let Room { variables, beta, tau, beta_ddot, forces } = &mut **room;
        stepper.interpolate((time - *start) / *full, variables);
        let motion =
            motion(&equations.variables.layout, &mut equations.dynamics, variables.as_slice());
        let found = equations.accelerations(&motion);
        let (omega_dot_body, origin_acceleration_body) = (found.omega_dot_body, found.origin_body);
        equations.spread(&motion, [beta, tau, beta_ddot]);
        equations.set_hinge_forces([beta, tau], motion.beta, forces);
        MotionAt {
            time,
            hinges,
            omega_body: motion.omega_body,
            beta,
            tau,
            omega_dot_body,
            origin_acceleration_body,
            beta_ddot,
            hinge_torque: &forces.torque,
            kick_off_force: &forces.kick_off_force,
            kick_off_length: &forces.kick_off_length,
        }
    }
}
