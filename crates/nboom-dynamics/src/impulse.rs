use nboom_scalar::{Number, Real, Twist, Vec3, Wrench};

use crate::{Recursive, ldl};

/// The exact change of all velocities when hinges lock in one instant, Section 7.
///
/// Positions are unchanged, and of a free main body linear and angular momentum; hinges that are held stay
/// rigid.
#[derive(Clone, Debug)]
pub struct LockUp<R> {
    /// Λ: impulsive torque at each locking hinge on the outboard side, positive along the axis.
    pub impulses: Vec<R>,
    /// Change of ω, main-body axes \[rad/T\].
    pub delta_omega_body: Vec3<R>,
    /// Change of V, inertial velocity of O, main-body axes \[L/T\].
    pub delta_velocity_body: Vec3<R>,
    /// Change of τ of the free hinges, the locking ones included \[rad/T\].
    pub delta_tau: Vec<R>,
    /// Change of kinetic energy ½ Λ·τ, never positive (Carnot).
    pub delta_energy: R,
    /// For each impulsive torque, what it changes of the main body's velocities.
    of_main: Vec<Twist<R>>,
    /// Likewise of τ of the free hinges, one torque after the other.
    of_hinges: Vec<R>,
    /// Rows of Eᵀ B₀⁻¹ E; there may be more rows than hinges that lock.
    compliance: Vec<Vec<R>>,
    inverse_pivots: Vec<R>,
}

/// The change of all velocities by one impulsive torque at a hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityJump<'a, R> {
    /// Of ω, main-body axes \[rad/T\].
    pub omega_body: Vec3<R>,
    /// Of V, inertial velocity of O, main-body axes \[L/T\].
    pub velocity_body: Vec3<R>,
    /// Of τ of the free hinges \[rad/T\].
    pub tau: &'a [R],
}

impl<R: Real> LockUp<R> {
    /// That of no hinge.
    pub fn of_none() -> Self {
        Self {
            impulses: Vec::new(),
            delta_omega_body: Vec3::zero(),
            delta_velocity_body: Vec3::zero(),
            delta_tau: Vec::new(),
            delta_energy: R::zero(),
            of_main: Vec::new(),
            of_hinges: Vec::new(),
            compliance: Vec::new(),
            inverse_pivots: Vec::new(),
        }
    }

    /// What each impulsive torque contributes to the changes.
    pub fn jumps(&self) -> impl Iterator<Item = VelocityJump<'_, R>> {
        let of_hinges = self.of_hinges.chunks_exact(self.delta_tau.len().max(1));
        self.of_main.iter().zip(of_hinges).map(|(of_main, tau)| VelocityJump {
            omega_body: of_main.angular,
            velocity_body: of_main.linear,
            tau,
        })
    }

    /// Makes it that of no hinge, with room for `locking` of the `free` hinges; nothing is
    /// allocated where there was as much room before.
    pub fn reset(&mut self, locking: usize, free: usize) {
        (self.delta_omega_body, self.delta_velocity_body) = (Vec3::zero(), Vec3::zero());
        self.delta_energy = R::zero();
        self.of_main.clear();
        self.of_main.resize(locking, Twist::zero());
        for (buffer, size) in [
            (&mut self.impulses, locking),
            (&mut self.inverse_pivots, locking),
            (&mut self.delta_tau, free),
            (&mut self.of_hinges, locking * free),
        ] {
            buffer.clear();
            buffer.resize(size, R::zero());
        }
        let rows = self.compliance.len().max(locking);
        self.compliance.resize_with(rows, Vec::new);
        for row in &mut self.compliance {
            row.resize(locking, R::zero());
        }
    }
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
    /// When Eᵀ B₀⁻¹ E is not positive definite; `out` then has no meaning.
    pub fn lock_up(
        &mut self,
        beta: &[R],
        tau: &[R],
        locking: &[usize],
        out: &mut LockUp<R>,
    ) -> Result<(), LockUpError> {
        self.factor(beta);
        let free = tau.len();
        out.reset(locking.len(), free);
        let LockUp { impulses, of_main, of_hinges, compliance, inverse_pivots, .. } = out;
        for (k, &j) in locking.iter().enumerate() {
            of_main[k] = self.response_to(j, &mut of_hinges[k * free..][..free]);
            impulses[k] = -tau[j];
        }
        let rows = &mut compliance[..locking.len()];
        for (row, &i) in rows.iter_mut().zip(locking) {
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = of_hinges[k * free + i];
            }
        }
        ldl::factor(rows, inverse_pivots);
        if !ldl::is_positive_definite(inverse_pivots) {
            return Err(LockUpError);
        }
        ldl::solve(rows, inverse_pivots, impulses);
        for (k, &j) in locking.iter().enumerate() {
            out.add_impulse(k, tau[j]);
        }
        Ok(())
    }

    /// Writes the change of τ for a unit impulsive torque at link `j`, and returns that of the main
    /// body's velocities: one column of B₀⁻¹.
    pub(crate) fn response_to(&mut self, j: usize, tau: &mut [R]) -> Twist<R> {
        self.wrenches.fill(Wrench::zero());
        tau.fill(R::zero());
        tau[j] = R::one();
        let held = self.tree.held.map(|_| Twist::zero());
        self.solve(Wrench::zero(), held, tau)
    }
}

impl<R: Number> LockUp<R> {
    /// Adds what the impulsive torque `k` changes, of whose hinge the rate before is `tau`; its jump
    /// is that for a unit torque so far.
    fn add_impulse(&mut self, k: usize, tau: R) {
        let impulse = self.impulses[k];
        let of_main = &mut self.of_main[k];
        *of_main = Twist { angular: of_main.angular * impulse, linear: of_main.linear * impulse };
        self.delta_omega_body += of_main.angular;
        self.delta_velocity_body += of_main.linear;
        self.delta_energy += R::constant(0.5) * (impulse * tau);
        let free = self.delta_tau.len();
        let of_hinges = &mut self.of_hinges[k * free..][..free];
        for (total, change) in self.delta_tau.iter_mut().zip(of_hinges) {
            *change = *change * impulse;
            *total += *change;
        }
    }
}
