use nboom_model::{Link, Shape, Topology, WeldedTree};
use nboom_scalar::{Mat3, RigidInertia, Vec3};

use crate::chain::ChainLink;
use crate::parameters::{Branch, Parameters};

/// A welded tree written as chains and paddles.
#[derive(Clone, Debug, PartialEq)]
pub struct Recognised {
    /// The shapes of its appendages.
    pub topology: Topology,
    /// Their constants, in the topology's order.
    pub parameters: Parameters<f64>,
    /// For each hinge in the topology's order, its link in the tree.
    pub links: Vec<usize>,
}

/// Departure from parallel or square axes that is taken for rounding.
const SAME_AXIS: f64 = 1e-12;

/// Writes the tree as chains and paddles.
///
/// # Errors
/// The first link (an index of the tree) that does not fit: one that is not rigid, one of two links
/// on the same inboard link, or one whose axis is neither that of a chain nor that of a paddle.
pub fn recognise(tree: &WeldedTree<f64>) -> Result<Recognised, usize> {
    rigid(tree)?;
    let mut appendages: Vec<(Shape, Branch<f64>, Vec<usize>)> = Vec::new();
    for root in (0..tree.links.len()).filter(|&j| tree.links[j].inboard.is_none()) {
        appendages.push(appendage(tree, root)?);
    }
    let topology = Topology::new(appendages.iter().map(|(shape, ..)| *shape));
    let mut parameters = Parameters { main: tree.main, branches: Vec::new() };
    let mut links = Vec::new();
    for shape in topology.shapes() {
        let next = appendages.iter().position(|(other, ..)| other == shape);
        let (_, branch, of_branch) =
            appendages.remove(next.expect("the topology holds the same shapes"));
        parameters.branches.push(branch);
        links.extend(of_branch);
    }
    Ok(Recognised { topology, parameters, links })
}

/// Whether every link is rigid.
///
/// # Errors
/// The first link that is not.
pub(crate) fn rigid(tree: &WeldedTree<f64>) -> Result<(), usize> {
    tree.turned.first().map_or(Ok(()), |&(link, _)| Err(link))
}

/// One appendage: its shape, constants and links.
fn appendage(
    tree: &WeldedTree<f64>,
    root: usize,
) -> Result<(Shape, Branch<f64>, Vec<usize>), usize> {
    let links = path_outward(tree, root)?;
    let of = |j: usize| &tree.links[j];
    match links[..] {
        [arm, paddle] if axis_along(of(paddle)).dot(of(arm).axis).abs() < SAME_AXIS => {
            Ok((Shape::Paddle, paddle_branch(of(arm), of(paddle)), links))
        }
        _ => {
            let branch = chain_branch(tree, &links)?;
            Ok((Shape::Chain(links.len()), branch, links))
        }
    }
}

/// Link frames are chosen so that all coincide at hinge angles zero, and origins so that all
/// lie in one plane square to the hinges.
fn chain_branch(tree: &WeldedTree<f64>, links: &[usize]) -> Result<Branch<f64>, usize> {
    let first = &tree.links[links[0]];
    let mut frame = frame_of(first.axis, square_to(first.axis));
    let rot = first.rot_inboard_at_zero * frame;
    let mut branch = Branch {
        rot_body_from_appendage: rot,
        point: rot.transpose_mul(first.point),
        links: vec![constants(&first.inertia, &frame, 0.0)],
    };
    let mut slid = 0.0;
    for pair in links.windows(2) {
        let (inboard, link) = (&tree.links[pair[0]], &tree.links[pair[1]]);
        if (axis_along(link) - inboard.axis).norm() > SAME_AXIS {
            return Err(pair[1]);
        }
        let next = frame.transpose_mul(link.point);
        slid += next.x;
        if let Some(last) = branch.links.last_mut() {
            last.next = [next.y, next.z];
        }
        frame = link.rot_inboard_at_zero.transpose() * frame;
        branch.links.push(constants(&link.inertia, &frame, slid));
    }
    Ok(branch)
}

/// The arm's second axis is along the paddle's hinge; the arm's origin lies square to it.
fn paddle_branch(arm: &Link<f64>, paddle: &Link<f64>) -> Branch<f64> {
    let frame = frame_of(arm.axis, axis_along(paddle));
    let rot = arm.rot_inboard_at_zero * frame;
    let next = frame.transpose_mul(paddle.point);
    let mut of_arm = constants(&arm.inertia, &frame, -next.x);
    of_arm.next = [next.y, next.z];
    let of_paddle = paddle.rot_inboard_at_zero.transpose() * frame;
    Branch {
        rot_body_from_appendage: rot,
        point: rot.transpose_mul(arm.point) + Vec3::unit_x() * next.x,
        links: vec![of_arm, constants(&paddle.inertia, &of_paddle, 0.0)],
    }
}

/// The hinge axis of a link, inboard link's axes.
fn axis_along(link: &Link<f64>) -> Vec3<f64> {
    link.rot_inboard_at_zero * link.axis
}

/// Constants in the frame whose axes are the columns of `frame`, about an origin from which
/// the old one is seen at `along` on the hinge axis.
fn constants(inertia: &RigidInertia<f64>, frame: &Mat3<f64>, along: f64) -> ChainLink<f64> {
    let turned = inertia.rotated(&frame.transpose());
    ChainLink { inertia: turned.seen_from(Vec3::unit_x() * along), next: [0.0; 2] }
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
