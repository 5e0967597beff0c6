//! A limb joint by joint: the steps of its joints, and those of the mounts between them.

use nboom_model::{LimbJoint, LimbLink};
use nboom_scalar::{Real, Twist, Vec3, Wrench};

use crate::base::AtOrigin;
use crate::chain::{ChainLink, Spin, Turned};
use crate::limb::{
    self, AtMount, EliminatedJoint, EliminatedLink, Motion, Moving, OF_ELIMINATED_LINK, Stance,
    Standing, Turn,
};
use crate::parameters::{Mount, Reader};
use crate::stages::limb::{LINK_BODY, MOUNT, WAY};
use crate::stages::{
    AT_ORIGIN, BRANCH, Group, HINGE_RATES, REACHED, Stage, TAU_DOT, TORQUE, TURN, TURNING, W,
};

/// β and τ of a joint.
pub const RATES: Group = Group::new("rates", &["beta", "tau"]);
/// How a link stands to its mount: sine and cosine of its angle, angular bias acceleration, travel.
pub const STANCE: Group = Group::new("stance", &["sin", "cos", "bias_y", "bias_z", "travel"]);
/// Bias moment and force of a link.
pub const BIAS: Group = Group::new("bias", &["nx", "ny", "nz", "fx", "fy", "fz"]);
/// What all links mounted on one show at its origin, as [`AT_ORIGIN`].
pub const OUTBOARD: Group = Group::new("outboard", AT_ORIGIN.numbers);
/// What a joint transmits at its mount, as [`AT_ORIGIN`].
pub const SHARE: Group = Group::new("share", AT_ORIGIN.numbers);
/// What an eliminated joint leaves: stance of its link, column, inverse pivot, force left.
pub const JOINT: Group = Group::new("joint", &OF_ELIMINATED_LINK);

/// How a link of a limb is mounted on its inboard link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mounting {
    /// Both turn about parallel axes.
    Parallel,
    /// In any other way, on a link that stands so.
    Across(Standing),
}

impl Mounting {
    /// That of link `i` of a limb of these `links`; the first is mounted on no link.
    pub fn of(links: &[LimbLink], i: usize) -> Option<Self> {
        let inboard = links[i].inboard.map(usize::from)?;
        Some(match links[i].joint {
            LimbJoint::Parallel => Self::Parallel,
            _ => Self::Across(Standing::of(links, inboard)),
        })
    }

    /// The parameters of the mount.
    pub fn parameters(self) -> Group {
        match self {
            Self::Parallel => WAY,
            Self::Across(_) => MOUNT,
        }
    }

    fn inboard(self) -> Standing {
        match self {
            Self::Parallel => Standing::Turning,
            Self::Across(inboard) => inboard,
        }
    }

    fn read<R: Real>(self, reader: &mut Reader<impl Iterator<Item = R>>) -> Mount<R> {
        match self {
            Self::Parallel => reader.mount(LimbJoint::Parallel),
            Self::Across(_) => reader.mount(LimbJoint::Revolute),
        }
    }
}

/// A link turned or displaced by its joint.
pub fn joint_outward<R: Real>(standing: Standing) -> Stage<R> {
    Stage {
        name: "outward",
        about: "A link on its joint: how it stands and moves, and its bias.",
        parameters: vec![LINK_BODY],
        inputs: vec![W, REACHED, TURN, RATES],
        outputs: vec![STANCE, W, REACHED, BIAS],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let constants = ChainLink { inertia: reader.rigid(), next: [R::zero(); 2] };
            let spin = reader.vector();
            let (sigma, bias) = (reader.next(), reader.vector());
            // Absolute angles are added up before.
            let at_mount = AtMount { spin, alpha: R::zero(), sigma, bias };
            let turn = Turn { sin: reader.next(), cos: reader.next() };
            let rates = [reader.next(), reader.next()];
            let Moving { stance, motion, body } = match standing {
                Standing::Sliding => Moving::sliding(&constants, &at_mount, rates),
                _ => Moving::turning(&constants, &at_mount, standing.turns(turn), rates),
            };
            let Wrench { moment, force } = body.wrench();
            let mut found = stance.flat(standing).to_vec();
            found.extend(motion.spin.w.to_array());
            found.push(motion.sigma);
            found.extend([motion.origin, moment, force].into_iter().flat_map(Vec3::to_array));
            found
        }),
    }
}

/// From the motion of a link to that at a mount on it.
pub fn mount_outward<R: Real>(mounting: Mounting) -> Stage<R> {
    Stage {
        name: "outward",
        about: "How a mount on a link moves.",
        parameters: vec![mounting.parameters()],
        inputs: vec![STANCE, W, REACHED],
        outputs: vec![W, REACHED],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let mount = mounting.read(&mut reader);
            let stance = Stance::read(mounting.inboard(), &mut reader);
            let spin = Spin::new(reader.vector());
            let (sigma, origin) = (reader.next(), reader.vector());
            let motion = Motion { alpha: R::zero(), sigma, spin, origin };
            let AtMount { spin, sigma, bias, .. } = motion.at(&stance, &mount);
            [&spin.to_array()[..], &[sigma], &bias.to_array()].concat()
        }),
    }
}

/// A link's joint eliminated.
pub fn joint_inward<R: Real>(standing: Standing) -> Stage<R> {
    Stage {
        name: "inward",
        about: "A link's joint eliminated: what it transmits at its mount, and what is left for the way back.",
        parameters: vec![LINK_BODY],
        inputs: vec![STANCE, BIAS, TORQUE, OUTBOARD],
        outputs: vec![SHARE, JOINT],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let constants = reader.rigid();
            let stance = Stance::read(standing, &mut reader);
            let wrench = Wrench { moment: reader.vector(), force: reader.vector() };
            let torque = reader.next();
            let body = Turned::last(stance.turned.rigid(&constants), wrench);
            let mut seen = limb::of_body(&body);
            seen.add(&AtOrigin::read(&mut reader));
            let (joint, share) = EliminatedJoint::of(joint(standing), &body, &seen, torque);
            let at_mount = stance.share_at_mount(&share);
            [at_mount.flat(), EliminatedLink { stance, joint }.flat(standing)].concat()
        }),
    }
}

/// From what a joint transmits at its mount to what that shows at the inboard link's origin.
pub fn mount_inward<R: Real>(mounting: Mounting) -> Stage<R> {
    Stage {
        name: "inward",
        about: "What a joint transmits, at the origin of its inboard link.",
        parameters: vec![mounting.parameters()],
        inputs: vec![STANCE, SHARE],
        outputs: vec![OUTBOARD],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let mount = mounting.read(&mut reader);
            let stance = Stance::read(mounting.inboard(), &mut reader);
            stance.share_carried(&mount, &AtOrigin::read(&mut reader)).flat()
        }),
    }
}

/// What a limb shows at O.
pub fn limb_root<R: Real>() -> Stage<R> {
    Stage {
        name: "root",
        about: "What a limb shows at O, main-body axes.",
        parameters: vec![BRANCH],
        inputs: vec![SHARE],
        outputs: vec![AT_ORIGIN],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            limb::at_origin(&AtOrigin::read(&mut reader), &branch).flat()
        }),
    }
}

/// From the accelerations at a link's mount to those of the link.
pub fn joint_back<R: Real>(standing: Standing) -> Stage<R> {
    Stage {
        name: "back",
        about: "τ̇ of a joint, and the accelerations of its link.",
        parameters: vec![],
        inputs: vec![JOINT, TURNING, HINGE_RATES],
        outputs: vec![TAU_DOT, TURNING, HINGE_RATES],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let link = EliminatedLink::read(standing, &mut reader);
            let at_mount = Twist { angular: reader.vector(), linear: reader.vector() };
            let inboard = link.stance.carried_by(at_mount);
            let (own, tau_dot) = link.joint.back(joint(standing), inboard);
            [&[tau_dot], &own.angular.to_array()[..], &own.linear.to_array()].concat()
        }),
    }
}

/// From the accelerations of a link to those at a mount on it.
pub fn mount_back<R: Real>(mounting: Mounting) -> Stage<R> {
    Stage {
        name: "back",
        about: "The accelerations of a mount on a link.",
        parameters: vec![mounting.parameters()],
        inputs: vec![JOINT, TURNING, HINGE_RATES],
        outputs: vec![TURNING, HINGE_RATES],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let mount = mounting.read(&mut reader);
            let link = EliminatedLink::read(mounting.inboard(), &mut reader);
            let own = Twist { angular: reader.vector(), linear: reader.vector() };
            let Twist { angular, linear } = link.stance.carries(&mount, own);
            [angular.to_array(), linear.to_array()].concat()
        }),
    }
}

/// A joint that leaves the same free.
fn joint(standing: Standing) -> LimbJoint {
    match standing {
        Standing::Sliding => LimbJoint::Prismatic,
        Standing::Turning | Standing::WithAxes => LimbJoint::Revolute,
    }
}
