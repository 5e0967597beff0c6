//! The matrix of a limb: composite bodies inward, and the momentum of each for a unit rate of its joint.

use nboom_model::{Limb, LimbJoint};
use nboom_scalar::{ArticulatedInertia, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::arrow::Arrow;
use crate::base::AtOrigin;
use crate::limb::inverse::{along_joint, forces};
use crate::limb::outward::{of_main_body, outward};
use crate::limb::stance::Stance;
use crate::parameters::{Branch, HingeCoordinates, Mount};

/// The arrow over τ about O, along the axes of the first joint.
pub(crate) fn composite<R: Real>(
    limb: &Limb,
    branch: &Branch<R>,
    omega: Vec3<R>,
    hinges: &[HingeCoordinates<R>],
) -> Arrow<R> {
    let links = limb.links();
    let inboard: Vec<Option<usize>> =
        links.iter().map(|link| link.inboard.map(usize::from)).collect();
    let rates = hinges.iter().map(|hinge| [hinge.beta, hinge.tau]);
    let moving = outward(1, links, branch, &of_main_body(branch, omega), rates);
    let at_rest = vec![R::zero(); links.len()];
    let (wrench, bias) = forces(1, links, branch, &moving, Twist::zero(), &at_rest);
    let mut columns = vec![Wrench::zero(); links.len()];
    let mut rows = vec![Vec::new(); links.len()];
    let mut bodies: Vec<RigidInertia<R>> = moving.iter().map(|link| link.body.rigid()).collect();
    for i in (0..links.len()).rev() {
        let mut column = bodies[i].momentum(unit(links[i].joint));
        rows[i] = vec![R::zero(); i + 1];
        rows[i][i] = along_joint(links[i].joint, column);
        let mut at = i;
        loop {
            column = moving[at].stance.wrench_at_mount(column);
            let Some(next) = inboard[at] else { break };
            column = moving[next].stance.wrench_carried(&branch.mount(at), column);
            rows[i][next] = along_joint(links[next].joint, column);
            at = next;
        }
        columns[i] = column.seen_from(branch.point);
        bodies[i] = at_mount(bodies[i], &moving[i].stance);
        if let Some(inboard) = inboard[i] {
            let carried = carried(bodies[i], &moving[inboard].stance, &branch.mount(i));
            bodies[inboard].add(carried);
        }
    }
    let base = AtOrigin {
        inertia: ArticulatedInertia::of(&bodies[0].seen_from(branch.point)),
        wrench: wrench.seen_from(branch.point),
    };
    let right = hinges.iter().zip(bias).map(|(hinge, bias)| hinge.torque - bias).collect();
    Arrow { inboard, hinges: rows, columns, right, base }
}

/// A link's motion for a unit rate of its joint.
fn unit<R: Real>(joint: LimbJoint) -> Twist<R> {
    let (zero, along) = (Vec3::zero(), Vec3::unit_x());
    match joint {
        LimbJoint::Prismatic => Twist { angular: zero, linear: along },
        LimbJoint::Revolute | LimbJoint::Parallel => Twist { angular: along, linear: zero },
    }
}

/// A body on a link, at the link's mount and along the axes there.
fn at_mount<R: Real>(body: RigidInertia<R>, link: &Stance<R>) -> RigidInertia<R> {
    link.axes_turned.rigid(&body.seen_from(link.along()))
}

/// A body at a mount on a link, along the axes there, at the link's origin and along its axes.
fn carried<R: Real>(
    body: RigidInertia<R>,
    inboard: &Stance<R>,
    mount: &Mount<R>,
) -> RigidInertia<R> {
    match mount {
        Mount::Parallel(way) => body.seen_from(inboard.way(*way)),
        Mount::Across { rot, point } => inboard.turned.rigid(&body.rotated(rot).seen_from(*point)),
    }
}
