//! Forces and torques from outside that act at no time of the run.

use nboom_scalar::Vec3;

use super::ModelWarning;
use crate::Scene;

pub(super) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let run = [scene.initial.time, scene.end_time];
    let pushing = scene.externals.iter().filter(|one| one.amount != Vec3::zero());
    let idle = pushing.filter_map(|one| {
        let [on, off] = one.course.span();
        let acts = on < off && on < run[1] && off > run[0];
        let body = scene.body_name(one.body);
        (!acts).then_some(ModelWarning::NeverActs { kind: one.kind, body, span: [on, off], run })
    });
    idle.collect()
}
