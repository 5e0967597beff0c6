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

    /// What is seen at a point from which the former is at `r`.
    #[inline]
    pub fn seen_from(&self, r: Vec3<R>) -> Self {
        Self { inertia: self.inertia.seen_from(r), wrench: self.wrench.seen_from(r) }
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

    /// The accelerations (ω̇, a_O) of a main body that is held, which so heavy a one takes from the external wrench
    /// about O, whatever its appendages do.
    #[inline]
    pub fn accelerations_of_held(main: &RigidInertia<R>, external: &Wrench<R>) -> Twist<R> {
        // A power of two, so that what holds it comes out as it was.
        let inverse = R::one() / main.mass;
        Twist { angular: external.moment * inverse, linear: external.force * inverse }
    }

    /// The accelerations (ω̇, a_O) under which the wrench vanishes; a_O is eliminated first.
    #[inline]
    pub fn accelerations(&self) -> Twist<R> {
        let ArticulatedInertia { angular, coupling, linear } = &self.inertia;
        let Wrench { moment, force } = self.wrench;
        let linear = Factored::new(linear);
        let [h1, h2, h3] = coupling.rows.map(|row| linear.forward(row));
        let [g1, g2, g3] = [h1, h2, h3].map(|row| linear.over_pivots(row));
        let central = Sym3 {
            xx: angular.xx - h1.dot(g1),
            yy: angular.yy - h2.dot(g2),
            zz: angular.zz - h3.dot(g3),
            xy: angular.xy - h1.dot(g2),
            xz: angular.xz - h1.dot(g3),
            yz: angular.yz - h2.dot(g3),
        };
        let force = linear.forward(force);
        let carried = Vec3::new(g1.dot(force), g2.dot(force), g3.dot(force));
        let omega_dot = Factored::new(&central).solve(carried - moment);
        let shared = g1 * omega_dot.x + g2 * omega_dot.y + g3 * omega_dot.z;
        let linear = linear.back(-linear.over_pivots(force) - shared);
        Twist { angular: omega_dot, linear }
    }
}

/// L D Lᵀ of a positive definite matrix.
///
/// Cofactors would wait for fewer divisions, but where entries differ by decades they lose many
/// more digits than the matrix's condition takes.
struct Factored<R> {
    inverse_pivots: Vec3<R>,
    yx: R,
    zx: R,
    zy: R,
}

impl<R: Real> Factored<R> {
    #[inline]
    fn new(m: &Sym3<R>) -> Self {
        let x = R::one() / m.xx;
        let (yx, zx) = (m.xy * x, m.xz * x);
        let y = R::one() / (m.yy - yx * m.xy);
        let below = m.yz - yx * m.xz;
        let zy = below * y;
        let z = R::one() / (m.zz - zx * m.xz - zy * below);
        Self { inverse_pivots: Vec3::new(x, y, z), yx, zx, zy }
    }

    /// L⁻¹ v
    #[inline]
    fn forward(&self, v: Vec3<R>) -> Vec3<R> {
        let y = v.y - self.yx * v.x;
        Vec3::new(v.x, y, v.z - self.zx * v.x - self.zy * y)
    }

    /// D⁻¹ v
    #[inline]
    fn over_pivots(&self, v: Vec3<R>) -> Vec3<R> {
        let Vec3 { x, y, z } = self.inverse_pivots;
        Vec3::new(v.x * x, v.y * y, v.z * z)
    }

    /// L⁻ᵀ v
    #[inline]
    fn back(&self, v: Vec3<R>) -> Vec3<R> {
        let y = v.y - self.zy * v.z;
        Vec3::new(v.x - self.yx * y - self.zx * v.z, y, v.z)
    }

    #[inline]
    fn solve(&self, right: Vec3<R>) -> Vec3<R> {
        self.back(self.over_pivots(self.forward(right)))
    }
}
