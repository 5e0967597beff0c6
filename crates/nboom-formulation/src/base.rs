use nboom_scalar::{ArticulatedInertia, Mat3, Real, RigidInertia, Sym3, Twist, Vec3, Wrench};

/// What an appendage shows the main body: inertia at O and the wrench left about O when
/// nothing accelerates, main-body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtOrigin<R> {
    /// Inertia at O.
    pub inertia: ArticulatedInertia<R>,
    /// Wrench about O.
    pub wrench: Wrench<R>,
}

impl<R: Real> AtOrigin<R> {
    /// No appendage.
    pub fn nothing() -> Self {
        Self { inertia: ArticulatedInertia::of(&RigidInertia::zero()), wrench: Wrench::zero() }
    }

    /// The main body itself, turning at `omega`, with the external wrench about O taken off.
    #[inline]
    pub fn of_main_body(main: &RigidInertia<R>, omega: Vec3<R>, external: &Wrench<R>) -> Self {
        let still = Twist { angular: Vec3::zero(), linear: Vec3::zero() };
        let mut wrench = main.inertia_wrench(omega, still);
        wrench.subtract(*external);
        Self { inertia: ArticulatedInertia::of(main), wrench }
    }

    /// Adds an appendage.
    #[inline]
    pub fn add(&mut self, other: &Self) {
        self.inertia.add(&other.inertia);
        self.wrench.add(other.wrench);
    }

    /// What is seen along other axes through the same point.
    #[inline]
    pub fn rotated(&self, rot: &Mat3<R>) -> Self {
        let inertia = ArticulatedInertia {
            angular: self.inertia.angular.rotated(rot),
            coupling: *rot * self.inertia.coupling * rot.transpose(),
            linear: self.inertia.linear.rotated(rot),
        };
        let wrench = Wrench { moment: *rot * self.wrench.moment, force: *rot * self.wrench.force };
        Self { inertia, wrench }
    }

    /// The accelerations (ω̇, a_O) under which the wrench vanishes.
    ///
    /// a_O is eliminated first. Both 3×3 systems are solved by cofactors, whose products do not
    /// wait for each other as the pivots of a 6×6 factorisation do.
    #[inline]
    pub fn accelerations(&self) -> Twist<R> {
        let ArticulatedInertia { angular, coupling, linear } = &self.inertia;
        let inverse = inverse(linear);
        let [h1, h2, h3] = coupling.rows;
        let (g1, g2, g3) = (inverse * h1, inverse * h2, inverse * h3);
        let central = Sym3 {
            xx: angular.xx - h1.dot(g1),
            yy: angular.yy - h2.dot(g2),
            zz: angular.zz - h3.dot(g3),
            xy: angular.xy - h1.dot(g2),
            xz: angular.xz - h1.dot(g3),
            yz: angular.yz - h2.dot(g3),
        };
        let Wrench { moment, force } = self.wrench;
        let carried = Vec3::new(g1.dot(force), g2.dot(force), g3.dot(force));
        let omega_dot = solve(&central, carried - moment);
        let shared = g1 * omega_dot.x + g2 * omega_dot.y + g3 * omega_dot.z;
        let linear = -(inverse * force) - shared;
        Twist { angular: omega_dot, linear }
    }
}

/// Cofactors of a symmetric matrix and its determinant.
#[inline]
fn cofactors<R: Real>(m: &Sym3<R>) -> (Sym3<R>, R) {
    let adjugate = Sym3 {
        xx: m.yy * m.zz - m.yz * m.yz,
        yy: m.xx * m.zz - m.xz * m.xz,
        zz: m.xx * m.yy - m.xy * m.xy,
        xy: m.xz * m.yz - m.xy * m.zz,
        xz: m.xy * m.yz - m.xz * m.yy,
        yz: m.xy * m.xz - m.yz * m.xx,
    };
    let determinant = m.xx * adjugate.xx + m.xy * adjugate.xy + m.xz * adjugate.xz;
    (adjugate, determinant)
}

#[inline]
fn inverse<R: Real>(m: &Sym3<R>) -> Sym3<R> {
    let (adjugate, determinant) = cofactors(m);
    adjugate * (R::one() / determinant)
}

#[inline]
fn solve<R: Real>(m: &Sym3<R>, right: Vec3<R>) -> Vec3<R> {
    let (adjugate, determinant) = cofactors(m);
    (adjugate * right) * (R::one() / determinant)
}
