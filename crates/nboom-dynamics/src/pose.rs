use nboom_scalar::{Mat3, Real, RigidInertia, Vec3};

use crate::merged_tree::MergedTree;

/// Where one link is, main-body axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkPose<R> {
    /// Turns link components into main-body components.
    pub rot: Mat3<R>,
    /// The hinge from the inboard link's hinge (from O for the first ones).
    pub offset: Vec3<R>,
    /// The hinge from O.
    pub position: Vec3<R>,
    /// Unit vector along the hinge axis.
    pub axis: Vec3<R>,
    /// Mass properties about the hinge.
    pub inertia: RigidInertia<R>,
}

impl<R: Real> LinkPose<R> {
    pub fn unset() -> Self {
        Self {
            rot: Mat3::identity(),
            offset: Vec3::zero(),
            position: Vec3::zero(),
            axis: Vec3::zero(),
            inertia: RigidInertia::zero(),
        }
    }
}

/// Places every link at the hinge angles `beta` (one for each link).
#[inline]
pub(crate) fn place<R: Real>(tree: &MergedTree<R>, beta: &[R], poses: &mut [LinkPose<R>]) {
    for (j, link) in tree.links.iter().enumerate() {
        let (rot_inboard, position_inboard) = match link.inboard {
            Some(i) => (poses[i].rot, poses[i].position),
            None => (Mat3::identity(), Vec3::zero()),
        };
        let (s, c) = beta[j].sin_cos();
        let turned = link.still + link.along_cos * c + link.along_sin * s;
        let pose = &mut poses[j];
        if link.inboard.is_none() {
            (pose.rot, pose.offset, pose.axis) = (turned, link.point, link.axis);
        } else {
            pose.rot = rot_inboard * turned;
            pose.offset = rot_inboard * link.point;
            pose.axis = rot_inboard * link.axis;
        }
        pose.position = position_inboard + pose.offset;
    }
}

/// Turns the mass properties of every link along with it.
#[inline]
pub(crate) fn turn_inertias<R: Real>(tree: &MergedTree<R>, poses: &mut [LinkPose<R>]) {
    for (link, pose) in tree.links.iter().zip(poses) {
        pose.inertia = link.inertia.rotated(&pose.rot);
    }
}
