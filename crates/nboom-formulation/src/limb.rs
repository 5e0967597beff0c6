//! The O(n) elimination of a limb.
//!
//! Links that turn about parallel axes share appendage axes as those of a chain do, with absolute angles.
//! Every other joint begins axes of its own, ê₁ along it: they are fixed in the inboard link, or, where no
//! parallel joint follows, stand as the link does at this moment, so that its numbers need not be turned.
//! What such axes carry shows its inboard link a six by six inertia, as a paddle does.

mod composite;
mod inverse;
mod outward;
mod place;
mod stance;
mod turn;

use nboom_model::{LimbJoint, LimbLink};
use nboom_scalar::{Real, Sym3, Twist, Vec3, Wrench};

use crate::base::AtOrigin;
use crate::chain::Turned;
pub(crate) use crate::limb::composite::composite;
pub(crate) use crate::limb::inverse::inverse;
pub(crate) use crate::limb::outward::{AtMount, Motion, Moving, of_main_body, outward};
pub(crate) use crate::limb::place::link_places;
pub(crate) use crate::limb::stance::Stance;
pub use crate::limb::stance::Standing;
pub(crate) use crate::limb::turn::Turn;
use crate::parameters::{Branch, HingeCoordinates, Reader};

/// What the way back needs of a link.
pub(crate) struct EliminatedLink<R> {
    pub stance: Stance<R>,
    pub joint: EliminatedJoint<R>,
}

/// An eliminated joint: what the inboard accelerations other than about or along ê₁ take, and what is left.
pub(crate) struct EliminatedJoint<R> {
    column: Wrench<R>,
    inverse_pivot: R,
    /// What is left for the joint.
    net_force: R,
}

/// Eliminates all joints of a limb from its tips inward: what it shows at its mount, along the axes of its
/// first joint, and what its joints leave.
pub(crate) fn eliminate<R: Real>(
    number: usize,
    links: &[LimbLink],
    branch: &Branch<R>,
    at_mount: &AtMount<R>,
    hinges: &[HingeCoordinates<R>],
) -> (AtOrigin<R>, Vec<EliminatedLink<R>>) {
    let rates = hinges.iter().map(|hinge| [hinge.beta, hinge.tau]);
    let moving = outward(number, links, branch, at_mount, rates);
    let stands = |i: usize| (&moving[i].stance, &moving[i].body);
    let outboard = vec![AtOrigin::nothing(); links.len()];
    inward(number, links, branch, stands, |i| hinges[i].torque, outboard)
}

/// The same of links that stand so, each with its body and all that is `outboard` of it besides.
pub(crate) fn inward<'a, R: Real>(
    number: usize,
    links: &[LimbLink],
    branch: &Branch<R>,
    stands: impl Fn(usize) -> (&'a Stance<R>, &'a Turned<R>),
    torque: impl Fn(usize) -> R,
    mut outboard: Vec<AtOrigin<R>>,
) -> (AtOrigin<R>, Vec<EliminatedLink<R>>) {
    let mut at_mount = AtOrigin::nothing();
    let mut eliminated = Vec::with_capacity(links.len());
    for (i, link) in links.iter().enumerate().rev() {
        R::remark(|| format!("Link {number},{}, inward: its joint eliminated.", i + 1));
        let (stance, body) = stands(i);
        let mut seen = of_body(body);
        seen.add(&outboard[i]);
        let (joint, share) = EliminatedJoint::of(link.joint, body, &seen, torque(i));
        eliminated.push(EliminatedLink { stance: *stance, joint });
        at_mount = stance.share_at_mount(&share);
        if let Some(inboard) = link.inboard.map(usize::from) {
            let carried = stands(inboard).0.share_carried(&branch.mount(i), &at_mount);
            outboard[inboard].add(&carried);
        }
    }
    eliminated.reverse();
    (at_mount, eliminated)
}

/// What the body of a link shows at its origin.
pub(crate) fn of_body<R: Real>(body: &Turned<R>) -> AtOrigin<R> {
    AtOrigin { inertia: body.inertia(), wrench: body.wrench() }
}

/// What a limb shows at O, main-body axes, if it shows this at its mount.
pub(crate) fn at_origin<R: Real>(share: &AtOrigin<R>, branch: &Branch<R>) -> AtOrigin<R> {
    share.seen_from(branch.point).rotated(&branch.rot_body_from_appendage)
}

impl<R: Real> EliminatedJoint<R> {
    /// The motion of a joint eliminated from what its link with all outboard of it shows at its origin: what it
    /// leaves, and what it transmits.
    pub fn of(
        joint: LimbJoint,
        body: &Turned<R>,
        seen: &AtOrigin<R>,
        torque: R,
    ) -> (Self, AtOrigin<R>) {
        match joint {
            LimbJoint::Prismatic => Self::of_slide(seen, torque),
            LimbJoint::Revolute | LimbJoint::Parallel => {
                let (share, eliminated) = body.eliminate(&seen.inertia, seen.wrench, torque);
                let (column, inverse_pivot, net_force) = eliminated.column_pivot_and_torque();
                let (inertia, wrench) = share.whole(torque);
                (Self { column, inverse_pivot, net_force }, AtOrigin { inertia, wrench })
            }
        }
    }

    /// Eliminates the motion along ê₁.
    fn of_slide(AtOrigin { inertia, wrench }: &AtOrigin<R>, force: R) -> (Self, AtOrigin<R>) {
        let [x, y, z] = inertia.coupling.rows;
        let linear = &inertia.linear;
        let column = Wrench {
            moment: Vec3::new(x.x, y.x, z.x),
            force: Vec3::new(linear.xx, linear.xy, linear.xz),
        };
        let inverse_pivot = R::one() / linear.xx;
        let net_force = force - wrench.force.x;
        let ratio = net_force * inverse_pivot;
        let mut left = inertia.without(&column, inverse_pivot);
        // Exactly zero, so that nothing is computed of them.
        let zero = R::zero();
        left.linear = Sym3 { xx: zero, xy: zero, xz: zero, ..left.linear };
        left.coupling.rows.iter_mut().for_each(|row| row.x = zero);
        let mut transmitted = Wrench {
            moment: wrench.moment + column.moment * ratio,
            force: wrench.force + column.force * ratio,
        };
        transmitted.force.x = force;
        // The way back finds the whole acceleration along ê₁, as about it where a link turns.
        let column = Wrench { force: Vec3 { x: zero, ..column.force }, ..column };
        let joint = Self { column, inverse_pivot, net_force };
        (joint, AtOrigin { inertia: left, wrench: transmitted })
    }
}

/// The accelerations of all links, and τ̇ of their joints, when ω̇ and the acceleration of the mount, appendage
/// axes, are these.
pub(crate) fn back<R: Real>(
    number: usize,
    links: &[LimbLink],
    branch: &Branch<R>,
    eliminated: &[EliminatedLink<R>],
    main: Twist<R>,
) -> Vec<(Twist<R>, R)> {
    let mut reached: Vec<(Twist<R>, R)> = Vec::with_capacity(links.len());
    for (i, (link, of_limb)) in eliminated.iter().zip(links).enumerate() {
        R::remark(|| format!("Link {number},{}, back: acceleration of its joint.", i + 1));
        let inboard = of_limb.inboard.map(usize::from);
        let at_mount = match inboard {
            Some(inboard) => {
                let stance = &eliminated[inboard].stance;
                stance.carries(&branch.mount(i), reached[inboard].0)
            }
            None => main,
        };
        let inboard = link.stance.carried_by(at_mount);
        reached.push(link.joint.back(of_limb.joint, inboard));
    }
    reached
}

impl<R: Real> EliminatedJoint<R> {
    /// The accelerations outboard of the joint, and its own, from those inboard of it.
    pub fn back(&self, joint: LimbJoint, inboard: Twist<R>) -> (Twist<R>, R) {
        let Self { column, inverse_pivot, net_force } = self;
        let carried = column.moment.dot(inboard.angular) + column.force.dot(inboard.linear);
        let found = (*net_force - carried) * *inverse_pivot;
        let mut own = inboard;
        if joint == LimbJoint::Prismatic {
            own.linear.x = found;
            (own, found - inboard.linear.x)
        } else {
            own.angular.x = found;
            (own, found - inboard.angular.x)
        }
    }
}

/// Numbers of an eliminated link, as [`EliminatedLink::flat`] has them.
pub(crate) const OF_ELIMINATED_LINK: [&str; 13] = [
    "sin", "cos", "bias_y", "bias_z", "travel", "ux", "uy", "uz", "vx", "vy", "vz", "inverse",
    "left",
];

impl<R: Real> EliminatedLink<R> {
    /// The numbers that vary.
    pub fn flat(&self, standing: Standing) -> Vec<R> {
        let EliminatedJoint { column, inverse_pivot, net_force } = &self.joint;
        let mut flat = self.stance.flat(standing).to_vec();
        flat.extend(column.moment.to_array());
        flat.extend(column.force.to_array());
        flat.extend([*inverse_pivot, *net_force]);
        flat
    }

    /// Those of a link that stands so.
    pub fn read(standing: Standing, reader: &mut Reader<impl Iterator<Item = R>>) -> Self {
        let stance = Stance::read(standing, reader);
        let column = Wrench { moment: reader.vector(), force: reader.vector() };
        let (inverse_pivot, net_force) = (reader.next(), reader.next());
        Self { stance, joint: EliminatedJoint { column, inverse_pivot, net_force } }
    }
}
