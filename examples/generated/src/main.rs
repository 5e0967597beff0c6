//! A program around a crate that `nboom generate` has written, without any other part of nboom.
//!
//! ```sh
//! ./generate
//! cargo run --release
//! ```
//!
//! A satellite with two wings tumbles with its hinges free and no springs. The program
//! follows it by the classical Runge-Kutta method with the generated accelerations, and computes
//! the kinetic energy with the generated mass matrix. It ends with an error if the energy does not
//! stay what it was.

use satellite_wings::{HINGES, Kernel, equations, kernels, parameters};

/// Largest relative change of energy that the method's error explains.
const TOLERANCE: f64 = 1e-8;
const STEPS: usize = 2000;
const STEP: f64 = 1e-4;

/// A routine and its prepared constants.
struct Routine {
    kernel: Kernel,
    constants: Vec<f64>,
}

impl Routine {
    fn new(kernel: Kernel) -> Self {
        let mut constants = vec![0.0; kernel.constants];
        kernel.prepare(parameters(), &mut constants);
        Self { kernel, constants }
    }

    /// What it gives for a motion without torques.
    fn evaluate(&self, motion: &[f64]) -> Vec<f64> {
        let mut state = vec![0.0; self.kernel.coordinates];
        state[..3].copy_from_slice(&motion[3..6]);
        for (i, hinge) in HINGES.iter().enumerate() {
            state[hinge.rate] = motion[6 + i];
            state[hinge.angle] = motion[6 + HINGES.len() + i];
        }
        let mut found = vec![0.0; self.kernel.outputs];
        self.kernel.evaluate(&self.constants, &state, &mut found);
        found
    }
}

/// Rates of the velocity of O and of ω along the main body's axes, of the hinges' rates and of
/// their angles; the motion has the same order.
fn rates(routine: &Routine, motion: &[f64]) -> Vec<f64> {
    let found = routine.evaluate(motion);
    let (v, w) = (&motion[..3], &motion[3..6]);
    let mut rates = vec![
        found[3] - (w[1] * v[2] - w[2] * v[1]),
        found[4] - (w[2] * v[0] - w[0] * v[2]),
        found[5] - (w[0] * v[1] - w[1] * v[0]),
    ];
    rates.extend(&found[..3]);
    rates.extend(HINGES.iter().map(|hinge| found[hinge.acceleration]));
    rates.extend(&motion[6..6 + HINGES.len()]);
    rates
}

fn step(routine: &Routine, motion: &mut [f64]) {
    let moved = |by: &[f64], h: f64| -> Vec<f64> {
        motion.iter().zip(by).map(|(y, rate)| y + h * rate).collect()
    };
    let k1 = rates(routine, motion);
    let k2 = rates(routine, &moved(&k1, 0.5 * STEP));
    let k3 = rates(routine, &moved(&k2, 0.5 * STEP));
    let k4 = rates(routine, &moved(&k3, STEP));
    for (i, y) in motion.iter_mut().enumerate() {
        *y += STEP / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
    }
}

/// Half of v B₀ v with v the velocities of O, ω and the hinges' rates.
fn energy(matrix: &Routine, motion: &[f64]) -> f64 {
    let size = 6 + HINGES.len();
    let entries = matrix.evaluate(motion);
    let velocities = &motion[..size];
    let row = |i: usize| -> f64 {
        entries[i * size..][..size].iter().zip(velocities).map(|(b, v)| b * v).sum()
    };
    0.5 * (0..size).map(|i| velocities[i] * row(i)).sum::<f64>()
}

fn main() -> Result<(), String> {
    let (accelerations, matrix) = (Routine::new(kernels()[0]), Routine::new(*equations()));
    println!("topology {}, {} code", matrix.kernel.topology, matrix.kernel.instructions);
    let mut motion = vec![0.0; 6 + 2 * HINGES.len()];
    motion[3..6].copy_from_slice(&[10.0, 0.5, 0.0]);
    motion[6 + HINGES.len()..].fill(0.4);
    let before = energy(&matrix, &motion);
    for _ in 0..STEPS {
        step(&accelerations, &mut motion);
    }
    for (i, hinge) in HINGES.iter().enumerate() {
        let angle = motion[6 + HINGES.len() + i];
        println!("hinge {},{} has turned to {angle:.6} rad", hinge.appendage, hinge.segment);
    }
    let change = (energy(&matrix, &motion) - before) / before;
    println!("energy {before:.6}, relative change {change:.1e}");
    if change.abs() < TOLERANCE { Ok(()) } else { Err("energy is not conserved".to_owned()) }
}
