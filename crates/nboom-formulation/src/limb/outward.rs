//! Where the links of a limb are, and how they move.

use nboom_model::{LimbJoint, LimbLink};
use nboom_scalar::{ArticulatedInertia, Real, Vec3, Wrench};

use crate::base::AtOrigin;
use crate::chain::{self, ChainLink, Spin, Turned};
use crate::limb::stance::Stance;
use crate::limb::turn::Turn;
use crate::parameters::{Branch, Mount};

/// A link in one state.
pub(super) struct Moving<R> {
    pub stance: Stance<R>,
    /// How far the link has turned from its axes, and how fast it turns.
    alpha: R,
    sigma: R,
    /// ω of these axes.
    spin: Spin<R>,
    /// Bias acceleration of the link's origin.
    origin: Vec3<R>,
    pub body: Turned<R>,
}

/// The motion at a mount: ω of the axes there, angle and rate about ê₁ of the link inboard of it where that is
/// parallel, and the bias acceleration.
struct AtMount<R> {
    spin: Vec3<R>,
    alpha: R,
    sigma: R,
    bias: Vec3<R>,
}

/// All `links` of an appendage whose coordinates and rates are β, τ, when the main body turns at `omega`.
pub(super) fn outward<R: Real>(
    number: usize,
    links: &[LimbLink],
    branch: &Branch<R>,
    omega: Vec3<R>,
    rates: impl Iterator<Item = [R; 2]>,
) -> Vec<Moving<R>> {
    let mut moving: Vec<Moving<R>> = Vec::with_capacity(links.len());
    for (i, (link, rates)) in links.iter().zip(rates).enumerate() {
        R::remark(|| format!("Link {number},{}, outward: its bias.", i + 1));
        let at_mount = match link.inboard.map(usize::from) {
            Some(inboard) => moving[inboard].moves(&branch.mount(i)),
            None => of_main_body(branch, omega),
        };
        moving.push(match link.joint {
            LimbJoint::Prismatic => Moving::sliding(&branch.links[i], &at_mount, rates),
            _ => Moving::turning(&branch.links[i], at_mount, rates, axes_stay(links, i)),
        });
    }
    moving
}

/// Whether the axes of a link stay those of its mount, for parallel joints have them in common.
pub(super) fn axes_stay(links: &[LimbLink], i: usize) -> bool {
    let follows = |link: &LimbLink| {
        link.joint == LimbJoint::Parallel && link.inboard.map(usize::from) == Some(i)
    };
    links[i].joint != LimbJoint::Revolute || links.iter().any(follows)
}

fn of_main_body<R: Real>(branch: &Branch<R>, omega: Vec3<R>) -> AtMount<R> {
    let spin = branch.rot_body_from_appendage.transpose_mul(omega);
    let bias = Spin::new(spin).bias_of_main_point(branch.point);
    AtMount { spin, alpha: R::zero(), sigma: R::zero(), bias }
}

impl<R: Real> Moving<R> {
    fn turning(
        constants: &ChainLink<R>,
        at_mount: AtMount<R>,
        [beta, tau]: [R; 2],
        axes_stay: bool,
    ) -> Self {
        let AtMount { spin, alpha, sigma, bias } = at_mount;
        let alpha = alpha + beta;
        let (turn, still) = (Turn::by(alpha), Turn::still());
        let (axes_turned, turned) = if axes_stay { (still, turn) } else { (turn, still) };
        let spin = Spin::new(axes_turned.vector_back(spin));
        let origin = axes_turned.vector_back(bias);
        let (body, sigma, _) =
            chain::outward_at(&spin, constants, (turned.sin, turned.cos), tau, (sigma, origin));
        let bias = angular_bias(turned, spin.w, sigma);
        let stance = Stance { axes_turned, turned, travel: R::zero(), bias };
        Self { stance, alpha, sigma, spin, origin, body }
    }

    fn sliding(constants: &ChainLink<R>, at_mount: &AtMount<R>, [beta, tau]: [R; 2]) -> Self {
        let (zero, still) = (R::zero(), Turn::still());
        let w = at_mount.spin;
        let spin = Spin::new(w);
        let coriolis = Vec3::new(zero, w.z, -w.y) * (tau + tau);
        let along = Vec3::new(beta, zero, zero);
        let origin = at_mount.bias + spin.bias_of_main_point(along) + coriolis;
        let (body, sigma, _) =
            chain::outward_at(&spin, constants, (still.sin, still.cos), zero, (zero, origin));
        let bias = angular_bias(still, w, sigma);
        let stance = Stance { axes_turned: still, turned: still, travel: beta, bias };
        Self { stance, alpha: zero, sigma, spin, origin, body }
    }

    /// How a mount on the link moves.
    fn moves(&self, mount: &Mount<R>) -> AtMount<R> {
        match mount {
            Mount::Parallel(way) => {
                let bias = self.origin + self.spin.bias_of(self.sigma, self.stance.way(*way));
                AtMount { spin: self.spin.w, alpha: self.alpha, sigma: self.sigma, bias }
            }
            Mount::Across { rot, point } => {
                let Stance { turned, bias, .. } = self.stance;
                let w = own_spin(turned, self.spin.w, self.sigma);
                let of_point = Spin::new(w).bias_of_main_point(*point);
                let bias = turned.vector_back(self.origin) + (of_point + bias.cross(*point));
                let (spin, bias) = (rot.transpose_mul(w), rot.transpose_mul(bias));
                AtMount { spin, alpha: R::zero(), sigma: R::zero(), bias }
            }
        }
    }

    /// What the link's joint transmits, at its mount and along the axes there.
    pub fn at_mount(
        &self,
        (inertia, wrench): (ArticulatedInertia<R>, Wrench<R>),
    ) -> (ArticulatedInertia<R>, Wrench<R>) {
        let inertia = inertia.seen_from(self.stance.along());
        (self.stance.axes_turned.inertia(&inertia), self.stance.wrench_at_mount(wrench))
    }

    /// What a joint at a mount on the link transmits, at the link's origin and along its axes.
    pub fn carries(
        &self,
        mount: &Mount<R>,
        (inertia, wrench): (ArticulatedInertia<R>, Wrench<R>),
    ) -> (ArticulatedInertia<R>, Wrench<R>) {
        let Stance { turned, bias, .. } = self.stance;
        match mount {
            Mount::Parallel(way) => {
                let way = self.stance.way(*way);
                (inertia.seen_from(way), wrench.seen_from(way))
            }
            Mount::Across { rot, point } => {
                let AtOrigin { inertia, mut wrench } = AtOrigin { inertia, wrench }.rotated(rot);
                wrench.add(Wrench {
                    moment: inertia.angular * bias,
                    force: inertia.coupling.transpose_mul(bias),
                });
                let (inertia, wrench) = (inertia.seen_from(*point), wrench.seen_from(*point));
                (turned.inertia(&inertia), turned.wrench(wrench))
            }
        }
    }
}

/// ω along the own axes of a link that has turned so far from axes that turn at `w`, and turns at `sigma`
/// about ê₁.
fn own_spin<R: Real>(turned: Turn<R>, w: Vec3<R>, sigma: R) -> Vec3<R> {
    turned.vector_back(Vec3::new(w.x + sigma, w.y, w.z))
}

/// ω × ê₁ σ of such a link.
fn angular_bias<R: Real>(turned: Turn<R>, w: Vec3<R>, sigma: R) -> Vec3<R> {
    let w = own_spin(turned, w, sigma);
    Vec3::new(R::zero(), sigma * w.z, -(sigma * w.y))
}
