//! Loads of a motion as a row of numbers: those of a [`LoadSet`], then the angles of all hinges.

use nboom_loads::{LoadEquations, LoadSet, Loads, LockUpShare, SceneMotion, VelocityChange};
use nboom_model::{HingeLabel, Scene};
use nboom_scalar::{Kernel, Wrench};
use nboom_sim::{Jump, MotionAt, StepMotion};

use crate::StrengthError;

/// Largest difference between the load about a free hinge's axis and its torque, relative to the
/// sum of the magnitudes of the load's terms. Both follow from accelerations that are good to 1e-11
/// of their size, of which a light boom on a heavy chain takes a small difference. The limit does
/// not apply to a motion that repeats a slip by which forces and accelerations contradict each
/// other.
const BALANCE: f64 = 1e-7;

/// Finds the loads of motions, lock-ups and impacts, and checks them against the torques of free hinges.
#[derive(Clone, Debug)]
pub(crate) struct LoadFinder {
    pub loads: Loads,
    found: LoadSet,
    force_densities: Vec<f64>,
    labels: Vec<HingeLabel>,
    /// Whether loads pass from segment to segment as in 1970.
    hands_on_as_in_1970: bool,
    pub largest_residual: f64,
    most_residual: f64,
    /// The loads at the end of the last step, with which the next one begins.
    end: Option<f64>,
    at_end: Vec<f64>,
}

impl LoadFinder {
    pub fn new(
        scene: &Scene,
        labels: Vec<HingeLabel>,
        equations: LoadEquations,
        hands_on_as_in_1970: bool,
    ) -> Self {
        let loads = Loads::by(equations);
        let found = loads.load_set();
        Self {
            at_end: vec![0.0; found.count() + labels.len()],
            loads,
            found,
            force_densities: vec![0.0; labels.len()],
            labels,
            hands_on_as_in_1970,
            largest_residual: 0.0,
            most_residual: if scene.departures().is_empty() { BALANCE } else { f64::INFINITY },
            end: None,
        }
    }

    /// This finder with the code among `kernels`, if any, that was generated for it.
    pub fn with_kernels(self, kernels: &[Kernel]) -> Self {
        Self { loads: self.loads.with_kernels(kernels), ..self }
    }

    /// Zero loads, to be filled in.
    pub fn load_set(&self) -> LoadSet {
        self.loads.load_set()
    }

    /// How many numbers a row has.
    pub fn width(&self) -> usize {
        self.at_end.len()
    }

    /// Writes the row of a motion, eqs. (10.4) to (10.6).
    ///
    /// # Errors
    /// When they contradict the motion, or are no numbers.
    pub fn write(&mut self, motion: &MotionAt<'_>, row: &mut [f64]) -> Result<(), StrengthError> {
        for line in motion.lines {
            self.force_densities[line.hinge] = line.density();
        }
        let scene_motion = SceneMotion {
            omega_body: motion.omega_body,
            beta: motion.beta,
            tau: motion.tau,
            acceleration: VelocityChange {
                origin_body: motion.origin_acceleration_body,
                omega_body: motion.omega_dot_body,
                tau: motion.beta_ddot,
            },
            force_densities: &self.force_densities,
            outside: motion.outside,
            rotors: motion.rotors,
        };
        self.loads.continuous(&scene_motion, &mut self.found);
        self.check_balance(motion)?;
        if self.hands_on_as_in_1970 {
            self.loads.hand_on_as_in_1970(motion.beta, &mut self.found);
        }
        let (loads, angles) = row.split_at_mut(self.found.count());
        self.found.write(loads);
        angles.copy_from_slice(motion.beta);
        if row.iter().all(|number| number.is_finite()) {
            Ok(())
        } else {
            Err(StrengthError::NotFinite { time: motion.time })
        }
    }

    /// Notes that a step begins; unless it `goes_on` from the one before, loads jump there.
    pub fn begin(&mut self, goes_on: bool) {
        self.end = self.end.filter(|_| goes_on);
    }

    /// The loads at `time` of a step; those of its end are kept for the start of the next one.
    ///
    /// # Errors
    /// Those of [`write`](Self::write).
    pub fn write_within(
        &mut self,
        step: &mut dyn StepMotion,
        time: f64,
        row: &mut [f64],
    ) -> Result<(), StrengthError> {
        if self.end == Some(time) {
            row.copy_from_slice(&self.at_end);
            return Ok(());
        }
        let [_, end] = step.span();
        self.write(&step.at(time), row)?;
        if time == end {
            self.end = Some(end);
            self.at_end.copy_from_slice(row);
        }
        Ok(())
    }

    /// Loads at the peak of the pulse by which one hinge locks or hits its stop, eqs. (10.7) to (10.14).
    pub fn peak(&mut self, beta: &[f64], jump: &Jump, constant: f64, factor: f64) -> Vec<f64> {
        let mut peak = self.load_set();
        let share = LockUpShare { pulse_constant: constant, jump: change(jump) };
        self.loads.add_lock_up(beta, &[share], factor, &mut peak);
        if self.hands_on_as_in_1970 {
            self.loads.hand_on_as_in_1970(beta, &mut peak);
        }
        peak.numbers()
    }

    /// Impulses that each hinge exerts on its outboard body when one hinge locks or hits its stop, eqs.
    /// (10.7) to (10.12).
    pub fn impulses(&mut self, beta: &[f64], jump: &Jump) -> Vec<Wrench<f64>> {
        let mut impulses = self.load_set();
        self.loads.impulses(beta, &change(jump), &mut impulses);
        (0..self.labels.len()).map(|i| impulses.hinge(i)).collect()
    }

    fn check_balance(&mut self, motion: &MotionAt<'_>) -> Result<(), StrengthError> {
        let (hinges, torques) = (motion.hinges, motion.hinge_torque);
        let residual = self.loads.largest_torque_residual(&self.found, hinges, torques);
        let Some((hinge, residual)) = residual else { return Ok(()) };
        self.largest_residual = self.largest_residual.max(residual);
        let most = self.most_residual;
        if residual <= most {
            return Ok(());
        }
        let hinge = self.labels[hinge].clone();
        Err(StrengthError::Unbalanced { time: motion.time, hinge, residual, most })
    }
}

fn change(jump: &Jump) -> VelocityChange<'_> {
    VelocityChange { origin_body: jump.velocity_body, omega_body: jump.omega_body, tau: &jump.tau }
}
