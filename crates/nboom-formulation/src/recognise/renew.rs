//! A tree whose links hang as those of one that is known, where only masses and inertias are new.

use nboom_model::{Joint, Link, WeldedTree};
use nboom_scalar::{Mat3, Vec3};

use crate::recognise::{Recognised, check};

/// How the links of a tree hang on each other, if that says all of the frames of links: those of limbs depend on
/// inertias too.
#[derive(Clone, Debug, PartialEq)]
pub struct Seats(Option<Vec<Seat>>);

/// How a link hangs on its inboard one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seat {
    inboard: Option<usize>,
    point: Vec3<f64>,
    rot_inboard_at_zero: Mat3<f64>,
    joint: Joint,
    axis: Vec3<f64>,
}

impl Seat {
    fn of(link: &Link<f64>) -> Self {
        let Link { inboard, point, rot_inboard_at_zero, joint, axis, .. } = *link;
        Self { inboard, point, rot_inboard_at_zero, joint, axis }
    }
}

impl Seats {
    /// Those of the tree that was recognised.
    pub fn of(recognised: &Recognised, tree: &WeldedTree<f64>) -> Self {
        let has_limbs = recognised.topology.has_limbs();
        Self((!has_limbs).then(|| tree.links.iter().map(Seat::of).collect()))
    }
}

impl Recognised {
    /// Makes it what [`recognise`](crate::recognise) finds of `tree`, without allocation, if this tree has the `seats`
    /// of the one that was recognised and they say all of its frames. Returns whether that is so; if not, nothing
    /// changes.
    pub fn renew(&mut self, seats: &Seats, tree: &WeldedTree<f64>) -> bool {
        let Seats(Some(seats)) = seats else { return false };
        if check(tree).is_err() || !seats.iter().copied().eq(tree.links.iter().map(Seat::of)) {
            return false;
        }
        let Self { parameters, links, frames, .. } = self;
        (parameters.main, parameters.main_is_held) = (tree.free_main(), tree.held.is_some());
        let constants = parameters.branches.iter_mut().flat_map(|branch| &mut branch.links);
        for (of_link, (&link, frame)) in constants.zip(links.iter().zip(frames)) {
            of_link.inertia = frame.inertia(&tree.links[link].inertia);
        }
        true
    }
}
