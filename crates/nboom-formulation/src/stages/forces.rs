//! Steps that a right side takes beside those of the accelerations.

use nboom_elements::{CouplingLaw, HingeLaw};
use nboom_scalar::{Quaternion, Real};

use crate::parameters::Reader;
use crate::stages::{Group, OMEGA, Stage, TAU, TORQUE};

/// Attitude: χ, K̄.
pub const ATTITUDE: Group = Group::new("attitude", &["chi", "kx", "ky", "kz"]);
/// Rate of change of the attitude.
pub const ATTITUDE_RATE: Group =
    Group::new("attitude_rate", &["chi_dot", "kx_dot", "ky_dot", "kz_dot"]);
/// Parameters of the torque about a hinge.
pub const LAW: Group = Group::new("law", &["q1", "q2", "a3", "a2", "a1", "a0", "from"]);
/// Parameters of the line that pushes a link: its ends, and its force by powers of its length.
pub const LINE: Group =
    Group::new("line", &["px", "py", "pz", "ox", "oy", "oz", "f0", "f1", "f2", "f3"]);
/// Parameters of the coupling of a hinge with the one inboard of it.
pub const COUPLING: Group =
    Group::new("coupling", &["own_weight", "inboard_weight", "stiffness", "rest", "damping"]);
/// β of a hinge.
pub const BETA: Group = Group::new("beta", &["beta"]);
/// β of the hinge inboard of it.
pub const INBOARD_BETA: Group = Group::new("inboard_beta", &["inboard_beta"]);
/// τ of the hinge inboard of it.
pub const INBOARD_TAU: Group = Group::new("inboard_tau", &["inboard_tau"]);
/// The torque about the hinge inboard of it.
pub const INBOARD_TORQUE: Group = Group::new("inboard_torque", &["inboard_torque"]);
/// Power of the part of a hinge's torque that depends on its rate.
pub const POWER: Group = Group::new("power", &["power"]);

/// The rate of change of the attitude.
pub fn attitude<R: Real>() -> Stage<R> {
    Stage {
        name: "attitude",
        about: "The rate of change of the attitude.",
        parameters: vec![],
        inputs: vec![ATTITUDE, OMEGA],
        outputs: vec![ATTITUDE_RATE],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let attitude = Quaternion { scalar: reader.next(), vector: reader.vector() };
            let Quaternion { scalar, vector } = attitude.rate(reader.vector());
            vec![scalar, vector.x, vector.y, vector.z]
        }),
    }
}

/// The torque about a hinge.
pub fn law<R: Real>() -> Stage<R> {
    Stage {
        name: "law",
        about: "The torque of spring, dashpot and table about a hinge, and the power of what depends on its rate.",
        parameters: vec![LAW],
        inputs: vec![BETA, TAU],
        outputs: vec![TORQUE, POWER],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let law = HingeLaw::of_numbers(std::array::from_fn(|_| reader.next()));
            let (beta, tau) = (reader.next(), reader.next());
            vec![law.torque(beta, tau), law.rate_torque(tau) * tau]
        }),
    }
}

/// The torques of a coupling about a hinge and the one inboard of it.
pub fn coupling<R: Real>() -> Stage<R> {
    Stage {
        name: "coupling",
        about: "The torques of a coupling about a hinge and the one inboard of it, and the power of its damper.",
        parameters: vec![COUPLING],
        inputs: vec![BETA, INBOARD_BETA, TAU, INBOARD_TAU],
        outputs: vec![TORQUE, INBOARD_TORQUE, POWER],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let law = CouplingLaw::of_numbers(std::array::from_fn(|_| reader.next()));
            let beta = [reader.next(), reader.next()];
            let tau = [reader.next(), reader.next()];
            let [own, inboard] = law.torques(beta, tau);
            vec![own, inboard, law.rate_power(tau)]
        }),
    }
}
