use nboom_scalar::{Number, Vec3, Wrench};

use crate::{Recursive, ldl};

/// The exact change of all velocities when hinges lock in one instant, Section 7.
///
/// Positions, linear and angular momentum are unchanged; hinges that are held stay rigid.
#[derive(Clone, Debug, PartialEq)]
pub struct LockUp<R> {
    /// Λ: impulsive torque at each locking hinge on the outboard side, positive along the axis.
    pub impulses: Vec<R>,
    /// Change of ω, main-body axes \[rad/T\].
    pub delta_omega_body: Vec3<R>,
    /// Change of V, inertial velocity of O, main-body axes \[L/T\].
    pub delta_velocity_body: Vec3<R>,
    /// Change of τ of the free hinges, the locking ones included \[rad/T\].
    pub delta_tau: Vec<R>,
    /// What of this each impulsive torque contributes.
    pub jumps: Vec<VelocityJump<R>>,
    /// Change of kinetic energy ½ Λ·τ, never positive (Carnot).
    pub delta_energy: R,
}

/// The change of all velocities by one impulsive torque at a hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityJump<R> {
    /// Of ω, main-body axes \[rad/T\].
    pub omega_body: Vec3<R>,
    /// Of V, inertial velocity of O, main-body axes \[L/T\].
    pub velocity_body: Vec3<R>,
    /// Of τ of the free hinges \[rad/T\].
    pub tau: Vec<R>,
}

/// Why no impulse locks these hinges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the mass matrix of the locking hinges is singular")]
pub struct LockUpError;

impl<R: Number> Recursive<R> {
    /// Locks the free hinges at positions `locking` (in [`Recursive::free_hinges`]) at once.
    ///
    /// Λ = −(Eᵀ B₀⁻¹ E)⁻¹ Eᵀ τ and Δ(V, ω, τ) = B₀⁻¹ E Λ, eqs. (7.4) to (7.6) for any number of
    /// hinges; E picks the locking ones. `beta` and `tau` belong to the free hinges.
    ///
    /// # Errors
    /// When Eᵀ B₀⁻¹ E is not positive definite.
    pub fn lock_up(
        &mut self,
        beta: &[R],
        tau: &[R],
        locking: &[usize],
    ) -> Result<LockUp<R>, LockUpError> {
        self.factor(beta);
        let responses: Vec<VelocityJump<R>> =
            locking.iter().map(|&j| self.response_to(j)).collect();
        let row = |&i: &usize| responses.iter().map(|response| response.tau[i]).collect();
        let mut compliance: Vec<Vec<R>> = locking.iter().map(row).collect();
        let mut impulses: Vec<R> = locking.iter().map(|&j| -tau[j]).collect();
        let mut inverse_pivots = vec![R::zero(); locking.len()];
        ldl::factor(&mut compliance, &mut inverse_pivots);
        if !ldl::is_positive_definite(&inverse_pivots) {
            return Err(LockUpError);
        }
        ldl::solve(&compliance, &inverse_pivots, &mut impulses);
        let mut lock_up = LockUp {
            impulses: Vec::new(),
            delta_omega_body: Vec3::zero(),
            delta_velocity_body: Vec3::zero(),
            delta_tau: vec![R::zero(); tau.len()],
            jumps: Vec::new(),
            delta_energy: R::zero(),
        };
        for ((response, &impulse), &j) in responses.iter().zip(&impulses).zip(locking) {
            let jump = VelocityJump {
                omega_body: response.omega_body * impulse,
                velocity_body: response.velocity_body * impulse,
                tau: response.tau.iter().map(|&change| change * impulse).collect(),
            };
            lock_up.delta_omega_body += jump.omega_body;
            lock_up.delta_velocity_body += jump.velocity_body;
            lock_up.delta_energy += R::constant(0.5) * (impulse * tau[j]);
            for (total, &change) in lock_up.delta_tau.iter_mut().zip(&jump.tau) {
                *total += change;
            }
            lock_up.jumps.push(jump);
        }
        Ok(LockUp { impulses, ..lock_up })
    }

    /// The velocity jump for a unit impulsive torque at link `j`: one column of B₀⁻¹.
    pub(crate) fn response_to(&mut self, j: usize) -> VelocityJump<R> {
        self.wrenches.fill(Wrench::zero());
        let mut tau = vec![R::zero(); self.wrenches.len()];
        tau[j] = R::one();
        let of_main = self.solve(Wrench::zero(), &mut tau);
        VelocityJump { omega_body: of_main.angular, velocity_body: of_main.linear, tau }
    }
}
