use std::fmt;

use nboom_model::{Limb, Link, Shape, Topology, WeldedTree};
use nboom_scalar::{Mat3, RigidInertia, Vec3};

use crate::chain::ChainLink;
use crate::parameters::{Branch, Parameters};

mod limb;
mod renew;

pub use renew::Seats;

/// A welded tree written as chains, paddles and limbs.
#[derive(Clone, Debug, PartialEq)]
pub struct Recognised {
    /// The shapes of its appendages.
    pub topology: Topology,
    /// Their constants, in the topology's order.
    pub parameters: Parameters<f64>,
    /// For each hinge in the topology's order, its link in the tree.
    pub links: Vec<usize>,
    /// For each hinge in the topology's order, the frame in which its link's constants are written.
    pub frames: Vec<LinkFrame>,
}

/// The frame in which the constants of a link are written, as it stands in the link's axes. ê₁ is along the
/// first hinge of a chain or paddle, in a limb along the link's own joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkFrame {
    /// Turns components along the frame into link components.
    rot: Mat3<f64>,
    /// The link's hinge point on ê₁, from the frame's origin.
    along: f64,
}

impl LinkFrame {
    /// A point of the link, given from its hinge in link axes, from the frame's origin along the
    /// frame.
    pub fn point(&self, from_hinge: Vec3<f64>) -> Vec3<f64> {
        self.rot.transpose_mul(from_hinge) + Vec3::unit_x() * self.along
    }

    /// Constants of a link along the frame, without the way to the next hinge.
    fn constants(&self, inertia: &RigidInertia<f64>) -> ChainLink<f64> {
        ChainLink { inertia: self.inertia(inertia), next: [0.0; 2] }
    }

    /// Mass properties about the frame's origin and along the frame of those about the link's hinge in link axes.
    fn inertia(&self, of_link: &RigidInertia<f64>) -> RigidInertia<f64> {
        of_link.rotated(&self.rot.transpose()).seen_from(Vec3::unit_x() * self.along)
    }
}

/// What of a welded tree a closed form does not cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Uncovered {
    /// The first link (an index of the tree) that it cannot express.
    pub link: usize,
    /// Why not.
    pub why: Why,
}

/// What keeps a closed form from covering a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// An inertia turns otherwise than its body.
    NotRigid,
    /// A motor sets its speed.
    Rotor,
    /// More links hang on the main body by it.
    Links,
    /// It is for chains and paddles alone.
    Shape,
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotRigid => write!(f, "is not rigid"),
            Self::Rotor => write!(f, "has a rotor"),
            Self::Links => write!(f, "has more than {} links", Limb::MOST_LINKS),
            Self::Shape => write!(f, "is neither a chain nor a paddle"),
        }
    }
}

/// Departure from parallel or square axes that is taken for rounding.
const SAME_AXIS: f64 = 1e-12;

/// Writes the tree as chains, paddles, and limbs where an appendage is neither. A main body that
/// is held is replaced by [one that is free and heavy](WeldedTree::free_main).
///
/// # Errors
/// The first link that does not fit: one that is not rigid or carries a rotor, or the first of an appendage of more than
/// [`Limb::MOST_LINKS`](nboom_model::Limb::MOST_LINKS).
pub fn recognise(tree: &WeldedTree<f64>) -> Result<Recognised, Uncovered> {
    check(tree)?;
    let mut appendages: Vec<Appendage> = Vec::new();
    for root in roots(tree) {
        let planar = planar(tree, root).ok();
        let any = planar.or_else(|| limb::appendage(tree, root));
        appendages.push(any.ok_or(Uncovered { link: root, why: Why::Links })?);
    }
    let topology = Topology::new(appendages.iter().map(|appendage| appendage.shape.clone()));
    let (main, main_is_held) = (tree.free_main(), tree.held.is_some());
    let mut parameters = Parameters { main, main_is_held, branches: Vec::new() };
    let (mut links, mut frames) = (Vec::new(), Vec::new());
    for shape in topology.shapes() {
        let next = appendages.iter().position(|other| other.shape == *shape);
        let appendage = appendages.remove(next.expect("the topology holds the same shapes"));
        parameters.branches.push(appendage.branch);
        links.extend(appendage.links);
        frames.extend(appendage.frames);
    }
    Ok(Recognised { topology, parameters, links, frames })
}

/// Whether the tree is made of chains and paddles.
///
/// # Errors
/// As [`recognise`], and with the first link that slides, branches, or has an axis that is neither that of a
/// chain nor that of a paddle.
pub(crate) fn chains_and_paddles(tree: &WeldedTree<f64>) -> Result<(), Uncovered> {
    check(tree)?;
    let slides = tree.links.iter().position(|link| link.joint.slides());
    let not = |link| Uncovered { link, why: Why::Shape };
    slides.map_or(Ok(()), |link| Err(not(link)))?;
    roots(tree).try_for_each(|root| planar(tree, root).map(|_| ()).map_err(not))
}

/// Whether every link is rigid and none carries a rotor.
fn check(tree: &WeldedTree<f64>) -> Result<(), Uncovered> {
    rigid(tree)?;
    let carries_rotor = tree.links.iter().position(|link| link.spin.is_some());
    carries_rotor.map_or(Ok(()), |link| Err(Uncovered { link, why: Why::Rotor }))
}

/// The links on the main body.
fn roots(tree: &WeldedTree<f64>) -> impl Iterator<Item = usize> {
    (0..tree.links.len()).filter(|&j| tree.links[j].inboard.is_none())
}

/// An appendage of the tree, links inboard before outboard.
struct Appendage {
    shape: Shape,
    branch: Branch<f64>,
    links: Vec<usize>,
    frames: Vec<LinkFrame>,
}

/// Whether every link is rigid.
///
/// # Errors
/// The first link that is not.
pub(crate) fn rigid(tree: &WeldedTree<f64>) -> Result<(), Uncovered> {
    let not = |&(link, _): &(usize, _)| Uncovered { link, why: Why::NotRigid };
    tree.turned.first().map_or(Ok(()), |turned| Err(not(turned)))
}

/// The chain or paddle that begins with the link `root`.
///
/// # Errors
/// The first link that belongs to neither.
fn planar(tree: &WeldedTree<f64>, root: usize) -> Result<Appendage, usize> {
    let links = path_outward(tree, root)?;
    let of = |j: usize| &tree.links[j];
    links.iter().find(|&&j| of(j).joint.slides()).map_or(Ok(()), |&j| Err(j))?;
    match links[..] {
        [arm, paddle] if axis_along(of(paddle)).dot(of(arm).axis).abs() < SAME_AXIS => {
            let (branch, frames) = paddle_branch(of(arm), of(paddle));
            Ok(Appendage { shape: Shape::Paddle, branch, links, frames: frames.to_vec() })
        }
        _ => {
            let (branch, frames) = chain_branch(tree, &links)?;
            Ok(Appendage { shape: Shape::Chain(links.len()), branch, links, frames })
        }
    }
}

/// Link frames are chosen so that all coincide at hinge angles zero, and origins so that all
/// lie in one plane square to the hinges.
fn chain_branch(
    tree: &WeldedTree<f64>,
    links: &[usize],
) -> Result<(Branch<f64>, Vec<LinkFrame>), usize> {
    let first = &tree.links[links[0]];
    let mut frame = LinkFrame { rot: frame_of(first.axis, square_to(first.axis)), along: 0.0 };
    let mut frames = vec![frame];
    let rot = first.rot_inboard_at_zero * frame.rot;
    let mut branch = Branch {
        rot_body_from_appendage: rot,
        point: rot.transpose_mul(first.point),
        links: vec![frame.constants(&first.inertia)],
        mounts: None,
    };
    for pair in links.windows(2) {
        let (inboard, link) = (&tree.links[pair[0]], &tree.links[pair[1]]);
        if (axis_along(link) - inboard.axis).norm() > SAME_AXIS {
            return Err(pair[1]);
        }
        let next = frame.rot.transpose_mul(link.point);
        frame.along += next.x;
        if let Some(last) = branch.links.last_mut() {
            last.next = [next.y, next.z];
        }
        frame.rot = link.rot_inboard_at_zero.transpose() * frame.rot;
        branch.links.push(frame.constants(&link.inertia));
        frames.push(frame);
    }
    Ok((branch, frames))
}

/// The arm's second axis is along the paddle's hinge; the arm's origin lies square to it.
fn paddle_branch(arm: &Link<f64>, paddle: &Link<f64>) -> (Branch<f64>, [LinkFrame; 2]) {
    let frame = frame_of(arm.axis, axis_along(paddle));
    let rot = arm.rot_inboard_at_zero * frame;
    let next = frame.transpose_mul(paddle.point);
    let of_paddle = paddle.rot_inboard_at_zero.transpose() * frame;
    let frames =
        [LinkFrame { rot: frame, along: -next.x }, LinkFrame { rot: of_paddle, along: 0.0 }];
    let mut of_arm = frames[0].constants(&arm.inertia);
    of_arm.next = [next.y, next.z];
    let branch = Branch {
        rot_body_from_appendage: rot,
        point: rot.transpose_mul(arm.point) + Vec3::unit_x() * next.x,
        links: vec![of_arm, frames[1].constants(&paddle.inertia)],
        mounts: None,
    };
    (branch, frames)
}

/// The hinge axis of a link, inboard link's axes.
fn axis_along(link: &Link<f64>) -> Vec3<f64> {
    link.rot_inboard_at_zero * link.axis
}

/// Columns: `first`, `second`, and the axis that completes a right-handed triad.
fn frame_of(first: Vec3<f64>, second: Vec3<f64>) -> Mat3<f64> {
    Mat3::from_columns(first, second, first.cross(second))
}

/// A unit vector square to `axis`: the second body axis where that is possible.
fn square_to(axis: Vec3<f64>) -> Vec3<f64> {
    let near = if axis.y.abs() < 0.9 { Vec3::unit_y() } else { Vec3::unit_z() };
    let square = near - axis * axis.dot(near);
    square * (1.0 / square.norm())
}

/// The links from `root` outward, as long as none branches.
fn path_outward(tree: &WeldedTree<f64>, root: usize) -> Result<Vec<usize>, usize> {
    let mut path = vec![root];
    loop {
        let last = path[path.len() - 1];
        let mut outboard = (0..tree.links.len()).filter(|&j| tree.links[j].inboard == Some(last));
        match (outboard.next(), outboard.next()) {
            (None, _) => return Ok(path),
            (Some(next), None) => path.push(next),
            (Some(_), Some(branching)) => return Err(branching),
        }
    }
}
