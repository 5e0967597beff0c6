//! The quantities of a block of the printout, in the printout's units.

use nboom::scalar::Mat3;
use nboom::sim::Snapshot;

use crate::collect::{detail, forces_and_lengths};

/// The quantity that `data/printed_output.json` calls `name`, as the printout shows it.
pub fn value(name: &str, at: &Snapshot) -> f64 {
    let (kind, indices) = split(name);
    let i = indices.first().copied().unwrap_or(0);
    let detail = detail(at);
    let degrees = |all: &[f64]| all[i].to_degrees();
    match kind {
        "time" => at.time,
        "beta" => degrees(&at.beta),
        "tau" => degrees(&at.tau),
        "bdd" => degrees(&detail.beta_ddot),
        "alpha" => degrees(&at.alpha),
        "sigma" => degrees(&at.sigma),
        "add" => degrees(&detail.alpha_ddot),
        // The printout adds the two accelerations of a paddle, whose axes are not parallel.
        "add_cum" => (detail.beta_ddot[i - 1] + detail.beta_ddot[i]).to_degrees(),
        "torque" => detail.hinge_torque[i],
        "kick_force" => forces_and_lengths(&detail.lines, at.beta.len())[0][i],
        "kick_ext" => forces_and_lengths(&detail.lines, at.beta.len())[1][i],
        "omega" => at.omega_body.to_array()[i],
        "omega_dot" => detail.omega_dot_body.to_array()[i],
        "S" => detail.mass_center_body.to_array()[i],
        "rho" => at.position_inertial.to_array()[i],
        "cm" => detail.mass_center_inertial.to_array()[i],
        "vcm" => detail.mass_center_velocity_inertial.to_array()[i],
        "H" => at.angular_momentum_inertial.to_array()[i],
        "P" => at.linear_momentum_inertial.to_array()[i],
        "T" => at.kinetic_energy,
        "nutation" => at.nutation.to_degrees(),
        "euler" => euler_angles(&at.attitude.to_matrix())[i].to_degrees(),
        "M" => at.attitude.to_matrix().rows[i].to_array()[indices[1]],
        _ => panic!("the printout has no {name}"),
    }
}

/// The name without its indices, and those.
pub fn split(name: &str) -> (&str, Vec<usize>) {
    let mut parts = name.split('[');
    let kind = parts.next().expect("a name");
    let index = |part: &str| part.trim_end_matches(']').parse().expect("an index");
    (kind, parts.map(index).collect())
}

/// ψ, θ, φ with M = R_x(ψ) R_y(θ) R_x(φ), eq. (9.7); zero where M is the identity.
fn euler_angles(m: &Mat3<f64>) -> [f64; 3] {
    let [first, second, third] = m.rows;
    let theta = first.y.hypot(first.z).atan2(first.x);
    if theta == 0.0 {
        return [0.0; 3];
    }
    [second.x.atan2(-third.x), theta, first.y.atan2(first.z)]
}
