use std::ops::{Mul, Neg};

use crate::{Mat3, Real, Sym3, Vec3};

/// Moment about a reference point, and force; both along the same axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<R> {
    /// Moment about the reference point.
    pub moment: Vec3<R>,
    /// Force.
    pub force: Vec3<R>,
}

impl<R: Real> Wrench<R> {
    /// No moment and no force.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { moment: Vec3::zero(), force: Vec3::zero() }
    }

    /// The wrench of a force acting at `point` from the reference point.
    #[inline(always)]
    pub fn of_force(point: Vec3<R>, force: Vec3<R>) -> Self {
        Self { moment: point.cross(force), force }
    }

    /// Moves the reference point to where the old one is seen at `offset`.
    #[inline(always)]
    pub fn seen_from(self, offset: Vec3<R>) -> Self {
        Self { moment: self.moment + offset.cross(self.force), force: self.force }
    }

    /// Turns the components to other axes.
    #[inline(always)]
    pub fn rotated(self, rot: &Mat3<R>) -> Self {
        Self { moment: *rot * self.moment, force: *rot * self.force }
    }

    /// Adds a wrench about the same point.
    #[inline(always)]
    pub fn add(&mut self, other: Self) {
        self.moment += other.moment;
        self.force += other.force;
    }

    /// Takes a wrench about the same point away.
    #[inline(always)]
    pub fn subtract(&mut self, other: Self) {
        self.moment -= other.moment;
        self.force -= other.force;
    }
}

impl<R: Real> Neg for Wrench<R> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { moment: -self.moment, force: -self.force }
    }
}

/// Rate of a body and of one of its points: velocities or accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<R> {
    /// Angular rate or acceleration of the body.
    pub angular: Vec3<R>,
    /// Velocity or acceleration of the point.
    pub linear: Vec3<R>,
}

impl<R: Real> Twist<R> {
    /// At rest.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { angular: Vec3::zero(), linear: Vec3::zero() }
    }

    /// Adds the motion of a body relative to this one, at the same point.
    #[inline(always)]
    pub fn add(&mut self, other: Self) {
        self.angular += other.angular;
        self.linear += other.linear;
    }

    /// How a motion at the same point changes that is carried along by this one, `self` × `carried`.
    #[inline(always)]
    pub fn cross(self, carried: Self) -> Self {
        Self {
            angular: self.angular.cross(carried.angular),
            linear: self.angular.cross(carried.linear) + self.linear.cross(carried.angular),
        }
    }

    /// How a wrench or momentum about the same point changes that is carried along, `self` ×\* `carried`.
    #[inline(always)]
    pub fn cross_wrench(self, carried: Wrench<R>) -> Wrench<R> {
        Wrench {
            moment: self.angular.cross(carried.moment) + self.linear.cross(carried.force),
            force: self.angular.cross(carried.force),
        }
    }

    /// The power of a wrench about the same point.
    #[inline(always)]
    pub fn power(self, wrench: Wrench<R>) -> R {
        self.angular.dot(wrench.moment) + self.linear.dot(wrench.force)
    }

    /// The rate of a point at `offset` of the same body.
    #[inline(always)]
    pub fn at(self, offset: Vec3<R>) -> Self {
        Self { angular: self.angular, linear: self.linear + self.angular.cross(offset) }
    }
}

impl<R: Real> Mul<R> for Twist<R> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self { angular: self.angular * factor, linear: self.linear * factor }
    }
}

/// Inertia of a rigid body about its origin: mass, first moment m C̄ and the tensor
/// Ī + m (C² U − C̄ C̄ᵀ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidInertia<R> {
    /// Mass.
    pub mass: R,
    /// Mass times the mass centre from the origin.
    pub first_moment: Vec3<R>,
    /// Inertia tensor about the origin.
    pub about_origin: Sym3<R>,
}

impl<R> RigidInertia<R> {
    /// The body with what `f` makes of each of its ten numbers.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> RigidInertia<S> {
        RigidInertia {
            mass: f(self.mass),
            first_moment: self.first_moment.map(&mut f),
            about_origin: self.about_origin.map(f),
        }
    }
}

impl<R: Real> RigidInertia<R> {
    /// A body without mass.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { mass: R::zero(), first_moment: Vec3::zero(), about_origin: Sym3::zero() }
    }

    /// A body with this mass, mass centre from the origin, and inertia about the mass centre.
    #[inline(always)]
    pub fn new(mass: R, center_of_mass: Vec3<R>, inertia: Sym3<R>) -> Self {
        Self { mass, first_moment: Vec3::zero(), about_origin: inertia }.seen_from(center_of_mass)
    }

    /// Moves the origin to where the old one is seen at `offset`.
    #[inline(always)]
    pub fn seen_from(self, offset: Vec3<R>) -> Self {
        let c = self.first_moment;
        let (m, p) = (self.mass, offset);
        // (2c·p + m p²) U − (c pᵀ + p cᵀ) − m p pᵀ, with both dyads taken together.
        let of_shift = Sym3::across(c + c + p * m, p);
        Self { mass: m, first_moment: c + p * m, about_origin: self.about_origin + of_shift }
    }

    /// Turns the components to other axes.
    #[inline(always)]
    pub fn rotated(self, rot: &Mat3<R>) -> Self {
        Self {
            mass: self.mass,
            first_moment: *rot * self.first_moment,
            about_origin: self.about_origin.rotated(rot),
        }
    }

    /// Adds another body that is rigid with this one, about the same origin.
    #[inline(always)]
    pub fn add(&mut self, other: Self) {
        self.mass += other.mass;
        self.first_moment += other.first_moment;
        self.about_origin += other.about_origin;
    }

    /// Angular momentum about the origin (`moment`) and momentum (`force`) of a body whose origin moves so; for
    /// accelerations, the wrench that they take at no rates.
    #[inline(always)]
    pub fn momentum(&self, motion: Twist<R>) -> Wrench<R> {
        let c = self.first_moment;
        Wrench {
            moment: self.about_origin * motion.angular + c.cross(motion.linear),
            force: motion.linear * self.mass + motion.angular.cross(c),
        }
    }

    /// Rate of change of momentum, and of angular momentum about the origin, of a body that
    /// turns at `omega` while its origin accelerates with `acceleration`.
    #[inline(always)]
    pub fn inertia_wrench(&self, omega: Vec3<R>, acceleration: Twist<R>) -> Wrench<R> {
        let (c, alpha) = (self.first_moment, acceleration.angular);
        Wrench {
            moment: c.cross(acceleration.linear)
                + self.about_origin * alpha
                + omega.cross(self.about_origin * omega),
            force: acceleration.linear * self.mass + alpha.cross(c) + omega.cross(omega.cross(c)),
        }
    }
}

/// Inertia that a body shows at its hinge when everything outboard may give way:
/// moment = `angular` ω̇ + `coupling` a, force = `coupling`ᵀ ω̇ + `linear` a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArticulatedInertia<R> {
    /// Moment per angular acceleration.
    pub angular: Sym3<R>,
    /// Moment per acceleration of the point; transposed, force per angular acceleration.
    pub coupling: Mat3<R>,
    /// Force per acceleration of the point.
    pub linear: Sym3<R>,
}

impl<R: Real> ArticulatedInertia<R> {
    /// That of a rigid body, at its origin.
    #[inline(always)]
    pub fn of(body: &RigidInertia<R>) -> Self {
        Self {
            angular: body.about_origin,
            coupling: Mat3::skew(body.first_moment),
            linear: Sym3::diagonal(body.mass, body.mass, body.mass),
        }
    }

    /// Adds an inertia at the same point.
    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.angular += other.angular;
        self.coupling += other.coupling;
        self.linear += other.linear;
    }

    /// Takes away what turning about the hinge cannot transmit: A − u uᵀ / d.
    #[inline(always)]
    pub fn without(&self, u: &Wrench<R>, inverse_d: R) -> Self {
        Self {
            angular: self.angular - Sym3::outer(u.moment) * inverse_d,
            coupling: self.coupling - (u.moment * inverse_d).outer(u.force),
            linear: self.linear - Sym3::outer(u.force) * inverse_d,
        }
    }

    /// Moves the reference point to where the old one is seen at `offset`.
    #[inline(always)]
    pub fn seen_from(&self, offset: Vec3<R>) -> Self {
        let linear = self.linear.to_matrix();
        let coupling = self.coupling + skew_times(offset, &linear);
        // H J(r) has the rows hᵢ × r; the sum below is symmetric although its parts are not.
        let old = times_skew(&self.coupling, offset);
        let new = times_skew(&coupling, offset);
        let angular = self.angular - Sym3::upper_of(&(old.transpose() + new));
        Self { angular, coupling, linear: self.linear }
    }
}

#[inline(always)]
fn times_skew<R: Real>(m: &Mat3<R>, r: Vec3<R>) -> Mat3<R> {
    let [a, b, c] = m.rows;
    Mat3 { rows: [a.cross(r), b.cross(r), c.cross(r)] }
}

#[inline(always)]
fn skew_times<R: Real>(r: Vec3<R>, m: &Mat3<R>) -> Mat3<R> {
    let [a, b, c] = m.rows;
    Mat3::from_rows(c * r.y - b * r.z, a * r.z - c * r.x, b * r.x - a * r.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body() -> RigidInertia<f64> {
        RigidInertia::new(
            2.5,
            Vec3::new(0.3, -0.7, 0.2),
            Sym3 { xx: 1.0, yy: 1.4, zz: 0.9, xy: 0.1, xz: -0.2, yz: 0.05 },
        )
    }

    #[test]
    fn moving_the_origin_of_a_rigid_body_agrees_with_the_articulated_form() {
        let offset = Vec3::new(-1.1, 0.4, 2.3);
        let direct = ArticulatedInertia::of(&body().seen_from(offset));
        let shifted = ArticulatedInertia::of(&body()).seen_from(offset);
        for (a, b) in [
            (direct.angular.to_matrix(), shifted.angular.to_matrix()),
            (direct.coupling, shifted.coupling),
            (direct.linear.to_matrix(), shifted.linear.to_matrix()),
        ] {
            assert!((a - b).rows.iter().all(|r| r.norm() < 1e-14), "{a:?} {b:?}");
        }
    }

    #[test]
    fn a_slender_body_keeps_its_inertia_about_its_long_axis() {
        let inertia = Sym3::diagonal(1.0, 0.01, 1.0);
        let about_hinge = RigidInertia::new(3.0, Vec3::unit_y(), inertia).about_origin;
        assert_eq!(about_hinge, Sym3::diagonal(4.0, 0.01, 4.0));
        // m (p² U − p pᵀ), by hand.
        let point = RigidInertia::new(2.0, Vec3::new(1.0, 2.0, -3.0), Sym3::zero()).about_origin;
        let expected = Sym3 { xx: 26.0, yy: 20.0, zz: 10.0, xy: -4.0, xz: 6.0, yz: 12.0 };
        assert_eq!(point, expected);
    }

    #[test]
    fn power_of_the_inertia_wrench_is_the_rate_of_kinetic_energy() {
        // With the origin at rest and no outside force: ω·(ω × J ω) = 0 and c × a adds nothing.
        let omega = Vec3::new(0.4, -1.0, 0.7);
        let alpha = Vec3::new(0.2, 0.3, -0.6);
        let wrench = body().inertia_wrench(omega, Twist { angular: alpha, linear: Vec3::zero() });
        let expected = omega.dot(body().about_origin * alpha);
        assert!((omega.dot(wrench.moment) - expected).abs() < 1e-14);
    }
}
