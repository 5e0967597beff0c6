//! Lock angles that fold an appendage onto itself.

use nboom_scalar::Vec3;

use super::ModelWarning;
use crate::{Posture, Scene};

/// Sines of angles, and ratios of a distance to the length in between, that count as zero.
const COINCIDENCE: f64 = 1e-6;

pub(super) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let posture = Posture::locked(scene);
    (0..scene.bodies.len())
        .filter_map(|i| {
            folds_back(scene, &posture, i).or_else(|| ends_at_hinge(scene, &posture, i))
        })
        .collect()
}

fn folds_back(scene: &Scene, posture: &Posture, i: usize) -> Option<ModelWarning> {
    let body = &scene.bodies[i];
    let lock = body.hinge.lock_angle.filter(|_| body.hinge.can_turn() && !body.joint.slides())?;
    let inboard = body.inboard?;
    let (here, before) = (&posture.hinges[i], &posture.hinges[inboard]);
    are_opposite(here.point - before.point, here.tip - here.point).then(|| {
        let (hinge, inboard) = (scene.label(i), scene.label(inboard));
        ModelWarning::FoldsBack { hinge, inboard, lock }
    })
}

fn are_opposite(a: Vec3<f64>, b: Vec3<f64>) -> bool {
    let scale = a.norm() * b.norm();
    a.dot(b) < 0.0 && a.cross(b).norm() <= COINCIDENCE * scale
}

/// Whether the body ends at a hinge inboard of its own. All hinges between that can turn must have
/// lock angles: nobody knows how another one comes to stand.
fn ends_at_hinge(scene: &Scene, posture: &Posture, i: usize) -> Option<ModelWarning> {
    let tip = posture.hinges[i].tip;
    let mut length = (tip - posture.hinges[i].point).norm();
    let (mut outboard, mut locks) = (i, false);
    while let Some(at) = scene.bodies[outboard].inboard {
        let (hinge, place) = (&scene.bodies[outboard].hinge, posture.hinges[at].point);
        if hinge.can_turn() {
            hinge.lock_angle?;
            locks = true;
        }
        length += (posture.hinges[outboard].point - place).norm();
        if locks && length > 0.0 && (tip - place).norm() <= COINCIDENCE * length {
            return Some(ModelWarning::EndsAtHinge { hinge: scene.label(i), at: scene.label(at) });
        }
        outboard = at;
    }
    None
}
