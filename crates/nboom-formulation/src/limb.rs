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

use nboom_model::{Limb, LimbJoint};
use nboom_scalar::{ArticulatedInertia, Real, Sym3, Twist, Vec3, Wrench};

use crate::base::AtOrigin;
pub(crate) use crate::limb::composite::composite;
pub(crate) use crate::limb::inverse::inverse;
use crate::limb::outward::{Moving, axes_stay, outward};
pub(crate) use crate::limb::place::link_places;
use crate::limb::stance::Stance;
use crate::limb::turn::Turn;
use crate::parameters::{Branch, HingeCoordinates, Reader};

/// What a limb whose joints have been eliminated shows at its mount, along the axes of its first joint.
pub(crate) struct LimbShare<R> {
    inertia: ArticulatedInertia<R>,
    wrench: Wrench<R>,
}

/// What the way back needs of a link.
pub(crate) struct EliminatedLink<R> {
    stance: Stance<R>,
    joint: EliminatedJoint<R>,
}

/// An eliminated joint: what the inboard accelerations other than about or along ê₁ take, and what is left.
struct EliminatedJoint<R> {
    column: Wrench<R>,
    inverse_pivot: R,
    /// What is left for the joint.
    net_force: R,
}

/// Eliminates all joints of a limb from its tips inward.
pub(crate) fn eliminate<R: Real>(
    number: usize,
    limb: &Limb,
    branch: &Branch<R>,
    omega: Vec3<R>,
    hinges: &[HingeCoordinates<R>],
) -> (LimbShare<R>, Vec<EliminatedLink<R>>) {
    let rates = hinges.iter().map(|hinge| [hinge.beta, hinge.tau]);
    let links = outward(number, limb.links(), branch, omega, rates);
    let own = |link: &Moving<R>| (link.body.inertia(), link.body.wrench());
    let mut seen: Vec<_> = links.iter().map(own).collect();
    let mut eliminated = Vec::with_capacity(links.len());
    for (i, link) in links.iter().enumerate().rev() {
        R::remark(|| format!("Link {number},{}, inward: its joint eliminated.", i + 1));
        let torque = hinges[i].torque;
        let (joint, share) = match limb.links()[i].joint {
            LimbJoint::Prismatic => slide_eliminated(seen[i], torque),
            LimbJoint::Revolute | LimbJoint::Parallel => turn_eliminated(link, seen[i], torque),
        };
        eliminated.push(EliminatedLink { stance: link.stance, joint });
        let at_mount = link.at_mount(share);
        seen[i] = at_mount;
        if let Some(inboard) = limb.links()[i].inboard.map(usize::from) {
            let (inertia, wrench) = links[inboard].carries(&branch.mount(i), at_mount);
            seen[inboard].0.add(&inertia);
            seen[inboard].1.add(wrench);
        }
    }
    eliminated.reverse();
    let (inertia, wrench) = seen[0];
    (LimbShare { inertia, wrench }, eliminated)
}

impl<R: Real> LimbShare<R> {
    /// What the limb shows at O, main-body axes.
    pub fn at_origin(&self, branch: &Branch<R>) -> AtOrigin<R> {
        let (inertia, wrench) = (&self.inertia, self.wrench);
        let at_origin = AtOrigin {
            inertia: inertia.seen_from(branch.point),
            wrench: wrench.seen_from(branch.point),
        };
        at_origin.rotated(&branch.rot_body_from_appendage)
    }
}

fn turn_eliminated<R: Real>(
    link: &Moving<R>,
    (inertia, wrench): (ArticulatedInertia<R>, Wrench<R>),
    torque: R,
) -> (EliminatedJoint<R>, (ArticulatedInertia<R>, Wrench<R>)) {
    let (share, eliminated) = link.body.eliminate(&inertia, wrench, torque);
    let (column, inverse_pivot, net_force) = eliminated.column_pivot_and_torque();
    (EliminatedJoint { column, inverse_pivot, net_force }, share.whole(torque))
}

/// Eliminates the motion along ê₁.
fn slide_eliminated<R: Real>(
    (inertia, wrench): (ArticulatedInertia<R>, Wrench<R>),
    force: R,
) -> (EliminatedJoint<R>, (ArticulatedInertia<R>, Wrench<R>)) {
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
    (EliminatedJoint { column, inverse_pivot, net_force }, (left, transmitted))
}

/// τ̇ of all joints when ω̇ and the acceleration of the mount, appendage axes, are these.
pub(crate) fn back<R: Real>(
    number: usize,
    limb: &Limb,
    branch: &Branch<R>,
    links: &[EliminatedLink<R>],
    main: Twist<R>,
) -> Vec<R> {
    let mut reached: Vec<Twist<R>> = Vec::with_capacity(links.len());
    let mut tau_dot = Vec::with_capacity(links.len());
    for (i, (link, of_limb)) in links.iter().zip(limb.links()).enumerate() {
        R::remark(|| format!("Link {number},{}, back: acceleration of its joint.", i + 1));
        let inboard = of_limb.inboard.map(usize::from);
        let at_mount = match inboard {
            Some(inboard) => links[inboard].stance.carries(&branch.mount(i), reached[inboard]),
            None => main,
        };
        let inboard = link.stance.carried_by(at_mount);
        let (own, acceleration) = link.joint.back(of_limb.joint, inboard);
        tau_dot.push(acceleration);
        reached.push(own);
    }
    tau_dot
}

impl<R: Real> EliminatedJoint<R> {
    /// The accelerations outboard of the joint, and its own, from those inboard of it.
    fn back(&self, joint: LimbJoint, inboard: Twist<R>) -> (Twist<R>, R) {
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
    /// The numbers that vary, of link `i` of a limb; of sine and cosine there is one pair, for either its axes
    /// or the link stays.
    pub fn flat(&self, limb: &Limb, i: usize) -> Vec<R> {
        let Stance { axes_turned, turned, travel, bias } = self.stance;
        let turn = if axes_stay(limb.links(), i) { turned } else { axes_turned };
        let EliminatedJoint { column, inverse_pivot, net_force } = &self.joint;
        let mut flat = vec![turn.sin, turn.cos, bias.y, bias.z, travel];
        flat.extend(column.moment.to_array());
        flat.extend(column.force.to_array());
        flat.extend([*inverse_pivot, *net_force]);
        flat
    }

    /// Those of link `i` of a limb.
    pub fn read(limb: &Limb, i: usize, reader: &mut Reader<impl Iterator<Item = R>>) -> Self {
        let (turn, still) = (Turn { sin: reader.next(), cos: reader.next() }, Turn::still());
        let (axes_turned, turned) = match limb.links()[i].joint {
            LimbJoint::Prismatic => (still, still),
            _ if axes_stay(limb.links(), i) => (still, turn),
            _ => (turn, still),
        };
        let bias = Vec3::new(R::zero(), reader.next(), reader.next());
        let travel = reader.next();
        let column = Wrench { moment: reader.vector(), force: reader.vector() };
        let (inverse_pivot, net_force) = (reader.next(), reader.next());
        let joint = EliminatedJoint { column, inverse_pivot, net_force };
        Self { stance: Stance { axes_turned, turned, travel, bias }, joint }
    }
}
