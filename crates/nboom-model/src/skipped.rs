use crate::{Hinge, HingeState, Scene};

/// What a run of this scene does not compute because the scene lacks it, a phrase for each thing.
pub fn skipped(scene: &Scene) -> Vec<String> {
    let mut skipped = Vec::new();
    if scene.gravity.is_none() {
        skipped.push("gravity".to_owned());
    }
    if scene.externals.is_empty() {
        skipped.push("thrust and the integration of the mass centre".to_owned());
    }
    let mut count = |what: &str, lacks: fn(&Hinge) -> bool| {
        let n = scene.bodies.iter().filter(|body| lacks(&body.hinge)).count();
        if n > 0 {
            skipped.push(format!("{what} at {n} of {} hinges", scene.bodies.len()));
        }
    };
    count("kick-off springs", |hinge| hinge.kick_off.is_none());
    count("equations of motion, until they are released,", |hinge| {
        hinge.start.state != HingeState::Free
    });
    skipped
}
