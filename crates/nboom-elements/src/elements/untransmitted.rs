use nboom_model::{Mode, Scene, WeldedTree};
use nboom_scalar::{Real, Vec3};

use crate::{Line, Placed};

/// The moment of a pushing spring about a hinge, which does not turn the hinge inboard of it: what
/// lies between the force that belongs to α, eq. (6.17) as printed, and that of β. There is one only
/// with [`MotionSlips::chain_kick_off`](nboom_model::MotionSlips).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Untransmitted<R> {
    /// The link whose hinge is not turned.
    pub link: usize,
    line: Line<R>,
    /// The link in which the outboard hinge sits, which may be held, and where.
    outboard: usize,
    point: Vec3<R>,
}

impl<R: Real> Untransmitted<R> {
    /// All of the lines that act; none unless the scene repeats the slip.
    pub fn all(scene: &Scene, mode: &Mode, tree: &WeldedTree<R>, lines: &[Line<R>]) -> Vec<Self> {
        let slipping = scene.slips().chain_kick_off;
        let acting = lines.iter().filter(|line| slipping && line.acts && line.link.is_some());
        acting.flat_map(|line| Self::of(*line, scene, mode, tree)).collect()
    }

    /// Those of one line.
    fn of(
        line: Line<R>,
        scene: &Scene,
        mode: &Mode,
        tree: &WeldedTree<R>,
    ) -> impl Iterator<Item = Self> {
        let inward = std::iter::successors(Some(line.hinge), |&i| scene.bodies[i].inboard);
        inward.filter(|&i| scene.adds_to_inboard_angle(i)).filter_map(move |outboard| {
            let inboard = scene.bodies[outboard].inboard.filter(|&i| mode.is_free(i))?;
            let (link, member) = (tree.members[inboard].link?, tree.members[outboard]);
            Some(Self { link, line, outboard: member.link?, point: member.point })
        })
    }

    /// The moment about the axis.
    #[inline]
    pub fn torque<P: Placed<R>>(&self, links: &[P]) -> R {
        let (end, force) = self.line.end_and_force(links);
        let outboard = &links[self.outboard];
        let hinge = outboard.position() + *outboard.rot() * self.point;
        links[self.link].axis().dot((end - hinge).cross(force))
    }
}
