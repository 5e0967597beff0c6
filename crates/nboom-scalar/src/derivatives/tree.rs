use crate::{Mat3, RigidInertia, Sym3, Vec3};

/// A link of a tree, and where its numbers stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeLink {
    /// Which link carries it; none if the main body does.
    pub inboard: Option<usize>,
    /// How it moves on what carries it.
    pub joint: TreeJoint,
    /// Where its joint is.
    pub mount: TreeMount,
    /// Where its ten numbers begin among the parameters: mass, first moment, moments J_xx, J_yy, J_zz and products J_xy,
    /// J_xz, J_yz about its joint, along its own axes.
    pub body: usize,
    /// Where its angle or travel stands in a state.
    pub angle: usize,
    /// Where its rate stands in a state.
    pub rate: usize,
    /// Where the torque or force about its joint stands in a state.
    pub torque: usize,
    /// Where its acceleration stands among the accelerations.
    pub acceleration: usize,
}

/// How a link moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeJoint {
    /// It turns about the first of its axes.
    Revolute,
    /// It turns about the second of its axes, as a paddle on its arm does.
    RevoluteAboutSecond,
    /// It slides along the first of its axes.
    Prismatic,
}

/// Where a joint is, and how the axes of its link are turned at angle zero; the numbers begin at this parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeMount {
    /// Twelve numbers: the rotation from the link's axes to those of the main body, row by row, then the joint from O
    /// along the link's axes.
    OnMain(usize),
    /// Twelve numbers: the rotation to the axes of the inboard link, row by row, then the joint from that of the inboard
    /// link, along the axes of the inboard link.
    Across(usize),
    /// Axes as those of the inboard link; two numbers, the second and third component of the way from its joint.
    Parallel(usize),
}

/// A link and where it is mounted.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyOnMount {
    /// From the link's axes at angle zero to those of what carries it.
    pub rot: Mat3<f64>,
    /// The joint from that of the inboard link or from O, along the axes of what carries it.
    pub point: Vec3<f64>,
    /// Along the link's axes, about its joint.
    pub body: RigidInertia<f64>,
}

/// The main body about O.
pub(super) fn main_body(parameters: &[f64]) -> RigidInertia<f64> {
    rigid(&parameters[..10])
}

/// A link with its numbers.
pub(super) fn on_mount(link: &TreeLink, parameters: &[f64]) -> BodyOnMount {
    let body = rigid(&parameters[link.body..link.body + 10]);
    let twelve = |at: usize| {
        let vector = |i: usize| Vec3::new(parameters[i], parameters[i + 1], parameters[i + 2]);
        (Mat3::from_rows(vector(at), vector(at + 3), vector(at + 6)), vector(at + 9))
    };
    match link.mount {
        TreeMount::OnMain(at) => {
            let (rot, point) = twelve(at);
            BodyOnMount { rot, point: rot * point, body }
        }
        TreeMount::Across(at) => {
            let (rot, point) = twelve(at);
            BodyOnMount { rot, point, body }
        }
        TreeMount::Parallel(at) => {
            let point = Vec3::new(0.0, parameters[at], parameters[at + 1]);
            BodyOnMount { rot: Mat3::identity(), point, body }
        }
    }
}

fn rigid(numbers: &[f64]) -> RigidInertia<f64> {
    let &[mass, cx, cy, cz, xx, yy, zz, xy, xz, yz] = numbers else {
        unreachable!("slices of ten numbers")
    };
    let about_origin = Sym3 { xx, yy, zz, xy, xz, yz };
    RigidInertia { mass, first_moment: Vec3::new(cx, cy, cz), about_origin }
}
