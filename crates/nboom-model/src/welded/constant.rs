use nboom_scalar::{Mat3, Real, Twist, Vec3};

use super::{Link, LinkRotor, Member, WeldedTree};
use crate::{RotorMotion, Spin, TurnedInertia};

impl<R: Real> WeldedTree<R> {
    /// Makes every number a scalar of this kind: the tree as `f64` has welded it. That is cheaper than
    /// welding in other numbers, and all that those need which fill a register with `f64`.
    pub fn constant(tree: &WeldedTree<f64>) -> Self {
        let turned = |(link, inertia): &(usize, _)| (*link, TurnedInertia::constant(inertia));
        Self {
            main: tree.main.map(R::constant),
            held: tree.held.map(|Twist { angular, linear }| Twist {
                angular: Vec3::constant(angular),
                linear: Vec3::constant(linear),
            }),
            links: tree.links.iter().map(Link::constant).collect(),
            main_spin: tree.main_spin.map(Spin::constant),
            rotors: tree.rotors.iter().map(LinkRotor::constant).collect(),
            members: tree.members.iter().map(Member::constant).collect(),
            angles: tree.angles.iter().map(|&angle| R::constant(angle)).collect(),
            turned: tree.turned.iter().map(turned).collect(),
        }
    }
}

impl<R: Real> Link<R> {
    fn constant(link: &Link<f64>) -> Self {
        Self {
            hinge: link.hinge,
            inboard: link.inboard,
            point: Vec3::constant(link.point),
            rot_inboard_at_zero: Mat3::constant(link.rot_inboard_at_zero),
            joint: link.joint,
            axis: Vec3::constant(link.axis),
            inertia: link.inertia.map(R::constant),
            spin: link.spin.map(Spin::constant),
        }
    }
}

impl<R: Real> LinkRotor<R> {
    fn constant(rotor: &LinkRotor<f64>) -> Self {
        Self {
            link: rotor.link,
            axis: Vec3::constant(rotor.axis),
            inertia: R::constant(rotor.inertia),
            motion: RotorMotion::of_constant(&rotor.motion),
        }
    }
}

impl<R: Real> Member<R> {
    fn constant(member: &Member<f64>) -> Self {
        Self {
            link: member.link,
            point: Vec3::constant(member.point),
            rot_link_from_body: Mat3::constant(member.rot_link_from_body),
        }
    }
}
