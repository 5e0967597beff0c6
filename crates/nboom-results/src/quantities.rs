//! What a row of the table of states has beside the time.

use nboom_scalar::Vec3;
use nboom_sim::Snapshot;

/// A quantity of the table of states, in one column or in three.
#[derive(Debug)]
pub struct Quantity {
    /// Names of its columns, in files; the columns of a hinge have its numbers after that.
    pub columns: &'static [&'static str],
    /// Its unit, made of those of length L, time T and force F.
    pub unit: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    pub(crate) value: Value,
}

/// How a quantity follows from a snapshot.
#[derive(Debug)]
pub(crate) enum Value {
    Number(fn(&Snapshot) -> f64),
    Vector(fn(&Snapshot) -> Vec3<f64>),
    /// Of one hinge.
    OfHinge(fn(&Snapshot, usize) -> f64),
    /// A small whole number of one hinge.
    CodeOfHinge(fn(&Snapshot, usize) -> i8),
}

const fn number(
    columns: &'static [&'static str; 1],
    unit: &'static str,
    about: &'static str,
    value: fn(&Snapshot) -> f64,
) -> Quantity {
    Quantity { columns, unit, about, value: Value::Number(value) }
}

const fn vector(
    columns: &'static [&'static str; 3],
    unit: &'static str,
    about: &'static str,
    value: fn(&Snapshot) -> Vec3<f64>,
) -> Quantity {
    Quantity { columns, unit, about, value: Value::Vector(value) }
}

const fn of_hinge(
    columns: &'static [&'static str; 1],
    unit: &'static str,
    about: &'static str,
    value: fn(&Snapshot, usize) -> f64,
) -> Quantity {
    Quantity { columns, unit, about, value: Value::OfHinge(value) }
}

/// Those before the hinges, in the order of their columns.
pub static BEFORE_HINGES: [Quantity; 5] = [
    vector(&["rho_x", "rho_y", "rho_z"], "L", "position of O, inertial axes", |s| {
        s.position_inertial
    }),
    vector(&["v_x", "v_y", "v_z"], "L/T", "inertial velocity of O, inertial axes", |s| {
        s.velocity_inertial
    }),
    number(&["chi"], "1", "scalar of the attitude's quaternion", |s| s.attitude.scalar),
    vector(
        &["kappa_x", "kappa_y", "kappa_z"],
        "1",
        "vector of the attitude's quaternion, which turns main-body components into inertial ones",
        |s| s.attitude.vector,
    ),
    vector(
        &["omega_x", "omega_y", "omega_z"],
        "rad/T",
        "angular rate of the main body, main-body axes",
        |s| s.omega_body,
    ),
];

/// Those of each hinge, in the order of their columns.
pub static OF_A_HINGE: [Quantity; 5] = [
    of_hinge(&["beta"], "rad", "angle relative to the inboard body", |s, i| s.beta[i]),
    of_hinge(&["tau"], "rad/T", "rate relative to the inboard body", |s, i| s.tau[i]),
    of_hinge(&["alpha"], "rad", "sum of angles along the appendage", |s, i| s.alpha[i]),
    of_hinge(&["sigma"], "rad/T", "sum of rates along the appendage", |s, i| s.sigma[i]),
    Quantity {
        columns: &["state"],
        unit: "1",
        about: "-1 unreleased, 0 free, 1 locked",
        value: Value::CodeOfHinge(|s, i| s.hinges[i].code()),
    },
];

/// Those after the hinges, in the order of their columns.
pub static AFTER_HINGES: [Quantity; 4] = [
    number(&["kinetic_energy"], "F L", "kinetic energy", |s| s.kinetic_energy),
    vector(
        &["linear_momentum_x", "linear_momentum_y", "linear_momentum_z"],
        "F T",
        "linear momentum, inertial axes",
        |s| s.linear_momentum_inertial,
    ),
    vector(
        &["angular_momentum_x", "angular_momentum_y", "angular_momentum_z"],
        "F L T",
        "angular momentum about the system mass centre, inertial axes",
        |s| s.angular_momentum_inertial,
    ),
    number(
        &["nutation"],
        "rad",
        "angle between angular momentum and the main body's x axis",
        |s| s.nutation,
    ),
];
