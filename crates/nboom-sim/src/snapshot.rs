use nboom_elements::KickOffLaw;
use nboom_model::{Mode, Scene};
use nboom_scalar::Vec3;

use crate::equations::Equations;
use crate::record::{Detail, Snapshot};
use crate::state::State;

/// What a recorder sees of `state` in the mode that `equations` are in.
pub(crate) fn take(
    scene: &Scene,
    mode: &Mode,
    equations: &mut Equations,
    state: &State,
    with_detail: bool,
) -> Snapshot {
    let found = equations.invariants(state);
    let to_inertial = state.attitude.to_matrix();
    let (mut alpha, mut sigma) = (state.beta.clone(), state.tau.clone());
    scene.accumulate_along_appendages(&mut alpha);
    scene.accumulate_along_appendages(&mut sigma);
    let h = found.angular_momentum;
    Snapshot {
        time: state.time,
        position_inertial: state.center.position - to_inertial * found.mass_center,
        velocity_inertial: to_inertial * found.origin_velocity,
        attitude: state.attitude,
        omega_body: state.omega_body,
        beta: state.beta.clone(),
        tau: state.tau.clone(),
        alpha,
        sigma,
        hinges: mode.hinges.clone(),
        kinetic_energy: found.kinetic_energy,
        linear_momentum_inertial: to_inertial * found.linear_momentum,
        angular_momentum_inertial: to_inertial * h,
        nutation: h.y.hypot(h.z).atan2(h.x),
        detail: with_detail.then(|| detail(scene, mode, equations, state, found.mass_center)),
        steps: 0,
        next_step: 0.0,
    }
}

fn detail(
    scene: &Scene,
    mode: &Mode,
    equations: &mut Equations,
    state: &State,
    mass_center_body: Vec3<f64>,
) -> Detail {
    let free = equations.dynamics.free_hinges().to_vec();
    let accelerations = equations.accelerations(state);
    let omega_dot_body = accelerations.omega_dot_body;
    let origin_acceleration_body = accelerations.origin_body;
    let mut beta_ddot = vec![0.0; state.beta.len()];
    for (&i, &tau_dot) in free.iter().zip(&accelerations.tau_dot) {
        beta_ddot[i] = tau_dot;
    }
    let mut alpha_ddot = beta_ddot.clone();
    scene.accumulate_along_appendages(&mut alpha_ddot);
    let laws = equations.laws().iter();
    let hinge_torque =
        laws.zip(state.beta.iter().zip(&state.tau)).map(|(law, (&b, &t))| law.torque(b, t));
    let hinge_torque = hinge_torque.collect();
    let (mut kick_off_force, mut kick_off_length) = (beta_ddot.clone(), beta_ddot.clone());
    for (i, body) in scene.bodies.iter().enumerate() {
        let (length, _) = equations.spring_length(state, i);
        let acting = body.hinge.kick_off.filter(|_| mode.kick_off[i]);
        kick_off_length[i] = length;
        kick_off_force[i] =
            acting.map_or(0.0, |spring| KickOffLaw::new(spring.coefficients).force(length));
    }
    Detail {
        omega_dot_body,
        origin_acceleration_body,
        beta_ddot,
        alpha_ddot,
        hinge_torque,
        kick_off_pushes: mode.kick_off.clone(),
        kick_off_force,
        kick_off_length,
        mass_center_body,
        mass_center_inertial: state.center.position,
        mass_center_velocity_inertial: state.center.velocity,
        mass_center_acceleration_inertial: equations.center_acceleration(state),
    }
}
