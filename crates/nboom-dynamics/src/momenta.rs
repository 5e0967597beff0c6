use nboom_model::Joint;
use nboom_scalar::{Number, Real, Twist, Vec3, Wrench};

use crate::{Motion, Recursive, composite_body};

/// Momenta conjugate to the motion about the mass centre, in place of ω and τ.
///
/// With the mass centre, the attitude and β as coordinates, the kinetic energy is ½ m_T v_c² + T,
/// and the momenta are those of T: H̄_c, and π_i = ∂T/∂τ_i at constant ω.
#[derive(Clone, Copy, Debug)]
pub struct Momenta<'a, R> {
    /// H̄_c: angular momentum about the system mass centre, main-body axes.
    pub angular_body: Vec3<R>,
    /// β of the free hinges \[rad\].
    pub beta: &'a [R],
    /// π of the free hinges.
    pub hinges: &'a [R],
}

/// The inertia that each momentum has to itself: what it must be to make a rate of one when all
/// other momenta are zero, 1 / (B⁻¹)_ii.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectiveInertias<R> {
    /// The least about the main-body axes.
    pub main: R,
    /// About the axes of the free hinges.
    pub hinges: Vec<R>,
}

impl<R: Real> Recursive<R> {
    /// Writes π of the free hinges to `hinges` and returns H̄_c, main-body axes.
    pub fn momenta(&mut self, motion: &Motion<'_, R>, hinges: &mut [R]) -> Vec3<R> {
        let found = self.invariants(motion, Vec3::zero());
        for twist in &mut self.twists {
            twist.linear += found.origin_velocity;
        }
        self.carry_momenta();
        for (pi, (pose, outboard)) in hinges.iter_mut().zip(self.poses.iter().zip(&self.wrenches)) {
            *pi = pose.along(outboard);
        }
        found.angular_momentum
    }

    /// Writes τ of the free hinges to `tau` and returns ω, main-body axes.
    ///
    /// The velocities that momenta make are the accelerations that equal moments and torques make
    /// of a satellite at rest, so the elimination of the accelerations finds them, without a bias.
    #[inline(always)]
    pub fn velocities(&mut self, momenta: &Momenta<'_, R>, tau: &mut [R]) -> Vec3<R> {
        self.factor(momenta.beta);
        tau.copy_from_slice(momenta.hinges);
        self.wrenches.fill(Wrench::zero());
        let main = Wrench { moment: -momenta.angular_body, force: Vec3::zero() };
        self.solve(main, None, tau).angular
    }

    /// Writes τ and π̇ of the free hinges to `tau` and `rates`, and returns ω, main-body axes.
    ///
    /// π̇ = torque + (ω̄ × ā)·H̄ + (v̄ × ā)·p̄ − (ā × d̄)·F̄ / m_T, with ā the hinge axis, ω̄ and v̄ the
    /// motion of the hinge relative to the mass centre, H̄, p̄ and d̄ the momenta and the first moment of
    /// everything outboard about the hinge, and F̄ the force from outside. Where the link slides along ā,
    /// π̇ = force + (ω̄ × ā)·p̄ − m ā·F̄ / m_T with m the mass of everything outboard.
    #[inline(always)]
    pub fn momentum_rates(
        &mut self,
        momenta: &Momenta<'_, R>,
        tau: &mut [R],
        rates: &mut [R],
    ) -> Vec3<R> {
        let omega_body = self.velocities(momenta, tau);
        self.hinge_forces(&Motion { omega_body, beta: momenta.beta, tau }, rates);
        self.carry_momenta();
        let moving = self.twists.iter().zip(&self.wrenches);
        for (rate, (pose, (twist, outboard))) in rates.iter_mut().zip(self.poses.iter().zip(moving))
        {
            // An axis turns with its bodies, and that of a hinge moves with it.
            let turning = twist.angular.cross(pose.axis);
            *rate += match pose.joint {
                Joint::Revolute => {
                    let moving = twist.linear.cross(pose.axis);
                    turning.dot(outboard.moment) + moving.dot(outboard.force)
                }
                Joint::Prismatic => turning.dot(outboard.force),
            };
        }
        if self.elements.acts_from_outside() {
            let of_center = self.acting_from_outside().force
                * (R::one() / R::constant(self.scene.total_mass()));
            self.twists.fill(Twist { angular: Vec3::zero(), linear: of_center });
            self.carry_momenta();
            for (rate, (pose, left_behind)) in
                rates.iter_mut().zip(self.poses.iter().zip(&self.wrenches))
            {
                *rate -= pose.along(left_behind);
            }
        }
        omega_body
    }

    /// Sets `wrenches` to the momenta of everything outboard about each hinge, of links that move
    /// as `twists`.
    #[inline(always)]
    fn carry_momenta(&mut self) {
        let Self { tree, poses, twists, wrenches, .. } = self;
        for (wrench, (pose, &twist)) in wrenches.iter_mut().zip(poses.iter().zip(&*twists)) {
            *wrench = pose.inertia.momentum(twist);
        }
        composite_body::carry_inward(tree, poses, wrenches, Wrench::zero());
    }
}

impl<R: Number> Recursive<R> {
    /// The effective inertias at the angles `beta` of the free hinges.
    pub fn effective_inertias(&mut self, beta: &[R]) -> EffectiveInertias<R> {
        self.factor(beta);
        let mut tau = vec![R::zero(); beta.len()];
        let mut largest = R::zero();
        for axis in [Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()] {
            self.wrenches.fill(Wrench::zero());
            tau.fill(R::zero());
            let moment = Wrench { moment: -axis, force: Vec3::zero() };
            let rate = self.solve(moment, None, &mut tau).angular.dot(axis);
            largest = if rate.to_f64() > largest.to_f64() { rate } else { largest };
        }
        let of_hinge = |j: usize| {
            self.response_to(j, &mut tau);
            R::one() / tau[j]
        };
        let hinges = (0..beta.len()).map(of_hinge).collect();
        EffectiveInertias { main: R::one() / largest, hinges }
    }
}
