use nalgebra::{DMatrix, DVector};
use nboom_scalar::{Vec3, Wrench};

use crate::Recursive;

/// The exact change of all velocities when hinges lock in one instant, Section 7.
///
/// Positions, linear and angular momentum are unchanged; hinges that are held stay rigid.
#[derive(Clone, Debug, PartialEq)]
pub struct LockUp {
    /// Λ: impulsive torque at each locking hinge on the outboard side, positive along the axis.
    pub impulses: Vec<f64>,
    /// Change of ω, main-body axes \[rad/T\].
    pub delta_omega_body: Vec3<f64>,
    /// Change of V, inertial velocity of O, main-body axes \[L/T\].
    pub delta_velocity_body: Vec3<f64>,
    /// Change of τ of the free hinges, the locking ones included \[rad/T\].
    pub delta_tau: Vec<f64>,
    /// What of this each impulsive torque contributes.
    pub jumps: Vec<VelocityJump>,
    /// Change of kinetic energy ½ Λ·τ, never positive (Carnot).
    pub delta_energy: f64,
}

/// The change of all velocities by one impulsive torque at a hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityJump {
    /// Of ω, main-body axes \[rad/T\].
    pub omega_body: Vec3<f64>,
    /// Of V, inertial velocity of O, main-body axes \[L/T\].
    pub velocity_body: Vec3<f64>,
    /// Of τ of the free hinges \[rad/T\].
    pub tau: Vec<f64>,
}

/// Why no impulse locks these hinges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the mass matrix of the locking hinges is singular")]
pub struct LockUpError;

impl Recursive<f64> {
    /// Locks the free hinges at positions `locking` (in [`Recursive::free_hinges`]) at once.
    ///
    /// Λ = −(Eᵀ B₀⁻¹ E)⁻¹ Eᵀ τ and Δ(V, ω, τ) = B₀⁻¹ E Λ, eqs. (7.4) to (7.6) for any number of
    /// hinges; E picks the locking ones. `beta` and `tau` belong to the free hinges.
    ///
    /// # Errors
    /// When Eᵀ B₀⁻¹ E is not positive definite.
    pub fn lock_up(
        &mut self,
        beta: &[f64],
        tau: &[f64],
        locking: &[usize],
    ) -> Result<LockUp, LockUpError> {
        self.factor(beta);
        let responses: Vec<VelocityJump> = locking.iter().map(|&j| self.response_to(j)).collect();
        let compliance = DMatrix::from_fn(locking.len(), locking.len(), |row, column| {
            responses[column].tau[locking[row]]
        });
        let rates = DVector::from_iterator(locking.len(), locking.iter().map(|&j| -tau[j]));
        let impulses = compliance.cholesky().ok_or(LockUpError)?.solve(&rates);
        let mut lock_up = LockUp {
            impulses: impulses.iter().copied().collect(),
            delta_omega_body: Vec3::zero(),
            delta_velocity_body: Vec3::zero(),
            delta_tau: vec![0.0; tau.len()],
            jumps: Vec::new(),
            delta_energy: -0.5 * impulses.dot(&rates),
        };
        for (response, &impulse) in responses.iter().zip(&impulses) {
            let jump = VelocityJump {
                omega_body: response.omega_body * impulse,
                velocity_body: response.velocity_body * impulse,
                tau: response.tau.iter().map(|change| change * impulse).collect(),
            };
            lock_up.delta_omega_body += jump.omega_body;
            lock_up.delta_velocity_body += jump.velocity_body;
            for (total, change) in lock_up.delta_tau.iter_mut().zip(&jump.tau) {
                *total += change;
            }
            lock_up.jumps.push(jump);
        }
        Ok(lock_up)
    }

    /// The velocity jump for a unit impulsive torque at link `j`: one column of B₀⁻¹.
    fn response_to(&mut self, j: usize) -> VelocityJump {
        self.wrenches.fill(Wrench::zero());
        let mut tau = vec![0.0; self.wrenches.len()];
        tau[j] = 1.0;
        let of_main = self.solve(Wrench::zero(), &mut tau);
        VelocityJump { omega_body: of_main.angular, velocity_body: of_main.linear, tau }
    }
}
