use std::fmt;

use crate::{HingeLabel, HingeState, Release, Scene};

/// Something a scene may do but its author probably does not want.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModelWarning {
    /// These hinges wait for each other's angles, and none can move first.
    ReleaseCircle(Vec<HingeLabel>),
    /// This hinge waits for the angle of a hinge that never turns.
    TriggerNeverTurns {
        /// The waiting hinge.
        hinge: HingeLabel,
        /// The hinge it waits for.
        trigger: HingeLabel,
    },
}

impl fmt::Display for ModelWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ReleaseCircle(hinges) => {
                let names: Vec<String> = hinges.iter().map(HingeLabel::to_string).collect();
                let names = names.join(" <- ");
                write!(f, "hinges release each other in a circle and never start: {names}")
            }
            Self::TriggerNeverTurns { hinge, trigger } => {
                write!(f, "hinge {hinge} waits for hinge {trigger}, which never turns")
            }
        }
    }
}

pub(crate) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let mut warnings = Vec::new();
    for i in 0..scene.bodies.len() {
        let Some(trigger) = waits_for(scene, i) else { continue };
        let circle = circle_from(scene, i);
        if circle.first() == Some(&i) && circle.iter().min() == Some(&i) {
            let labels = circle.iter().map(|&j| scene.label(j)).collect();
            warnings.push(ModelWarning::ReleaseCircle(labels));
        } else if never_turns(scene, trigger) {
            let (hinge, trigger) = (scene.label(i), scene.label(trigger));
            warnings.push(ModelWarning::TriggerNeverTurns { hinge, trigger });
        }
    }
    warnings
}

/// The hinge that an unreleased hinge `i` waits for, unless that one starts at the angle.
fn waits_for(scene: &Scene, i: usize) -> Option<usize> {
    let hinge = &scene.bodies[i].hinge;
    match hinge.release {
        Release::Angle { hinge: trigger, angle }
            if hinge.start.state == HingeState::Unreleased
                && scene.bodies[trigger].hinge.start.angle != angle =>
        {
            Some(trigger)
        }
        _ => None,
    }
}

fn never_turns(scene: &Scene, i: usize) -> bool {
    let hinge = &scene.bodies[i].hinge;
    match hinge.start.state {
        HingeState::Free => false,
        HingeState::Locked => true,
        HingeState::Unreleased => hinge.release == Release::Never,
    }
}

/// The hinges met by following triggers from `start` until one comes round again; empty when
/// the chain ends.
fn circle_from(scene: &Scene, start: usize) -> Vec<usize> {
    let mut seen = vec![start];
    while let Some(next) = waits_for(scene, seen[seen.len() - 1]) {
        if let Some(position) = seen.iter().position(|&j| j == next) {
            return seen.split_off(position);
        }
        seen.push(next);
    }
    Vec::new()
}
