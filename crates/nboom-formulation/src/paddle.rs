//! The outer hinge of a paddle, whose axis η is square to the arm's hinge, in appendage axes.

use nboom_scalar::{ArticulatedInertia, Mat3, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::chain::{OutboardShare, Outward, Spin, Turned};
use crate::parameters::Reader;

/// What eliminating the paddle's hinge leaves for the way back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paddle<R> {
    column: Wrench<R>,
    inverse_pivot: R,
    net_torque: R,
}

/// Rates of the arm, which the paddle turns with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmRates<R> {
    /// Angle and rate of the arm, bias acceleration of the paddle's hinge.
    pub arm: Outward<R>,
    /// Angle of the paddle about η.
    pub beta: R,
    /// Rate of the paddle about η.
    pub tau: R,
    /// Hinge torque of the paddle.
    pub torque: R,
}

/// R_x(α₁) R_y(α₂) from sines and cosines: turns paddle components into appendage components.
#[inline]
pub(crate) fn rotation<R: Real>((s1, c1): (R, R), (s2, c2): (R, R)) -> Mat3<R> {
    Mat3::from_rows(
        Vec3::new(c2, R::zero(), s2),
        Vec3::new(s1 * s2, c1, -(s1 * c2)),
        Vec3::new(-(c1 * s2), s1, c1 * c2),
    )
}

/// The paddle's share at its hinge once the hinge has been eliminated: inertia and wrench,
/// appendage axes.
#[inline]
pub fn eliminate<R: Real>(
    spin: &Spin<R>,
    paddle: &RigidInertia<R>,
    rates: &ArmRates<R>,
) -> (ArticulatedInertia<R>, Wrench<R>, Paddle<R>) {
    let (s1, c1) = rates.arm.alpha.sin_cos();
    let rot = rotation((s1, c1), rates.beta.sin_cos());
    let axis = Vec3::new(R::zero(), c1, s1);
    let body = paddle.rotated(&rot);
    let omega_arm = Vec3::new(spin.w.x + rates.arm.sigma, spin.w.y, spin.w.z);
    let turning = axis * rates.tau;
    let zero = R::zero();
    // ω × Ω of the arm, then of the paddle about it.
    let of_arm = Vec3::new(zero, rates.arm.sigma * spin.w.z, -(rates.arm.sigma * spin.w.y));
    let bias = Twist { angular: of_arm + omega_arm.cross(turning), linear: rates.arm.hinge };
    let wrench = body.inertia_wrench(omega_arm + turning, bias);
    let inertia = ArticulatedInertia::of(&body);
    let column = Wrench { moment: inertia.angular * axis, force: axis.cross(body.first_moment) };
    let inverse_pivot = R::one() / axis.dot(column.moment);
    let net_torque = rates.torque - axis.dot(wrench.moment);
    let ratio = net_torque * inverse_pivot;
    let left = Wrench {
        moment: wrench.moment + column.moment * ratio,
        force: wrench.force + column.force * ratio,
    };
    let eliminated = Paddle { column, inverse_pivot, net_torque };
    (inertia.without(&column, inverse_pivot), left, eliminated)
}

/// The arm's inward step: everything outboard is a rigid 6×6 share at the paddle's hinge, not
/// the 5×5 one of a chain, because the paddle's hinge transmits moments about ê₁.
#[inline]
pub fn arm_inward<R: Real>(
    arm: &Turned<R>,
    torque: R,
    outboard: &ArticulatedInertia<R>,
    wrench: Wrench<R>,
) -> (OutboardShare<R>, crate::chain::Eliminated<R>) {
    let hinge_offset = arm.hinge_offset();
    let mut inertia = outboard.seen_from(hinge_offset);
    inertia.add(&arm.inertia());
    let mut total = wrench.seen_from(hinge_offset);
    total.add(arm.wrench());
    arm.eliminate(&inertia, total, torque)
}

/// Acceleration τ̇ of the paddle when its hinge accelerates as `hinge` says.
#[inline]
pub fn back<R: Real>(paddle: &Paddle<R>, hinge: Twist<R>) -> R {
    let carried = paddle.column.moment.dot(hinge.angular) + paddle.column.force.dot(hinge.linear);
    (paddle.net_torque - carried) * paddle.inverse_pivot
}

impl<R: Real> Paddle<R> {
    pub(crate) fn flat(&self) -> Vec<R> {
        let vectors = [self.column.moment, self.column.force];
        let mut flat: Vec<R> = vectors.into_iter().flat_map(Vec3::to_array).collect();
        flat.extend([self.inverse_pivot, self.net_torque]);
        flat
    }

    pub(crate) fn read(reader: &mut Reader<std::iter::Copied<std::slice::Iter<'_, R>>>) -> Self {
        Self {
            column: Wrench { moment: reader.vector(), force: reader.vector() },
            inverse_pivot: reader.next(),
            net_torque: reader.next(),
        }
    }
}
