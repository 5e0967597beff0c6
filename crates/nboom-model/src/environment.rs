use nboom_scalar::{Quaternion, Vec3};

/// Uniform gravity: the force on mass m is −g m ĝ, eq. (6.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    /// g \[L/T²\], positive.
    pub acceleration: f64,
    /// ĝ, unit vector away from the attracting centre, inertial axes.
    pub up: Vec3<f64>,
}

/// Motion of the main body at the initial time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialMotion {
    /// Initial time \[T\].
    pub time: f64,
    /// Attitude: turns main-body components into inertial ones.
    pub attitude: Quaternion<f64>,
    /// Position of O, inertial axes \[L\].
    pub position_inertial: Vec3<f64>,
    /// Inertial velocity of O, inertial axes \[L/T\].
    pub velocity_inertial: Vec3<f64>,
    /// ω, angular rate of the main body, main-body axes \[rad/T\].
    pub omega_body: Vec3<f64>,
}

impl InitialMotion {
    /// At rest at the inertial origin at time zero, axes along the inertial ones.
    pub fn at_rest() -> Self {
        Self {
            time: 0.0,
            attitude: Quaternion::identity(),
            position_inertial: Vec3::zero(),
            velocity_inertial: Vec3::zero(),
            omega_body: Vec3::zero(),
        }
    }
}
