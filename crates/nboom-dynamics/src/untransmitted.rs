use nboom_model::{Mode, Scene, WeldedTree};
use nboom_scalar::{Real, Vec3};

use crate::pose::LinkPose;
use crate::pushing::PushingSpring;

/// The moment of a pushing spring about a hinge, which does not turn the hinge inboard of it: what
/// lies between the force that belongs to α, eq. (6.17) as printed, and that of β. There is one only
/// with [`MotionSlips::chain_kick_off`](nboom_model::MotionSlips).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Untransmitted<R> {
    /// The link whose hinge is not turned.
    pub link: usize,
    spring: PushingSpring<R>,
    /// The link in which the outboard hinge sits, which may be held, and where.
    outboard: usize,
    point: Vec3<R>,
}

impl<R: Real> Untransmitted<R> {
    /// All in `mode`; none unless the scene repeats the slip.
    pub fn all(scene: &Scene, mode: &Mode, tree: &WeldedTree<R>) -> Vec<Self> {
        let slipping = scene.slips().chain_kick_off;
        let pushing = (0..scene.bodies.len()).filter(|&i| slipping && mode.kick_off[i]);
        let springs = pushing.filter_map(|i| Some((i, PushingSpring::of(scene, tree, i)?)));
        springs.flat_map(|(i, spring)| Self::of(spring, i, scene, mode, tree)).collect()
    }

    /// Those of the spring of hinge `i`.
    fn of(
        spring: PushingSpring<R>,
        i: usize,
        scene: &Scene,
        mode: &Mode,
        tree: &WeldedTree<R>,
    ) -> impl Iterator<Item = Self> {
        let inward = std::iter::successors(Some(i), |&i| scene.bodies[i].inboard);
        inward.filter(|&i| scene.adds_to_inboard_angle(i)).filter_map(move |outboard| {
            let inboard = scene.bodies[outboard].inboard.filter(|&i| mode.is_free(i))?;
            let (link, member) = (tree.members[inboard].link?, tree.members[outboard]);
            Some(Self { link, spring, outboard: member.link?, point: member.point })
        })
    }

    /// The moment about the axis.
    #[inline]
    pub fn torque(&self, poses: &[LinkPose<R>]) -> R {
        let (end, force) = self.spring.end_and_force(poses);
        let outboard = &poses[self.outboard];
        let hinge = outboard.position + outboard.rot * self.point;
        poses[self.link].axis.dot((end - hinge).cross(force))
    }
}
