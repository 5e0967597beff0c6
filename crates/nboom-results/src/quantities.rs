//! How the columns of a table of the motion follow from a snapshot.

use nboom_model::{Column, Quantity};
use nboom_scalar::{Vec3, Wrench};
use nboom_sim::Snapshot;

/// What stands in a column.
pub(crate) enum Cell {
    Number(f64),
    /// A small whole number.
    Code(i8),
}

/// Of a snapshot with detail, of a scene whose main body is held.
fn reaction(s: &Snapshot) -> Wrench<f64> {
    s.detail.as_ref().and_then(|detail| detail.reaction).unwrap_or(Wrench::zero())
}

/// Of a snapshot with detail.
fn motor_torque(s: &Snapshot, rotor: usize) -> f64 {
    s.detail.as_ref().map_or(0.0, |detail| detail.motor_torques[rotor])
}

/// What a column has at the time of a snapshot, angles in radians.
pub(crate) fn cell(column: &Column, s: &Snapshot) -> Cell {
    let vector = |vector: Vec3<f64>| vector.to_array()[column.component];
    let hinge = column.hinge.unwrap_or_default();
    Cell::Number(match column.quantity {
        Quantity::Position => vector(s.position_inertial),
        Quantity::Velocity => vector(s.velocity_inertial),
        Quantity::AttitudeScalar => s.attitude.scalar,
        Quantity::AttitudeVector => vector(s.attitude.vector),
        Quantity::AngularRate => vector(s.omega_body),
        Quantity::Angle => s.beta[hinge],
        Quantity::Rate => s.tau[hinge],
        Quantity::AngleSum => s.alpha[hinge],
        Quantity::RateSum => s.sigma[hinge],
        Quantity::State => return Cell::Code(s.hinges[hinge].code()),
        Quantity::KineticEnergy => s.kinetic_energy,
        Quantity::LinearMomentum => vector(s.linear_momentum_inertial),
        Quantity::AngularMomentum => vector(s.angular_momentum_inertial),
        Quantity::Nutation => s.nutation,
        Quantity::ReactionForce => vector(reaction(s).force),
        Quantity::ReactionMoment => vector(reaction(s).moment),
        Quantity::RotorSpeed => s.rotor_speeds[column.component],
        Quantity::MotorTorque => motor_torque(s, column.component),
    })
}

/// What a column of a table of the motion has at the time of a snapshot, angles in radians; the state of a
/// hinge is its number in tables. Columns that take an evaluation of the equations of motion
/// ([`WantedTable::needs_detail`](nboom_model::WantedTable::needs_detail)) are zero without detail.
pub fn quantity(column: &Column, snapshot: &Snapshot) -> f64 {
    match cell(column, snapshot) {
        Cell::Number(value) => value,
        Cell::Code(code) => code.into(),
    }
}
