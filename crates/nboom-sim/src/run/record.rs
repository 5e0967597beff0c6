use std::io;

use nboom_elements::LineReading;
use nboom_model::HingeState;
use nboom_ode::Choice;
use nboom_scalar::{Quaternion, Vec3, Wrench};

use crate::code::selection::{CodeOfRun, Selection};
use crate::error::{Runaway, SimError};
use crate::events::event::{Event, Jump};
use crate::run::account::Account;
use crate::run::conservation::Conservation;
use crate::run::output_times::OutputTimes;
use crate::run::step_motion::StepMotion;
use crate::run::verdict::Verdict;

/// Receives what a run tells while it goes on: a snapshot at every output time, and every event.
///
/// Calls come in time order. An error ends the run with everything recorded so far kept.
pub trait Recorder {
    /// Whether snapshots are wanted with [`Snapshot::detail`], which costs one more evaluation
    /// of the equations of motion each.
    fn needs_detail(&self) -> bool {
        false
    }

    /// The output times that are wanted in place of the uniform ones of the run's options.
    fn output_times(&self) -> Option<&OutputTimes> {
        None
    }

    /// The motion at an output time; an event at that time is already over.
    ///
    /// # Errors
    /// When it cannot be kept, for example on a full disk.
    fn sample(&mut self, _snapshot: &Snapshot) -> io::Result<()> {
        Ok(())
    }

    /// An event, and the motion after all events of its instant.
    ///
    /// # Errors
    /// When it cannot be kept.
    fn event(&mut self, _event: &Event, _after: &Snapshot) -> io::Result<()> {
        Ok(())
    }

    /// Whether the run shall end where it is, with [`SimError::Interrupted`];
    /// asked at every step and output time.
    fn interrupted(&self) -> bool {
        false
    }

    /// Whether [`instant`](Self::instant) is wanted, which costs two evaluations of the equations
    /// of motion each.
    fn needs_instants(&self) -> bool {
        false
    }

    /// An instant with events, as its loads see it; before its events.
    ///
    /// # Errors
    /// When it cannot be kept.
    fn instant(&mut self, _instant: &InstantMotion) -> io::Result<()> {
        Ok(())
    }

    /// Whether [`step`](Self::step) is wanted, which costs dense output of every step and an
    /// evaluation of the equations of motion for each time that is looked at.
    fn needs_steps(&self) -> bool {
        false
    }

    /// A step, after the output times within it and before the instant that ends it, if one does.
    /// Steps and instants together are the whole motion. Looking at it changes nothing in the run.
    ///
    /// # Errors
    /// When what is seen cannot be kept.
    fn step(&mut self, _step: &mut dyn StepMotion) -> io::Result<()> {
        Ok(())
    }
}

/// Records nothing.
#[derive(Clone, Copy, Debug)]
pub struct Nobody;

impl Recorder for Nobody {}

/// The motion on both sides of an instant in which something happens. Accelerations jump; where
/// hinges lock or hit stops, velocities do too.
#[derive(Clone, Copy, Debug)]
pub struct InstantMotion<'a> {
    /// The motion just before; none at the initial time unless a hinge locks or hits a stop there.
    pub before: Option<Side<'a>>,
    /// What the impulse about each hinge that locks or presses against its stop changes; the motion after has the sum of
    /// all.
    pub jumps: &'a [Jump],
    /// The motion after all events of the instant.
    pub after: Side<'a>,
}

impl<'a> InstantMotion<'a> {
    /// The sides, that before first.
    pub fn sides(&self) -> impl Iterator<Item = Side<'a>> {
        self.before.into_iter().chain([self.after])
    }
}

/// The motion on one side of an instant.
#[derive(Clone, Copy, Debug)]
pub struct Side<'a> {
    /// The motion, with its detail.
    pub snapshot: &'a Snapshot,
    /// That detail.
    pub detail: &'a Detail,
}

/// The motion at one time. Vectors over hinges have one entry for each hinge of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Time.
    pub time: f64,
    /// Position of O, inertial axes.
    pub position_inertial: Vec3<f64>,
    /// Inertial velocity of O, inertial axes.
    pub velocity_inertial: Vec3<f64>,
    /// Attitude of the main body, norm 1, continuous from a non-negative scalar on.
    pub attitude: Quaternion<f64>,
    /// Angular rate of the main body, main-body axes \[rad/T\].
    pub omega_body: Vec3<f64>,
    /// β: angle of each hinge relative to its inboard body \[rad\].
    pub beta: Vec<f64>,
    /// τ: rate of each hinge relative to its inboard body \[rad/T\].
    pub tau: Vec<f64>,
    /// α: sum of β along the appendage \[rad\].
    pub alpha: Vec<f64>,
    /// σ: sum of τ along the appendage \[rad/T\].
    pub sigma: Vec<f64>,
    /// Ω: speed of each rotor relative to its body, as the scene lists them \[rad/T\].
    pub rotor_speeds: Vec<f64>,
    /// State of each hinge.
    pub hinges: Vec<HingeState>,
    /// Kinetic energy T, eq. (8.11).
    pub kinetic_energy: f64,
    /// Linear momentum P̄, inertial axes.
    pub linear_momentum_inertial: Vec3<f64>,
    /// Angular momentum H̄_c about the system mass centre, inertial axes.
    pub angular_momentum_inertial: Vec3<f64>,
    /// Angle between H̄_c and the main body's x axis \[rad\].
    pub nutation: f64,
    /// Accelerations and forces, when the recorder asked for them.
    pub detail: Option<Detail>,
    /// What became of momentum and energy, at output times and after events.
    pub account: Option<Account>,
    /// Steps accepted since the initial time.
    pub steps: usize,
    /// The step that the integrator tries next.
    pub next_step: f64,
}

impl Snapshot {
    /// Nothing, with room for what is seen.
    pub(crate) fn empty() -> Self {
        let (none, zero) = (Vec::new, Vec3::zero());
        Self {
            time: 0.0,
            position_inertial: zero,
            velocity_inertial: zero,
            attitude: Quaternion { scalar: 1.0, vector: zero },
            omega_body: zero,
            beta: none(),
            tau: none(),
            alpha: none(),
            sigma: none(),
            rotor_speeds: none(),
            hinges: Vec::new(),
            kinetic_energy: 0.0,
            linear_momentum_inertial: zero,
            angular_momentum_inertial: zero,
            nutation: 0.0,
            detail: None,
            account: None,
            steps: 0,
            next_step: 0.0,
        }
    }
}

/// Accelerations and forces at one time. Vectors over hinges have one entry for each hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// Angular acceleration of the main body, main-body axes \[rad/T²\].
    pub omega_dot_body: Vec3<f64>,
    /// Inertial acceleration of O without that of gravity, main-body axes.
    pub origin_acceleration_body: Vec3<f64>,
    /// Moment about O and force that what holds the main body exerts on it, main-body axes; none of
    /// a free one.
    pub reaction: Option<Wrench<f64>>,
    /// Acceleration of each hinge angle β; zero while held.
    pub beta_ddot: Vec<f64>,
    /// Acceleration of each sum α.
    pub alpha_ddot: Vec<f64>,
    /// Torque of all laws about the hinge, whether or not it is held.
    pub hinge_torque: Vec<f64>,
    /// The forces along lines, by hinge.
    pub lines: Vec<LineReading>,
    /// The forces and torques from outside on hinged bodies, as the scene lists them; zero where
    /// one does not act. Body axes, or main-body axes where it is given along inertial ones.
    pub outside: Vec<[f64; 3]>,
    /// Speed relative to its body \[rad/T\], and the rate of change of that, of each rotor in a
    /// hinged body, as the scene lists them.
    pub rotors: Vec<[f64; 2]>,
    /// Torque of the motor of each rotor about its axis on it, as the scene lists them.
    pub motor_torques: Vec<f64>,
    /// S̄: system mass centre from O, main-body axes.
    pub mass_center_body: Vec3<f64>,
    /// System mass centre, inertial axes.
    pub mass_center_inertial: Vec3<f64>,
    /// Velocity of the system mass centre, inertial axes.
    pub mass_center_velocity_inertial: Vec3<f64>,
    /// Acceleration of the system mass centre, inertial axes.
    pub mass_center_acceleration_inertial: Vec3<f64>,
}

impl Detail {
    /// Nothing, with room for what is found.
    pub(crate) fn empty() -> Self {
        let (none, zero) = (Vec::new, Vec3::zero());
        Self {
            omega_dot_body: zero,
            origin_acceleration_body: zero,
            reaction: None,
            beta_ddot: none(),
            alpha_ddot: none(),
            hinge_torque: none(),
            lines: Vec::new(),
            outside: Vec::new(),
            rotors: Vec::new(),
            motor_torques: none(),
            mass_center_body: zero,
            mass_center_inertial: zero,
            mass_center_velocity_inertial: zero,
            mass_center_acceleration_inertial: zero,
        }
    }
}

/// How a run went.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Time reached.
    pub end_time: f64,
    /// Steps accepted.
    pub steps_accepted: usize,
    /// Steps rejected.
    pub steps_rejected: usize,
    /// Evaluations of the right side, or of power series.
    pub evaluations: usize,
    /// Events recorded, the end included.
    pub events: usize,
    /// Largest residuals of the conservation laws at output times and events.
    pub conservation: Conservation,
    /// Whether an angular momentum has been more than rounding of what the energy could make of it, so that the
    /// nutation says something.
    pub has_angular_momentum: bool,
    /// Evaluations of the Jacobian, by implicit integrators.
    pub jacobians: usize,
    /// Factorisations of iteration matrices, by implicit integrators.
    pub factorizations: usize,
    /// How far from 1 the norm of the attitude has been, or would have been if it were never put
    /// back; see `docs/integrators.md`.
    pub attitude_drift: f64,
    /// Name of the integrator.
    pub integrator: &'static str,
    /// Which method took the steps.
    pub integrations: Vec<Integration>,
    /// Which code computed accelerations, mode by mode.
    pub selections: Vec<Selection>,
    /// What became of the hinges.
    pub verdict: Verdict,
    /// That something feeds the motion without end, if a run comes to its end all the same.
    pub runaway: Option<Runaway>,
}

impl Summary {
    /// That of a run before its beginning.
    pub(crate) fn empty() -> Self {
        Self {
            end_time: 0.0,
            steps_accepted: 0,
            steps_rejected: 0,
            evaluations: 0,
            events: 0,
            conservation: Conservation::default(),
            has_angular_momentum: false,
            jacobians: 0,
            factorizations: 0,
            attitude_drift: 0.0,
            integrator: "",
            integrations: Vec::new(),
            selections: Vec::new(),
            verdict: Verdict { hinges: Vec::new(), largest_impulse: None },
            runaway: None,
        }
    }

    /// Begins anew with hinges that are in these states and at these angles.
    pub(crate) fn begin(&mut self, hinges: &[HingeState], beta: &[f64]) {
        self.events = 0;
        self.integrations.clear();
        self.selections.clear();
        self.runaway = None;
        self.verdict.begin(hinges, beta);
    }

    /// What stands for all code that computed accelerations.
    pub fn code(&self) -> CodeOfRun {
        CodeOfRun::of(&self.selections)
    }
}

/// Which method took the steps from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integration {
    /// Time from which on.
    pub since: f64,
    /// The method, and why this one.
    pub choice: Choice,
}

/// A run that ended early.
#[derive(Debug, thiserror::Error)]
#[error("{error}")]
pub struct Failure {
    /// Why.
    #[source]
    pub error: SimError,
    /// How far it came.
    pub summary: Box<Summary>,
}
