//! Generated routines on states as Python has them.

use nboom_dynamics::{Motion, Recursive};
use nboom_formulation::{Layout, Recognised};
use nboom_scalar::{Batch, Eight, Kernel, Vec3};
use nboom_sim::Fit;

use crate::at_state::AtState;
use crate::evaluator::{EightStates, Found, add};

/// How many states a batch takes.
pub(crate) const LANES: usize = 8;

/// Numbers of one state that a routine gets before those of hinges: ω, moment and force.
const OMEGA: usize = 0;
const EXTERNAL: usize = 3;

/// Where β, τ and torque of a hinge stand among coordinates, and τ̇ among outputs.
type Place = ([usize; 3], usize);

/// A generated routine that is prepared for the mode.
#[derive(Clone)]
pub(crate) struct Routine {
    kernel: Kernel,
    reason: String,
    constants: Vec<f64>,
    coordinates: Vec<f64>,
    outputs: Vec<f64>,
    /// Of each free hinge.
    places: Vec<Place>,
    eight: Option<RoutineOfEight>,
}

/// The same routine on eight states.
#[derive(Clone)]
struct RoutineOfEight {
    batch: Batch,
    constants: Vec<Eight>,
    coordinates: Vec<Eight>,
    outputs: Vec<Eight>,
    torques: Vec<f64>,
}

impl Routine {
    pub fn new(fit: &Fit, recognised: &Recognised, batches: &[Batch]) -> Self {
        let kernel = fit.kernel;
        let mut places = vec![([0; 3], 0); recognised.links.len()];
        for (&link, place) in recognised.links.iter().zip(fit.hinges()) {
            places[link] = place;
        }
        let outer = fit.embedding.outer();
        let coordinates = Layout::coordinates(outer);
        let batch = batches.iter().find(|batch| batch.is_of_same_routine(&kernel));
        let eight = batch.map(|batch| {
            let parameters: Vec<Eight> = fit.parameters.iter().map(|&x| Eight::splat(x)).collect();
            let mut constants = vec![Eight::splat(0.0); batch.constants];
            batch.prepare(&parameters, &mut constants);
            let zeros = |count| vec![Eight::splat(0.0); count];
            let (coordinates, outputs) = (zeros(coordinates), zeros(batch.outputs));
            let torques = vec![0.0; LANES * recognised.links.len()];
            RoutineOfEight { batch: *batch, constants, coordinates, outputs, torques }
        });
        Self {
            kernel,
            reason: fit.reason(),
            constants: fit.constants(),
            coordinates: vec![0.0; coordinates],
            outputs: vec![0.0; kernel.outputs],
            places,
            eight,
        }
    }

    /// The form of its equations of motion.
    pub fn formulation(&self) -> &'static str {
        self.kernel.formulation
    }

    /// Why this code.
    pub fn reason(&self) -> &str {
        &self.reason
    }

    /// Writes ω̇, a_O and τ̇ in a motion under these torques.
    pub fn accelerations(
        &mut self,
        recursion: &Recursive<f64>,
        motion: &Motion<'_, f64>,
        torques: &[f64],
        [omega_dot, origin, tau_dot]: [&mut [f64]; 3],
    ) {
        self.write(recursion, motion, torques);
        let Self { kernel, constants, coordinates, outputs, places, .. } = self;
        kernel.evaluate(constants, coordinates, outputs);
        omega_dot.copy_from_slice(&outputs[..3]);
        origin.copy_from_slice(&outputs[3..6]);
        for (tau_dot, &(_, place)) in tau_dot.iter_mut().zip(&*places) {
            *tau_dot = outputs[place];
        }
    }

    /// Writes the accelerations of eight states, the first of which has number `first`, if it can.
    pub fn accelerations_of_eight(
        &mut self,
        at_state: &mut AtState,
        states: &EightStates<'_>,
        out: &mut Found<'_>,
        first: usize,
    ) -> bool {
        let Self { eight: Some(eight), places, .. } = self else { return false };
        eight.write(at_state, states, places);
        eight.batch.evaluate(&eight.constants, &eight.coordinates, &mut eight.outputs);
        eight.read(out, first, places);
        true
    }

    /// Puts a state where the routine takes it.
    fn write(&mut self, recursion: &Recursive<f64>, motion: &Motion<'_, f64>, torques: &[f64]) {
        let x = &mut self.coordinates;
        x[OMEGA..EXTERNAL].copy_from_slice(&motion.omega_body.to_array());
        let acting = recursion.acting_on_main_body(motion.omega_body);
        x[EXTERNAL..EXTERNAL + 3].copy_from_slice(&acting.moment.to_array());
        x[EXTERNAL + 3..EXTERNAL + 6].copy_from_slice(&acting.force.to_array());
        for (j, &([beta, tau, torque], _)) in self.places.iter().enumerate() {
            (x[beta], x[tau], x[torque]) = (motion.beta[j], motion.tau[j], torques[j]);
        }
    }
}

impl RoutineOfEight {
    /// Puts states where the routine takes them.
    fn write(&mut self, at_state: &mut AtState, states: &EightStates<'_>, places: &[Place]) {
        let Self { coordinates: x, torques, .. } = self;
        let free = places.len();
        for lane in 0..LANES {
            let omega = &states.omega[3 * lane..3 * lane + 3];
            (0..3).for_each(|i| x[OMEGA + i].0[lane] = omega[i]);
            let omega_body = Vec3::new(omega[0], omega[1], omega[2]);
            let own = lane * free..(lane + 1) * free;
            let (beta, tau) = (&states.beta[own.clone()], &states.tau[own.clone()]);
            let recursion = at_state.at([beta, tau]);
            recursion.hinge_forces(&Motion { omega_body, beta, tau }, &mut torques[own]);
            let acting = recursion.acting_on_main_body(omega_body);
            let [m, f] = [acting.moment.to_array(), acting.force.to_array()];
            (0..3).for_each(|i| x[EXTERNAL + i].0[lane] = m[i]);
            (0..3).for_each(|i| x[EXTERNAL + 3 + i].0[lane] = f[i]);
        }
        add(states.added, torques);
        for (j, &([beta, tau, torque], _)) in places.iter().enumerate() {
            let of_lanes = |list: &[f64]| Eight(std::array::from_fn(|lane| list[lane * free + j]));
            x[beta] = of_lanes(states.beta);
            x[tau] = of_lanes(states.tau);
            x[torque] = of_lanes(torques);
        }
    }

    /// Takes accelerations from where the routine puts them, the first of which are of state number `first`.
    fn read(&self, out: &mut Found<'_>, first: usize, places: &[Place]) {
        let free = places.len();
        for lane in 0..LANES {
            let [omega_dot, origin, tau_dot] = out.row(first + lane, free);
            for i in 0..3 {
                omega_dot[i] = self.outputs[i].0[lane];
                origin[i] = self.outputs[3 + i].0[lane];
            }
            for (tau_dot, &(_, place)) in tau_dot.iter_mut().zip(places) {
                *tau_dot = self.outputs[place].0[lane];
            }
        }
    }
}
