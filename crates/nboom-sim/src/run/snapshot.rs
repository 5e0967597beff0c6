use nboom_dynamics::Invariants;
use nboom_model::{Mode, Scene};
use nboom_scalar::{Number, Quaternion, Vec3};

use crate::equations::Equations;
use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::run::record::{Detail, Snapshot};
use crate::run::step_motion::Room;

/// Writes to `out` what a recorder that needs no detail sees of `state` in `mode`, whose invariants
/// are `found`.
pub(crate) fn write<R: Number>(
    scene: &Scene,
    mode: &Mode,
    state: &State<R>,
    found: &Invariants<R>,
    out: &mut Snapshot,
) {
    let to_inertial = state.attitude.to_matrix();
    let copy = |from: &[R], to: &mut Vec<f64>| {
        to.clear();
        to.extend(from.iter().map(|x| x.to_f64()));
    };
    copy(&state.beta, &mut out.beta);
    copy(&state.tau, &mut out.tau);
    out.alpha.clone_from(&out.beta);
    out.sigma.clone_from(&out.tau);
    out.rotor_speeds.clear();
    out.rotor_speeds.extend(state.rotors.iter().map(|rotor| rotor.speed.to_f64()));
    scene.accumulate_along_appendages(&mut out.alpha);
    scene.accumulate_along_appendages(&mut out.sigma);
    out.hinges.clone_from(&mode.hinges);
    let Quaternion { scalar, vector } = state.attitude;
    out.time = state.time.to_f64();
    let free = || state.center.position - to_inertial * found.mass_center;
    out.position_inertial = state.held.map_or_else(free, |origin| origin.position).to_f64();
    out.velocity_inertial = (to_inertial * found.origin_velocity).to_f64();
    out.attitude = Quaternion { scalar: scalar.to_f64(), vector: vector.to_f64() };
    out.omega_body = state.omega_body.to_f64();
    let now = Totals::of(state, found);
    out.kinetic_energy = now.kinetic_energy;
    out.linear_momentum_inertial = now.linear_momentum_inertial;
    out.angular_momentum_inertial = now.angular_momentum_inertial;
    let h = found.angular_momentum.to_f64();
    out.nutation = h.y.hypot(h.z).atan2(h.x);
}

/// Writes accelerations and forces of `state` to `out`, in the mode that `equations` are in;
/// `mass_center_body` is S̄.
pub(crate) fn write_detail(
    equations: &mut Equations,
    state: &mut State,
    mass_center_body: Vec3<f64>,
    room: &mut Room,
    out: &mut Detail,
) {
    let Room { beta, tau, beta_ddot, forces, .. } = room;
    beta.copy_from_slice(&state.beta);
    tau.copy_from_slice(&state.tau);
    equations.entered.dynamics.set_outside(state.attitude, state.time);
    let motion = state.motion(&equations.entered.dynamics);
    beta_ddot.fill(0.0);
    let accelerations = equations.accelerations(&motion);
    out.omega_dot_body = accelerations.omega_dot_body;
    out.origin_acceleration_body = accelerations.origin_body;
    out.reaction = equations.reaction(&motion);
    equations.motor_torques(&motion, &mut out.motor_torques);
    equations.spread(&motion, [beta, tau, beta_ddot]);
    out.beta_ddot.clone_from(beta_ddot);
    out.alpha_ddot.clone_from(beta_ddot);
    equations.scene.accumulate_along_appendages(&mut out.alpha_ddot);
    let Equations { entered, own, .. } = equations;
    forces.set(&mut entered.dynamics, own, [beta, tau], motion.beta);
    out.hinge_torque.clone_from(&forces.torque);
    out.lines.clone_from(&forces.lines);
    out.outside.clone_from(&forces.outside);
    out.rotors.clone_from(&forces.rotors);
    out.mass_center_body = mass_center_body;
    out.mass_center_inertial = state.center.position;
    out.mass_center_velocity_inertial = state.center.velocity;
    out.mass_center_acceleration_inertial = equations.center_acceleration(state, out.reaction);
}
