//! A limb of the tree, with frames in which most of its numbers vanish.

use nboom_model::{Limb, LimbJoint, LimbLink, Link, Shape, WeldedTree};
use nboom_scalar::{Mat3, Vec3};

use crate::parameters::{Branch, Mount};
use crate::recognise::{Appendage, LinkFrame, SAME_AXIS, axis_along, frame_of};

/// The limb that begins with the link `root`; `None` if it has too many links.
pub(super) fn appendage(tree: &WeldedTree<f64>, root: usize) -> Option<Appendage> {
    let found = links_outward(tree, root);
    let of_limb: Vec<LimbLink> =
        found.iter().map(|&j| limb_link(tree, &found, j)).collect::<Option<_>>()?;
    let (limb, order) = Limb::new(&of_limb)?;
    let links: Vec<usize> = order.into_iter().map(|i| found[i]).collect();
    let mut frames: Vec<LinkFrame> = Vec::with_capacity(links.len());
    let reaches = reaches(tree, &found);
    let (mut root_mount, mut mounts, mut constants) = (None, Vec::new(), Vec::new());
    for (&j, of_limb) in links.iter().zip(limb.links()) {
        let link = &tree.links[j];
        let inboard = of_limb.inboard.map(|i| frames[usize::from(i)]);
        let (frame, mount) = match (of_limb.joint, inboard) {
            (LimbJoint::Parallel, Some(inboard)) => parallel(link, inboard),
            (joint, inboard) => {
                let rot = simplest_frame(tree, j, inboard);
                let most = if joint == LimbJoint::Prismatic { 0.0 } else { FAR * reaches[j] };
                across(link, inboard.unwrap_or(ORIGIN), rot, most)
            }
        };
        frames.push(frame);
        constants.push(frame.constants(&link.inertia));
        match root_mount {
            None => root_mount = Some(mount),
            Some(_) => mounts.push(mount),
        }
    }
    let Some(Mount::Across { rot, point }) = root_mount else { return None };
    let branch = Branch {
        rot_body_from_appendage: rot,
        point: rot.transpose_mul(point),
        links: constants,
        mounts: Some(mounts),
    };
    Some(Appendage { shape: Shape::Limb(limb), branch, links, frames })
}

/// The frame of the main body.
const ORIGIN: LinkFrame = LinkFrame {
    rot: Mat3 {
        rows: [
            Vec3 { x: 1.0, y: 0.0, z: 0.0 },
            Vec3 { x: 0.0, y: 1.0, z: 0.0 },
            Vec3 { x: 0.0, y: 0.0, z: 1.0 },
        ],
    },
    along: 0.0,
};

/// `root` and all that is outboard of it, inboard before outboard.
fn links_outward(tree: &WeldedTree<f64>, root: usize) -> Vec<usize> {
    let mut found = vec![root];
    for j in root + 1..tree.links.len() {
        if tree.links[j].inboard.is_some_and(|inboard| found.contains(&inboard)) {
            found.push(j);
        }
    }
    found
}

/// What link `j` is in the limb of the links `found`; `None` if they are too many to be counted.
fn limb_link(tree: &WeldedTree<f64>, found: &[usize], j: usize) -> Option<LimbLink> {
    let link = &tree.links[j];
    let inboard = link.inboard.and_then(|inboard| found.iter().position(|&other| other == inboard));
    let joint = match inboard.map(|i| &tree.links[found[i]]) {
        _ if link.joint.slides() => LimbJoint::Prismatic,
        Some(inboard) if is_parallel(inboard, link) => LimbJoint::Parallel,
        _ => LimbJoint::Revolute,
    };
    let inboard = inboard.map(u16::try_from).transpose().ok()?;
    Some(LimbLink { inboard, joint })
}

fn is_parallel(inboard: &Link<f64>, link: &Link<f64>) -> bool {
    !(inboard.joint.slides() || link.joint.slides())
        && (axis_along(link) - inboard.axis).norm() < SAME_AXIS
}

/// The frame that coincides with the inboard one at hinge angle zero, its origin square to ê₁ from there.
fn parallel(link: &Link<f64>, inboard: LinkFrame) -> (LinkFrame, Mount<f64>) {
    let from_inboard = inboard.point(link.point);
    let rot = link.rot_inboard_at_zero.transpose() * inboard.rot;
    let way = rounded(from_inboard);
    (LinkFrame { rot, along: from_inboard.x }, Mount::Parallel([way.y, way.z]))
}

/// The frame that stands like `rot` in the link, its origin on the joint next to the inboard one if that is no further than
/// `most` from the joint's own point, else there.
fn across(
    link: &Link<f64>,
    inboard: LinkFrame,
    rot: Mat3<f64>,
    most: f64,
) -> (LinkFrame, Mount<f64>) {
    let from_inboard = inboard.point(link.point);
    let mount = exact(inboard.rot.transpose() * link.rot_inboard_at_zero * rot);
    let axis = Vec3::new(mount.rows[0].x, mount.rows[1].x, mount.rows[2].x);
    let next_to_inboard = from_inboard.dot(axis);
    let along = if next_to_inboard.abs() <= most { next_to_inboard } else { 0.0 };
    let point = rounded(from_inboard - axis * along);
    (LinkFrame { rot, along }, Mount::Across { rot: mount, point })
}

/// How many times as far as it reaches a link may be from the origin of its frame. What its joint moves is a difference of
/// inertias about that origin, of which rounding takes about the square of this.
const FAR: f64 = 32.0;

/// How far each of the links `found` and all that hangs on it reach from its joint at most, whatever the angles; of a body its
/// radius of gyration. Others of the tree have none.
fn reaches(tree: &WeldedTree<f64>, found: &[usize]) -> Vec<f64> {
    let mut reaches = vec![0.0_f64; tree.links.len()];
    for &j in found.iter().rev() {
        let Link { inboard, point, inertia, .. } = &tree.links[j];
        if inertia.mass > 0.0 {
            let gyration = (0.5 * inertia.about_origin.trace() / inertia.mass).sqrt();
            reaches[j] = reaches[j].max(gyration);
        }
        if let Some(inboard) = *inboard {
            reaches[inboard] = reaches[inboard].max(point.norm() + reaches[j]);
        }
    }
    reaches
}

/// Departure of an entry of a rotation from 0 and 1 that is taken for rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Entries that are 0 or 1 but for rounding, made so.
fn exact(rot: Mat3<f64>) -> Mat3<f64> {
    let entry = |x: f64| match x.abs() {
        small if small < ROUNDING => 0.0,
        one if (one - 1.0).abs() < ROUNDING => x.signum(),
        _ => x,
    };
    Mat3 { rows: rot.rows.map(|row| row.map(entry)) }
}

/// Components that are zero but for rounding, made so.
fn rounded(v: Vec3<f64>) -> Vec3<f64> {
    let small = ROUNDING * v.norm();
    v.map(|x| if x.abs() < small { 0.0 } else { x })
}

/// Columns: the axis of link `j`, and two that leave as few numbers other than 0 and 1 as possible in the
/// rotation from the inboard frame, in that of what is mounted further out, and in the ways there.
fn simplest_frame(tree: &WeldedTree<f64>, j: usize, inboard: Option<LinkFrame>) -> Mat3<f64> {
    let link = &tree.links[j];
    let from_inboard = link.rot_inboard_at_zero.transpose() * inboard.unwrap_or(ORIGIN).rot;
    let further = mounted_further(tree, j);
    let units = [Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()];
    let of_inboard = units.into_iter().map(|unit| from_inboard * unit);
    let of_further = further.iter().flat_map(|&(axis, way)| [axis, way]);
    let near = of_inboard.chain(of_further).chain(units);
    let squares = near.filter_map(|near| {
        let square = near - link.axis * link.axis.dot(near);
        let norm = square.norm();
        let share = norm / near.norm();
        // Of equal frames, those from a direction square to the axis, but for rounding, are taken first: they stay when
        // hinges are held at other angles.
        let leans = usize::from(share < 1.0 - 1e-14);
        (share > 0.1).then(|| (square * (1.0 / norm), leans))
    });
    let cost = |frame: &Mat3<f64>| {
        let of_mount = from_inboard.transpose() * *frame;
        let mut cost = 3 * of_mount.rows.into_iter().map(odd).sum::<usize>();
        for (axis, way) in &further {
            cost += 9 * odd(frame.transpose_mul(*axis)) + odd(frame.transpose_mul(*way));
        }
        let of_own = link.inertia.rotated(&frame.transpose());
        let i = of_own.about_origin;
        cost + odd(of_own.first_moment) + odd(Vec3::new(i.xy, i.xz, i.yz))
    };
    let frames = squares.map(|(square, leans)| (frame_of(link.axis, square), leans));
    let simplest = frames.min_by_key(|(frame, leans)| (cost(frame), *leans));
    simplest.map(|(frame, _)| frame).expect("two of the units are not along the axis")
}

/// How many components are neither zero nor, of a unit vector, the only one, but for rounding.
fn odd(v: Vec3<f64>) -> usize {
    let norm = v.norm();
    let others = v.to_array().into_iter().filter(|x| x.abs() > 1e-14 * norm).count();
    others - usize::from(others == 1 && (norm - 1.0).abs() < 1e-14)
}

/// Axes of, and ways to, what is mounted on a link, and on those that turn with it about parallel axes, as
/// they stand in its axes at hinge angles zero.
fn mounted_further(tree: &WeldedTree<f64>, j: usize) -> Vec<(Vec3<f64>, Vec3<f64>)> {
    let mut further = Vec::new();
    let mut waiting = vec![(j, Mat3::identity())];
    while let Some((inboard, rot)) = waiting.pop() {
        let outboard = tree.links.iter().enumerate();
        for (i, link) in outboard.filter(|(_, link)| link.inboard == Some(inboard)) {
            if is_parallel(&tree.links[inboard], link) {
                waiting.push((i, rot * link.rot_inboard_at_zero));
                further.push((tree.links[j].axis, rot * link.point));
            } else {
                further.push((rot * axis_along(link), rot * link.point));
            }
        }
    }
    further
}
