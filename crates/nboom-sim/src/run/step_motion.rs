//! Steps as they are shown to recorders that search each of them for the worst value.

use nboom_dynamics::Recursive;
use nboom_elements::{Elements, LineReading, OwnLaws};
use nboom_model::{HingeState, Scene};
use nboom_ode::Stepper;
use nboom_scalar::Vec3;

use crate::equations::Equations;
use crate::equations::layout::VariableLayout;
use crate::equations::variables::{attitude, motion};
use crate::run::record::{Detail, Snapshot};

/// A step of the motion, from its start to its end or to the instant that cuts it off; in between
/// everything is smooth.
pub trait StepMotion {
    /// When it starts and when it ends.
    fn span(&self) -> [f64; 2];

    /// Whether it goes on from the step before as if there were one step: accelerations do not jump where it
    /// starts.
    fn goes_on(&self) -> bool;

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
    /// Torque of all laws about the hinge, whether or not it is held.
    pub hinge_torque: &'a [f64],
    /// The forces along lines, by hinge; one entry for each of them.
    pub lines: &'a [LineReading],
    /// The forces and torques from outside on hinged bodies, as the scene lists them; zero where
    /// one does not act. Body axes, or main-body axes where it is given along inertial ones.
    pub outside: &'a [[f64; 3]],
    /// Speed relative to its body \[rad/T\], and the rate of change of that, of each rotor in a
    /// hinged body, as the scene lists them.
    pub rotors: &'a [[f64; 2]],
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
            lines: &detail.lines,
            outside: &detail.outside,
            rotors: &detail.rotors,
        }
    }
}

/// Torques about all hinges, forces along lines, what acts on hinged bodies from outside, and how
/// rotors turn in these.
#[derive(Clone, Debug)]
pub(crate) struct Forces {
    pub torque: Vec<f64>,
    pub lines: Vec<LineReading>,
    pub outside: Vec<[f64; 3]>,
    pub rotors: Vec<[f64; 2]>,
    lengths_squared: Vec<f64>,
}

impl Forces {
    /// Room for those of a scene.
    pub fn new(scene: &Scene, elements: &Elements<f64>) -> Self {
        let lines = elements.lines();
        Self {
            torque: vec![0.0; elements.torques().len()],
            lines: lines.iter().map(|line| line.reading(0.0)).collect(),
            outside: vec![[0.0; 3]; scene.externals_on_hinged().count()],
            rotors: Vec::with_capacity(scene.rotors.len()),
            lengths_squared: vec![0.0; lines.len()],
        }
    }

    /// Sets them at β and τ of all hinges, and β of those that are free, in the mode of `dynamics`.
    pub fn set(
        &mut self,
        dynamics: &mut Recursive<f64>,
        own: &OwnLaws,
        [beta, tau]: [&[f64]; 2],
        free_beta: &[f64],
    ) {
        dynamics.elements().set_all_torques([beta, tau], &mut self.torque);
        for law in own.iter() {
            self.torque[law.hinge] += law.torque(beta[law.hinge], tau[law.hinge]);
        }
        dynamics.elements().set_on_hinged(&mut self.outside);
        self.rotors.clear();
        self.rotors
            .extend(dynamics.rotors_in_hinged().map(|motion| [motion.speed, motion.acceleration]));
        if self.lines.is_empty() {
            return;
        }
        dynamics.line_lengths_squared(free_beta, &mut self.lengths_squared);
        let lines = dynamics.elements().lines().iter().zip(&self.lengths_squared);
        for (reading, (line, squared)) in self.lines.iter_mut().zip(lines) {
            *reading = line.reading(squared.sqrt());
        }
    }
}

/// Room for the motion at one time in any mode, so that none is made while steps are looked at.
#[derive(Clone, Debug)]
pub(crate) struct Room {
    variables: Vec<f64>,
    /// τ of the free hinges where it is no variable.
    free_tau: Vec<f64>,
    pub beta: Vec<f64>,
    pub tau: Vec<f64>,
    pub beta_ddot: Vec<f64>,
    pub forces: Forces,
}

impl Room {
    pub fn new(scene: &Scene, elements: &Elements<f64>) -> Self {
        let free = scene.bodies.len();
        let largest = VariableLayout::largest(free);
        let none = vec![0.0; free];
        Self {
            variables: Vec::with_capacity(largest.len()),
            free_tau: Vec::with_capacity(free),
            beta: none.clone(),
            tau: none.clone(),
            beta_ddot: none,
            forces: Forces::new(scene, elements),
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
    goes_on: bool,
}

impl<'a> DenseStep<'a> {
    /// `full` is the length of the step that dense output is of; it `goes_on` unless integration began anew.
    pub fn new(
        (hinges, goes_on): (&'a [HingeState], bool),
        equations: &'a mut Equations,
        stepper: &'a dyn Stepper,
        full: f64,
        room: &'a mut Room,
    ) -> Self {
        let (start, end) = (stepper.window().time, stepper.window().end_time);
        let layout = &equations.variables.layout;
        room.variables.resize(layout.len(), 0.0);
        room.free_tau.resize(layout.free, 0.0);
        room.beta.copy_from_slice(&equations.variables.origin.beta);
        room.tau.fill(0.0);
        room.beta_ddot.fill(0.0);
        Self { hinges, equations, stepper, room, start, full, end, goes_on }
    }
}

impl StepMotion for DenseStep<'_> {
    fn span(&self) -> [f64; 2] {
        [self.start, self.end]
    }

    fn goes_on(&self) -> bool {
        self.goes_on
    }

    fn at(&mut self, time: f64) -> MotionAt<'_> {
        let Self { hinges, equations, stepper, room, start, full, .. } = self;
        let Room { variables, free_tau, beta, tau, beta_ddot, forces } = &mut **room;
        stepper.interpolate((time - *start) / *full, variables);
        let layout = &equations.variables.layout;
        equations.entered.dynamics.set_outside(attitude(variables), time);
        let motion = motion(layout, &mut equations.entered.dynamics, variables, free_tau);
        let found = equations.accelerations(&motion);
        let (omega_dot_body, origin_acceleration_body) = (found.omega_dot_body, found.origin_body);
        equations.spread(&motion, [beta, tau, beta_ddot]);
        let Equations { entered, own, .. } = &mut **equations;
        forces.set(&mut entered.dynamics, own, [beta, tau], motion.beta);
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
            lines: &forces.lines,
            outside: &forces.outside,
            rotors: &forces.rotors,
        }
    }
}
