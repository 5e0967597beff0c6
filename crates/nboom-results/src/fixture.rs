//! Hand-made motions for the tests of the writers.

use nboom_elements::{Kind, LineReading};
use nboom_model::{HingeLabel, HingeState};
use nboom_scalar::{Quaternion, Vec3};
use nboom_sim::{Account, Detail, Event, EventKind, Snapshot, Totals};

pub(crate) fn labels() -> Vec<HingeLabel> {
    [(0, 0), (0, 1), (1, 0)].map(|(appendage, segment)| HingeLabel::new(appendage, segment)).into()
}

/// Three hinges: unreleased, free, locked. No two numbers are equal.
pub(crate) fn snapshot(time: f64) -> Snapshot {
    Snapshot {
        time,
        position_inertial: Vec3::new(1.0 / 3.0, -2e-7, 3e300),
        velocity_inertial: Vec3::new(4.1, 5.2, 6.3),
        attitude: Quaternion { scalar: 0.5, vector: Vec3::new(0.1, 0.7, 0.5) }.normalized(),
        omega_body: Vec3::new(0.01, 0.02, 0.03),
        beta: vec![0.5, std::f64::consts::FRAC_PI_2, 0.7],
        tau: vec![0.0, std::f64::consts::PI, -0.0],
        alpha: vec![0.5, 2.1, 0.71],
        sigma: vec![0.11, 0.12, 0.13],
        rotor_speeds: Vec::new(),
        hinges: vec![HingeState::Unreleased, HingeState::Free, HingeState::Locked],
        kinetic_energy: 12345.6789,
        linear_momentum_inertial: Vec3::new(7.1, 7.2, 7.3),
        angular_momentum_inertial: Vec3::new(8.1, 8.2, 8.3),
        nutation: std::f64::consts::FRAC_PI_4,
        detail: Some(detail()),
        account: Some(Account::default()),
        steps: 42,
        next_step: 0.125,
    }
}

fn detail() -> Detail {
    let kind = Kind::KickOff;
    let spring = LineReading { kind, hinge: 0, acts: true, force: 8.5, length: 8.01 };
    Detail {
        omega_dot_body: Vec3::new(0.31, 0.32, 0.33),
        origin_acceleration_body: Vec3::new(0.41, 0.42, 0.43),
        reaction: None,
        outside: Vec::new(),
        rotors: Vec::new(),
        motor_torques: Vec::new(),
        beta_ddot: vec![0.0, std::f64::consts::TAU, 0.0],
        alpha_ddot: vec![0.0, 1.5, 0.0],
        hinge_torque: vec![-0.4, -0.5, -0.6],
        lines: vec![spring],
        mass_center_body: Vec3::new(1.1, 1.2, 1.3),
        mass_center_inertial: Vec3::new(2.1, 2.2, 2.3),
        mass_center_velocity_inertial: Vec3::new(2.4, 2.5, 2.6),
        mass_center_acceleration_inertial: Vec3::new(2.7, 2.8, 2.9),
    }
}

/// An event that takes the energy from 3 to 2; a lock-up has the impulse −0.25.
pub(crate) fn event(time: f64, kind: EventKind, hinge: Option<usize>) -> Event {
    let has_impulse = matches!(kind, EventKind::LockUp | EventKind::Impact);
    let impulse = has_impulse.then_some(-0.25);
    Event { time, kind, hinge, impulse, before: totals(3.0), after: totals(2.0) }
}

fn totals(kinetic_energy: f64) -> Totals {
    Totals {
        kinetic_energy,
        linear_momentum_inertial: Vec3::zero(),
        angular_momentum_inertial: Vec3::unit_x(),
    }
}
