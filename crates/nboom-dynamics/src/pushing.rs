use nboom_elements::KickOffLaw;
use nboom_model::{Mode, Scene, WeldedTree};
use nboom_scalar::{Real, Vec3};

use crate::pose::LinkPose;

/// A kick-off spring that pushes a link; as a force on it and its reaction on the main body,
/// which gives eqs. (6.17) and (6.20), corrected: notes 7 and 8.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PushingSpring<R> {
    pub link: usize,
    /// Attachment on the link, from its hinge, link axes.
    pub point: Vec3<R>,
    /// Attachment on the main body, from O.
    pub main_body_point: Vec3<R>,
    pub law: KickOffLaw<R>,
}

impl<R: Real> PushingSpring<R> {
    /// The springs that push in `mode` and whose ends move against each other.
    pub fn all(scene: &Scene, mode: &Mode, tree: &WeldedTree<R>) -> Vec<Self> {
        let pushing = (0..scene.bodies.len()).filter(|&i| mode.kick_off[i]);
        pushing.filter_map(|i| Self::of(scene, tree, i)).collect()
    }

    /// That of hinge `i`, if there is one whose ends move against each other.
    pub fn of(scene: &Scene, tree: &WeldedTree<R>, i: usize) -> Option<Self> {
        let (member, spring) = (tree.members[i], scene.bodies[i].hinge.kick_off?);
        let in_link = member.rot_link_from_body * Vec3::constant(spring.body_point);
        Some(Self {
            link: member.link?,
            point: member.point + in_link,
            main_body_point: Vec3::constant(spring.main_body_point),
            law: KickOffLaw::new(spring.coefficients),
        })
    }

    /// Where the spring's end on the link is, from O, and the force on it; main-body axes.
    #[inline]
    pub fn end_and_force(&self, poses: &[LinkPose<R>]) -> (Vec3<R>, Vec3<R>) {
        let pose = &poses[self.link];
        let end = pose.position + pose.rot * self.point;
        let along = end - self.main_body_point;
        let length = along.norm();
        (end, along * (self.law.force(length) / length))
    }
}
