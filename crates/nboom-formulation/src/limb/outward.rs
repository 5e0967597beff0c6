//! Where the links of a limb are, and how they move.

use nboom_model::{Limb, LimbJoint};
use nboom_scalar::{ArticulatedInertia, Real, Vec3, Wrench};

use crate::base::AtOrigin;
use crate::chain::{self, ChainLink, Spin, Turned};
use crate::limb::turn::Turn;
use crate::parameters::{Branch, HingeCoordinates, Mount};

/// A link in one state.
pub(super) struct Moving<R> {
    /// From the axes of the mount to those in which all of the link is written.
    pub axes_turned: Turn<R>,
    /// How far the link has turned from these axes, and how fast it turns.
    pub turned: Turn<R>,
    alpha: R,
    sigma: R,
    /// ω of these axes.
    spin: Spin<R>,
    /// From the mount to the link's origin along ê₁.
    pub travel: R,
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

/// All links, when the main body turns at `omega`.
pub(super) fn outward<R: Real>(
    number: usize,
    limb: &Limb,
    branch: &Branch<R>,
    omega: Vec3<R>,
    hinges: &[HingeCoordinates<R>],
) -> Vec<Moving<R>> {
    let mut links: Vec<Moving<R>> = Vec::with_capacity(hinges.len());
    for (i, (of_limb, hinge)) in limb.links().iter().zip(hinges).enumerate() {
        R::remark(|| format!("Link {number},{}, outward: its bias.", i + 1));
        let at_mount = match of_limb.inboard.map(usize::from) {
            Some(inboard) => links[inboard].moves(&branch.mount(i)),
            None => of_main_body(branch, omega),
        };
        links.push(match of_limb.joint {
            LimbJoint::Prismatic => Moving::sliding(&branch.links[i], &at_mount, hinge),
            _ => Moving::turning(&branch.links[i], at_mount, hinge, axes_stay(limb, i)),
        });
    }
    links
}

/// Whether the axes of a link stay those of its mount, for parallel joints have them in common.
pub(super) fn axes_stay(limb: &Limb, i: usize) -> bool {
    let follows = |link: &nboom_model::LimbLink| {
        link.joint == LimbJoint::Parallel && link.inboard.map(usize::from) == Some(i)
    };
    limb.links()[i].joint != LimbJoint::Revolute || limb.links().iter().any(follows)
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
        hinge: &HingeCoordinates<R>,
        axes_stay: bool,
    ) -> Self {
        let AtMount { spin, alpha, sigma, bias } = at_mount;
        let alpha = alpha + hinge.beta;
        let (turn, still) = (Turn::by(alpha), Turn::still());
        let (axes_turned, turned) = if axes_stay { (still, turn) } else { (turn, still) };
        let spin = Spin::new(axes_turned.vector_back(spin));
        let origin = axes_turned.vector_back(bias);
        let (body, sigma, _) = chain::outward_at(
            &spin,
            constants,
            (turned.sin, turned.cos),
            hinge.tau,
            (sigma, origin),
        );
        let travel = R::zero();
        Self { axes_turned, turned, alpha, sigma, spin, travel, origin, body }
    }

    fn sliding(
        constants: &ChainLink<R>,
        at_mount: &AtMount<R>,
        hinge: &HingeCoordinates<R>,
    ) -> Self {
        let (zero, still) = (R::zero(), Turn::still());
        let w = at_mount.spin;
        let spin = Spin::new(w);
        let coriolis = Vec3::new(zero, w.z, -w.y) * (hinge.tau + hinge.tau);
        let along = Vec3::new(hinge.beta, zero, zero);
        let origin = at_mount.bias + spin.bias_of_main_point(along) + coriolis;
        let (body, sigma, _) =
            chain::outward_at(&spin, constants, (still.sin, still.cos), zero, (zero, origin));
        let (axes_turned, turned, travel) = (still, still, hinge.beta);
        Self { axes_turned, turned, alpha: zero, sigma, spin, travel, origin, body }
    }

    /// ω along the link's own axes.
    fn own_spin(&self) -> Vec3<R> {
        let w = self.spin.w;
        self.turned.vector_back(Vec3::new(w.x + self.sigma, w.y, w.z))
    }

    /// Angular bias acceleration, along the link's own axes: ω × ê₁ σ.
    pub fn angular_bias(&self) -> Vec3<R> {
        let w = self.own_spin();
        Vec3::new(R::zero(), self.sigma * w.z, -(self.sigma * w.y))
    }

    /// How a mount on the link moves.
    fn moves(&self, mount: &Mount<R>) -> AtMount<R> {
        match mount {
            Mount::Parallel(way) => {
                let bias =
                    self.origin + self.spin.bias_of(self.sigma, turned_way(self.turned, *way));
                AtMount { spin: self.spin.w, alpha: self.alpha, sigma: self.sigma, bias }
            }
            Mount::Across { rot, point } => {
                let w = self.own_spin();
                let of_point = Spin::new(w).bias_of_main_point(*point);
                let bias = self.turned.vector_back(self.origin)
                    + (of_point + self.angular_bias().cross(*point));
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
        let along = Vec3::new(self.travel, R::zero(), R::zero());
        let (inertia, wrench) = (inertia.seen_from(along), wrench.seen_from(along));
        (self.axes_turned.inertia(&inertia), self.axes_turned.wrench(wrench))
    }

    /// What a joint at a mount on the link transmits, at the link's origin and along its axes.
    pub fn carries(
        &self,
        mount: &Mount<R>,
        (inertia, wrench): (ArticulatedInertia<R>, Wrench<R>),
    ) -> (ArticulatedInertia<R>, Wrench<R>) {
        match mount {
            Mount::Parallel(way) => {
                let way = turned_way(self.turned, *way);
                (inertia.seen_from(way), wrench.seen_from(way))
            }
            Mount::Across { rot, point } => {
                let AtOrigin { inertia, mut wrench } = AtOrigin { inertia, wrench }.rotated(rot);
                let bias = self.angular_bias();
                wrench.add(Wrench {
                    moment: inertia.angular * bias,
                    force: inertia.coupling.transpose_mul(bias),
                });
                let (inertia, wrench) = (inertia.seen_from(*point), wrench.seen_from(*point));
                (self.turned.inertia(&inertia), self.turned.wrench(wrench))
            }
        }
    }
}

/// The way from a joint to a parallel one, along the axes of both.
pub(super) fn turned_way<R: Real>(turned: Turn<R>, way: [R; 2]) -> Vec3<R> {
    turned.vector(Vec3::new(R::zero(), way[0], way[1]))
}
