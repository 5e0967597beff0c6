//! Inverse dynamics of an appendage: accelerations outward, wrenches inward.

use nboom_model::{LimbJoint, LimbLink};
use nboom_scalar::{Real, Twist, Vec3, Wrench};

use crate::inverse_dynamics::HingeMotion;
use crate::limb::outward::{Moving, of_main_body, outward};
use crate::parameters::Branch;

/// The wrench at the first joint, along its axes, and the generalised forces of all joints, when the main
/// body turns at `omega` and the axes of the first joint have the accelerations `main` there.
pub(crate) fn inverse<R: Real>(
    number: usize,
    links: &[LimbLink],
    branch: &Branch<R>,
    omega: Vec3<R>,
    main: Twist<R>,
    hinges: &[HingeMotion<R>],
) -> (Wrench<R>, Vec<R>) {
    let rates = hinges.iter().map(|hinge| [hinge.beta, hinge.tau]);
    let moving = outward(number, links, branch, &of_main_body(branch, omega), rates);
    let tau_dot: Vec<R> = hinges.iter().map(|hinge| hinge.tau_dot).collect();
    forces(number, links, branch, &moving, main, &tau_dot)
}

/// The same of links that move so, with τ̇ of each joint.
pub(super) fn forces<R: Real>(
    number: usize,
    links: &[LimbLink],
    branch: &Branch<R>,
    moving: &[Moving<R>],
    main: Twist<R>,
    tau_dot: &[R],
) -> (Wrench<R>, Vec<R>) {
    let mut reached: Vec<Twist<R>> = Vec::with_capacity(links.len());
    let mut wrenches = Vec::with_capacity(links.len());
    for (i, (link, at)) in links.iter().zip(moving).enumerate() {
        R::remark(|| {
            format!("Link {number},{}, outward: its acceleration, and what it takes.", i + 1)
        });
        let at_mount = match link.inboard.map(usize::from) {
            Some(inboard) => moving[inboard].stance.carries(&branch.mount(i), reached[inboard]),
            None => main,
        };
        let mut own = at.stance.carried_by(at_mount);
        match link.joint {
            LimbJoint::Prismatic => own.linear.x += tau_dot[i],
            LimbJoint::Revolute | LimbJoint::Parallel => own.angular.x += tau_dot[i],
        }
        let mut wrench = at.body.rigid().momentum(own);
        wrench.add(at.body.wrench());
        reached.push(own);
        wrenches.push(wrench);
    }
    let mut forces = vec![R::zero(); links.len()];
    for (i, (link, at)) in links.iter().zip(moving).enumerate().rev() {
        R::remark(|| format!("Link {number},{}, inward: its generalised force.", i + 1));
        forces[i] = along_joint(link.joint, wrenches[i]);
        wrenches[i] = at.stance.wrench_at_mount(wrenches[i]);
        if let Some(inboard) = link.inboard.map(usize::from) {
            let carried = moving[inboard].stance.wrench_carried(&branch.mount(i), wrenches[i]);
            wrenches[inboard].add(carried);
        }
    }
    (wrenches[0], forces)
}

/// The share of a wrench that a joint along ê₁ takes up by its own force.
pub(super) fn along_joint<R: Real>(joint: LimbJoint, wrench: Wrench<R>) -> R {
    match joint {
        LimbJoint::Prismatic => wrench.force.x,
        LimbJoint::Revolute | LimbJoint::Parallel => wrench.moment.x,
    }
}
