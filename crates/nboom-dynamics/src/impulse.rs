use nboom_scalar::{Number, Real, Twist, Vec3, Wrench};

use crate::{Recursive, ldl};

/// A free hinge whose rate an impulsive torque changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Struck<R> {
    /// Its position in [`Recursive::free_hinges`].
    pub position: usize,
    /// τ after the impulse \[rad/T\].
    pub after: R,
}

impl<R: Real> Struck<R> {
    /// A hinge that locks.
    pub fn locks(position: usize) -> Self {
        Self { position, after: R::zero() }
    }
}

/// The exact change of all velocities when hinges lock or rebound from their stops in one instant, Section 7.
///
/// Positions are unchanged, and of a free main body linear and angular momentum; hinges that are held stay
/// rigid.
#[derive(Clone, Debug)]
pub struct Impulses<R> {
    /// Λ: impulsive torque at each hinge that is struck on the outboard side, positive along the axis.
    pub torques: Vec<R>,
    /// Change of ω, main-body axes \[rad/T\].
    pub delta_omega_body: Vec3<R>,
    /// Change of V, inertial velocity of O, main-body axes \[L/T\].
    pub delta_velocity_body: Vec3<R>,
    /// Change of τ of the free hinges, those that are struck included \[rad/T\].
    pub delta_tau: Vec<R>,
    /// Change of kinetic energy, half of Λ times the sum of τ before and after; never positive where hinges lock
    /// (Carnot).
    pub delta_energy: R,
    /// For each impulsive torque, what it changes of the main body's velocities.
    of_main: Vec<Twist<R>>,
    /// Likewise of τ of the free hinges, one torque after the other.
    of_hinges: Vec<R>,
    /// Rows of Eᵀ B₀⁻¹ E; there may be more rows than hinges that are struck.
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

impl<R: Real> Impulses<R> {
    /// That of no hinge.
    pub fn of_none() -> Self {
        Self {
            torques: Vec::new(),
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

    /// Makes it that of no hinge, with room for so many `struck` of the `free` hinges; nothing is
    /// allocated where there was as much room before.
    pub fn reset(&mut self, struck: usize, free: usize) {
        (self.delta_omega_body, self.delta_velocity_body) = (Vec3::zero(), Vec3::zero());
        self.delta_energy = R::zero();
        self.of_main.clear();
        self.of_main.resize(struck, Twist::zero());
        for (buffer, size) in [
            (&mut self.torques, struck),
            (&mut self.inverse_pivots, struck),
            (&mut self.delta_tau, free),
            (&mut self.of_hinges, struck * free),
        ] {
            buffer.clear();
            buffer.resize(size, R::zero());
        }
        let rows = self.compliance.len().max(struck);
        self.compliance.resize_with(rows, Vec::new);
        for row in &mut self.compliance {
            row.resize(struck, R::zero());
        }
    }
}

/// Why no impulses stop these hinges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the mass matrix of the hinges that are struck is singular")]
pub struct ImpulseError;

impl<R: Number> Recursive<R> {
    /// Locks or turns back the hinges `struck` at once.
    ///
    /// Λ = (Eᵀ B₀⁻¹ E)⁻¹ (τ⁺ − Eᵀ τ) and Δ(V, ω, τ) = B₀⁻¹ E Λ, eqs. (7.4) to (7.6) for any number of
    /// hinges and rates τ⁺ after; E picks those that are struck. `beta` and `tau` belong to the free hinges.
    ///
    /// # Errors
    /// When Eᵀ B₀⁻¹ E is not positive definite; `out` then has no meaning.
    pub fn strike(
        &mut self,
        beta: &[R],
        tau: &[R],
        struck: &[Struck<R>],
        out: &mut Impulses<R>,
    ) -> Result<(), ImpulseError> {
        self.factor(beta);
        let free = tau.len();
        out.reset(struck.len(), free);
        let Impulses { torques, of_main, of_hinges, compliance, inverse_pivots, .. } = out;
        for (k, one) in struck.iter().enumerate() {
            of_main[k] = self.response_to(one.position, &mut of_hinges[k * free..][..free]);
            torques[k] = one.after - tau[one.position];
        }
        let rows = &mut compliance[..struck.len()];
        for (row, one) in rows.iter_mut().zip(struck) {
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = of_hinges[k * free + one.position];
            }
        }
        ldl::factor(rows, inverse_pivots);
        if !ldl::is_positive_definite(inverse_pivots) {
            return Err(ImpulseError);
        }
        ldl::solve(rows, inverse_pivots, torques);
        for (k, one) in struck.iter().enumerate() {
            out.add(k, tau[one.position] + one.after);
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

impl<R: Number> Impulses<R> {
    /// Adds what the impulsive torque `k` changes, at whose hinge the rates before and after are `rates` together; its
    /// jump is that for a unit torque so far.
    fn add(&mut self, k: usize, rates: R) {
        let impulse = self.torques[k];
        let of_main = &mut self.of_main[k];
        *of_main = Twist { angular: of_main.angular * impulse, linear: of_main.linear * impulse };
        self.delta_omega_body += of_main.angular;
        self.delta_velocity_body += of_main.linear;
        self.delta_energy += R::constant(0.5) * (impulse * rates);
        let free = self.delta_tau.len();
        let of_hinges = &mut self.of_hinges[k * free..][..free];
        for (total, change) in self.delta_tau.iter_mut().zip(of_hinges) {
            *change = *change * impulse;
            *total += *change;
        }
    }
}
