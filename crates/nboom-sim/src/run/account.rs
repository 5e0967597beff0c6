use crate::run::conservation::Conservation;

/// What became of energy and momentum since the initial time.
///
/// Kinetic and potential energy and the loss in lock-ups and impacts add up to the work done on top of the
/// initial energy, but for the potential energy that commands change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Account {
    /// Potential energy of springs and gravity.
    pub potential_energy: f64,
    /// Work of friction and of the rate-dependent torques at joints; negative where they damp.
    pub dashpot_work: f64,
    /// Work of what acts from outside, and of what moves a main body that is held.
    pub thrust_work: f64,
    /// Work of the motors of rotors, relative to what carries these.
    pub motor_work: f64,
    /// Kinetic energy taken away by lock-ups and impacts.
    pub lock_up_loss: f64,
    /// What momentum and energy are off by, relative to the largest of their scales up to now.
    pub residuals: Conservation,
}
