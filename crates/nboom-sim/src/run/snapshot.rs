use nboom_dynamics::{Motion, Recursive};
use nboom_model::{Mode, Scene};
use nboom_scalar::{Number, Quaternion};

use crate::equations::Equations;
use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::run::record::{Detail, Snapshot};
use crate::run::step_motion::Forces;

/// What a recorder that needs no detail sees of `state`; `dynamics` is in `mode`.
pub(crate) fn take<R: Number>(
    scene: &Scene,
    mode: &Mode,
    dynamics: &mut Recursive<R>,
    state: &State<R>,
) -> Snapshot {
    let found = state.invariants(dynamics);
    let to_inertial = state.attitude.to_matrix();
    let numbers = |all: &[R]| -> Vec<f64> { all.iter().map(|x| x.to_f64()).collect() };
    let (beta, tau) = (numbers(&state.beta), numbers(&state.tau));
    let (mut alpha, mut sigma) = (beta.clone(), tau.clone());
    scene.accumulate_along_appendages(&mut alpha);
    scene.accumulate_along_appendages(&mut sigma);
    let Quaternion { scalar, vector } = state.attitude;
    let now = Totals::of(state, &found);
    let h = found.angular_momentum.to_f64();
    Snapshot {
        time: state.time.to_f64(),
        position_inertial: (state.center.position - to_inertial * found.mass_center).to_f64(),
        velocity_inertial: (to_inertial * found.origin_velocity).to_f64(),
        attitude: Quaternion { scalar: scalar.to_f64(), vector: vector.to_f64() },
        omega_body: state.omega_body.to_f64(),
        beta,
        tau,
        alpha,
        sigma,
        hinges: mode.hinges.clone(),
        kinetic_energy: now.kinetic_energy,
        linear_momentum_inertial: now.linear_momentum_inertial,
        angular_momentum_inertial: now.angular_momentum_inertial,
        nutation: h.y.hypot(h.z).atan2(h.x),
        detail: None,
        steps: 0,
        next_step: 0.0,
    }
}

/// Accelerations and forces of `state` in the mode that `equations` are in.
pub(crate) fn detail(scene: &Scene, equations: &mut Equations, state: &State) -> Detail {
    let mass_center_body = state.invariants(&mut equations.dynamics).mass_center;
    let [free_beta, free_tau] = state.of_free(&equations.dynamics);
    let motion = Motion { omega_body: state.omega_body, beta: &free_beta, tau: &free_tau };
    let accelerations = equations.accelerations(&motion);
    let omega_dot_body = accelerations.omega_dot_body;
    let origin_acceleration_body = accelerations.origin_body;
    let (mut beta, mut tau) = (state.beta.clone(), state.tau.clone());
    let mut beta_ddot = vec![0.0; beta.len()];
    equations.spread(&motion, [&mut beta, &mut tau, &mut beta_ddot]);
    let mut alpha_ddot = beta_ddot.clone();
    scene.accumulate_along_appendages(&mut alpha_ddot);
    let mut forces = Forces::new(equations.dynamics.elements());
    forces.set(&mut equations.dynamics, [&beta, &tau], &free_beta);
    Detail {
        omega_dot_body,
        origin_acceleration_body,
        beta_ddot,
        alpha_ddot,
        hinge_torque: forces.torque,
        lines: forces.lines,
        mass_center_body,
        mass_center_inertial: state.center.position,
        mass_center_velocity_inertial: state.center.velocity,
        mass_center_acceleration_inertial: equations.center_acceleration(state),
    }
}
