//! The O(n) elimination of a chain with parallel hinge axes, in appendage axes.
//!
//! ê₁ is along the hinges. With absolute angles the links outboard never see the base's
//! angular acceleration about ê₁: each link shows its inboard neighbour a symmetric 5×5
//! inertia over (ω̇₂, ω̇₃, a) and the moment about ê₁ that the hinge law prescribes.

use nboom_scalar::{ArticulatedInertia, Mat3, Real, RigidInertia, Sym3, Vec3, Wrench};

mod numbers;

/// Constants of one link, link axes (first axis along the hinge).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainLink<R> {
    /// Mass properties about the inboard hinge.
    pub inertia: RigidInertia<R>,
    /// Second and third component of the way to the next hinge.
    pub next: [R; 2],
}

/// What all links of an appendage share in one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin<R> {
    /// ω in appendage axes.
    pub w: Vec3<R>,
    w22: R,
    w33: R,
    w12: R,
    w13: R,
    w23: R,
    /// −(w₂² + w₃²).
    minus_w2233: R,
}

impl<R: Real> Spin<R> {
    /// Prepares the products of `w`, the main body's rate in appendage axes.
    pub fn new(w: Vec3<R>) -> Self {
        let (w22, w33) = (w.y * w.y, w.z * w.z);
        Self {
            w,
            w22,
            w33,
            w12: w.x * w.y,
            w13: w.x * w.z,
            w23: w.y * w.z,
            minus_w2233: -(w22 + w33),
        }
    }

    /// Bias acceleration of a vector fixed in a link that turns at `sigma` relative to the
    /// main body: the matrix N of `docs/equations.md`, times `v`.
    #[inline]
    pub(crate) fn bias_of(&self, sigma: R, v: Vec3<R>) -> Vec3<R> {
        let whole = self.w.x + sigma;
        let twice = whole + sigma;
        let square = whole * whole;
        Vec3::new(
            self.minus_w2233 * v.x + twice * (self.w.y * v.y + self.w.z * v.z),
            self.w12 * v.x - (square + self.w33) * v.y + self.w23 * v.z,
            self.w13 * v.x + self.w23 * v.y - (square + self.w22) * v.z,
        )
    }

    /// K (ω × Ω) + (ω + Ω) × K (ω + Ω) for a link that turns at Ω = σ ê₁ relative to the main body. The first
    /// component is free of σ.
    pub(crate) fn gyroscopic_moment(&self, sigma: R, k: &Sym3<R>) -> Vec3<R> {
        let w = self.w;
        let whole = w.x + sigma;
        let h = *k * Vec3::new(whole, w.y, w.z);
        let (b2, b3) = (sigma * w.z, sigma * w.y);
        Vec3::new(
            w.x * (k.xz * w.y - k.xy * w.z)
                + k.yz * (self.w22 - self.w33)
                + (k.zz - k.yy) * self.w23,
            k.yy * b2 - k.yz * b3 + w.z * h.x - whole * h.z,
            k.yz * b2 - k.zz * b3 + whole * h.y - w.y * h.x,
        )
    }

    /// Bias acceleration of a point of the main body at `v` from O.
    pub fn bias_of_main_point(&self, v: Vec3<R>) -> Vec3<R> {
        self.bias_of(R::zero(), v)
    }
}

/// How far the outward sweep has come: angle, rate and hinge acceleration of the next link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outward<R> {
    /// α of the link before.
    pub alpha: R,
    /// σ of the link before.
    pub sigma: R,
    /// Bias acceleration of the next hinge.
    pub hinge: Vec3<R>,
}

/// A link in one state, turned into appendage axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned<R> {
    first_moment: Vec3<R>,
    about_hinge: Sym3<R>,
    mass: R,
    next: [R; 2],
    /// Bias moment about the hinge and bias force.
    moment: Vec3<R>,
    force: Vec3<R>,
}

impl<R: Real> Turned<R> {
    /// A link without a next hinge.
    pub(crate) fn last(rigid: RigidInertia<R>, wrench: Wrench<R>) -> Self {
        let RigidInertia { mass, first_moment, about_origin: about_hinge } = rigid;
        let Wrench { moment, force } = wrench;
        Self { first_moment, about_hinge, mass, next: [R::zero(); 2], moment, force }
    }

    /// The way to the next hinge.
    pub(crate) fn hinge_offset(&self) -> Vec3<R> {
        Vec3::new(R::zero(), self.next[0], self.next[1])
    }

    pub(crate) fn rigid(&self) -> RigidInertia<R> {
        let Self { mass, first_moment, about_hinge: about_origin, .. } = *self;
        RigidInertia { mass, first_moment, about_origin }
    }

    pub(crate) fn inertia(&self) -> ArticulatedInertia<R> {
        ArticulatedInertia::of(&self.rigid())
    }

    pub(crate) fn wrench(&self) -> Wrench<R> {
        Wrench { moment: self.moment, force: self.force }
    }

    /// Eliminates the rotation about ê₁ from the whole 6×6 share at this link's hinge.
    pub(crate) fn eliminate(
        &self,
        inertia: &ArticulatedInertia<R>,
        wrench: Wrench<R>,
        torque: R,
    ) -> (OutboardShare<R>, Eliminated<R>) {
        let ArticulatedInertia { angular, coupling, linear } = inertia;
        let [u, b2, b3] = coupling.rows;
        let (u2, u3) = (angular.xy, angular.xz);
        let inverse_pivot = R::one() / angular.xx;
        let net_torque = torque - wrench.moment.x;
        let ratio = net_torque * inverse_pivot;
        let (s2, s3) = (u2 * inverse_pivot, u3 * inverse_pivot);
        let share = OutboardShare {
            angular: [angular.yy - u2 * s2, angular.zz - u3 * s3, angular.yz - u2 * s3],
            coupling: [b2 - u * s2, b3 - u * s3],
            linear: *linear - Sym3::outer(u) * inverse_pivot,
            moment: [wrench.moment.y + u2 * ratio, wrench.moment.z + u3 * ratio],
            force: wrench.force + u * ratio,
        };
        let eliminated =
            Eliminated { angular: [u2, u3], linear: u, inverse_pivot, net_torque, next: self.next };
        (share, eliminated)
    }
}

/// One step of the outward sweep.
#[inline]
pub fn outward<R: Real>(
    spin: &Spin<R>,
    link: &ChainLink<R>,
    beta: R,
    tau: R,
    from: Outward<R>,
) -> (Turned<R>, Outward<R>) {
    let alpha = from.alpha + beta;
    let (turned, sigma, hinge) =
        outward_at(spin, link, alpha.sin_cos(), tau, (from.sigma, from.hinge));
    (turned, Outward { alpha, sigma, hinge })
}

/// [`outward`] with sine and cosine of α at hand: from σ and the bias acceleration of this hinge
/// to those of the next one.
#[inline]
pub fn outward_at<R: Real>(
    spin: &Spin<R>,
    link: &ChainLink<R>,
    (s, c): (R, R),
    tau: R,
    (sigma, from_hinge): (R, Vec3<R>),
) -> (Turned<R>, R, Vec3<R>) {
    let sigma = sigma + tau;
    let turn = |y: R, z: R| (c * y - s * z, s * y + c * z);
    let constant = link.inertia.first_moment;
    let (cy, cz) = turn(constant.y, constant.z);
    let first_moment = Vec3::new(constant.x, cy, cz);
    let about_hinge = turned_inertia(&link.inertia.about_origin, s, c);
    let (ly, lz) = turn(link.next[0], link.next[1]);
    let force = from_hinge * link.inertia.mass + spin.bias_of(sigma, first_moment);
    let moment = first_moment.cross(from_hinge) + spin.gyroscopic_moment(sigma, &about_hinge);
    let hinge_offset = Vec3::new(R::zero(), ly, lz);
    let hinge = from_hinge + spin.bias_of(sigma, hinge_offset);
    let turned = Turned {
        first_moment,
        about_hinge,
        mass: link.inertia.mass,
        next: [ly, lz],
        moment,
        force,
    };
    (turned, sigma, hinge)
}

/// The tensor turned about the first axis.
pub(crate) fn turned_inertia<R: Real>(k: &Sym3<R>, s: R, c: R) -> Sym3<R> {
    // With the half sum fixed, only half difference and product turn, at the double angle.
    let shift = s * ((k.yy - k.zz) * s + (k.yz + k.yz) * c);
    Sym3 {
        xx: k.xx,
        yy: k.yy - shift,
        zz: k.zz + shift,
        xy: c * k.xy - s * k.xz,
        xz: s * k.xy + c * k.xz,
        yz: c * ((k.yy - k.zz) * s + (k.yz + k.yz) * c) - k.yz,
    }
}

/// What a link and everything outboard are at its hinge, once eliminated: articulated inertia over (ω̇₂, ω̇₃, a) and the
/// wrench that is left at zero acceleration, without the moment about ê₁.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutboardShare<R> {
    /// Moments 2, 3 per ω̇₂, ω̇₃: entries 22, 33, 23.
    pub angular: [R; 3],
    /// Moments 2 and 3 per a.
    pub coupling: [Vec3<R>; 2],
    /// Force per a.
    pub linear: Sym3<R>,
    /// Moments 2 and 3.
    pub moment: [R; 2],
    /// Force.
    pub force: Vec3<R>,
}

impl<R: Real> OutboardShare<R> {
    /// Nothing outboard.
    pub fn nothing() -> Self {
        Self {
            angular: [R::zero(); 3],
            coupling: [Vec3::zero(); 2],
            linear: Sym3::zero(),
            moment: [R::zero(); 2],
            force: Vec3::zero(),
        }
    }
}

/// What eliminating a hinge leaves for the way back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eliminated<R> {
    /// Couplings of ε = ẇ₁ + σ̇ to ω̇₂, ω̇₃ and a.
    angular: [R; 2],
    linear: Vec3<R>,
    inverse_pivot: R,
    /// Moment left for ε.
    net_torque: R,
    next: [R; 2],
}

impl<R: Real> Eliminated<R> {
    /// Its couplings to what is left, the inverse pivot, and the moment left for ε.
    pub(crate) fn column_pivot_and_torque(&self) -> (Wrench<R>, R, R) {
        let [u2, u3] = self.angular;
        let moment = Vec3::new(R::zero(), u2, u3);
        (Wrench { moment, force: self.linear }, self.inverse_pivot, self.net_torque)
    }
}

impl<R: Real> OutboardShare<R> {
    /// The share as six by six, with the moment about ê₁ that the hinge law prescribes.
    #[inline]
    pub(crate) fn whole(&self, torque: R) -> (ArticulatedInertia<R>, Wrench<R>) {
        let zero = R::zero();
        let [yy, zz, yz] = self.angular;
        let inertia = ArticulatedInertia {
            angular: Sym3 { xx: zero, yy, zz, xy: zero, xz: zero, yz },
            coupling: Mat3 { rows: [Vec3::zero(), self.coupling[0], self.coupling[1]] },
            linear: self.linear,
        };
        let [m2, m3] = self.moment;
        (inertia, Wrench { moment: Vec3::new(torque, m2, m3), force: self.force })
    }
}

/// One step of the inward sweep: `net_torque` is the hinge torque less that of the next hinge.
#[inline]
pub fn inward<R: Real>(
    link: &Turned<R>,
    net_torque: R,
    outboard: &OutboardShare<R>,
) -> (OutboardShare<R>, Eliminated<R>) {
    let [ly, lz] = link.next;
    let (b2, b3) = (outboard.coupling[0], outboard.coupling[1]);
    let m = &outboard.linear;
    // a at the next hinge is a + ε (0, −lz, ly) + ω̇₂ (lz, 0, 0) + ω̇₃ (−ly, 0, 0).
    let m_eps = Vec3::new(m.xz * ly - m.xy * lz, m.yz * ly - m.yy * lz, m.zz * ly - m.yz * lz);
    let m_x = Vec3::new(m.xx, m.xy, m.xz);
    let moved = [b2 + m_x * lz, b3 - m_x * ly];
    let f = outboard.force;
    let own = &link.about_hinge;
    let c = link.first_moment;
    let pivot = m_eps.z * ly - m_eps.y * lz + own.xx;
    let u2 = b2.z * ly - b2.y * lz + m_eps.x * lz + own.xy;
    let u3 = b3.z * ly - b3.y * lz - m_eps.x * ly + own.xz;
    let u = Vec3::new(m_eps.x, m_eps.y - c.z, m_eps.z + c.y);
    let inverse_pivot = R::one() / pivot;
    let net_torque = net_torque - link.moment.x - (f.z * ly - f.y * lz);
    let ratio = net_torque * inverse_pivot;
    let (s2, s3, s) = (u2 * inverse_pivot, u3 * inverse_pivot, u * inverse_pivot);
    let mass = link.mass;
    let share = OutboardShare {
        angular: [
            outboard.angular[0] + lz * (b2.x + moved[0].x) + own.yy - u2 * s2,
            outboard.angular[1] - ly * (b3.x + moved[1].x) + own.zz - u3 * s3,
            outboard.angular[2] - ly * b2.x + lz * moved[1].x + own.yz - u2 * s3,
        ],
        coupling: [
            moved[0] + Vec3::new(c.z, R::zero(), -c.x) - u * s2,
            moved[1] + Vec3::new(-c.y, c.x, R::zero()) - u * s3,
        ],
        linear: Sym3 {
            xx: m.xx + mass - u.x * s.x,
            yy: m.yy + mass - u.y * s.y,
            zz: m.zz + mass - u.z * s.z,
            xy: m.xy - u.x * s.y,
            xz: m.xz - u.x * s.z,
            yz: m.yz - u.y * s.z,
        },
        moment: [
            outboard.moment[0] + lz * f.x + link.moment.y + u2 * ratio,
            outboard.moment[1] - ly * f.x + link.moment.z + u3 * ratio,
        ],
        force: f + link.force + u * ratio,
    };
    let eliminated =
        Eliminated { angular: [u2, u3], linear: u, inverse_pivot, net_torque, next: link.next };
    (share, eliminated)
}

/// One step of the way back: ε of the link, and the acceleration of the next hinge.
#[inline]
pub fn back<R: Real>(eliminated: &Eliminated<R>, omega_dot: [R; 2], a: Vec3<R>) -> (R, Vec3<R>) {
    let [u2, u3] = eliminated.angular;
    let [w2, w3] = omega_dot;
    let carried = u2 * w2 + u3 * w3 + eliminated.linear.dot(a);
    let epsilon = (eliminated.net_torque - carried) * eliminated.inverse_pivot;
    let [ly, lz] = eliminated.next;
    let next = Vec3::new(a.x + lz * w2 - ly * w3, a.y - lz * epsilon, a.z + ly * epsilon);
    (epsilon, next)
}
