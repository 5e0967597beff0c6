use crate::{HingeState, Scene};

/// What is provably simple about a scene, so that it need not be paid for.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Facts {
    /// No uniform gravity.
    pub no_gravity: bool,
    /// No thrust during the run.
    pub no_thrust: bool,
    /// Hinges without a kick-off spring.
    pub hinges_without_kick_off: usize,
    /// Hinges that are held at the initial time.
    pub hinges_held_at_start: usize,
    /// All hinges.
    pub hinges: usize,
}

impl Facts {
    /// The facts of a scene.
    pub fn of(scene: &Scene) -> Self {
        let count = |test: &dyn Fn(&crate::Hinge) -> bool| {
            scene.bodies.iter().filter(|body| test(&body.hinge)).count()
        };
        Self {
            no_gravity: scene.gravity.is_none(),
            no_thrust: scene.thrust.is_none(),
            hinges_without_kick_off: count(&|h| h.kick_off.is_none()),
            hinges_held_at_start: count(&|h| h.start.state != HingeState::Free),
            hinges: scene.bodies.len(),
        }
    }

    /// One phrase for each thing the generic path does not compute because of these facts.
    pub fn skipped(&self) -> Vec<String> {
        let mut skipped = Vec::new();
        if self.no_gravity {
            skipped.push("gravity".to_owned());
        }
        if self.no_thrust {
            skipped.push("thrust and the integration of the mass centre".to_owned());
        }
        let mut count = |what: &str, n: usize| {
            if n > 0 {
                skipped.push(format!("{what} at {n} of {} hinges", self.hinges));
            }
        };
        count("kick-off springs", self.hinges_without_kick_off);
        count("equations of motion, until they are released,", self.hinges_held_at_start);
        skipped
    }
}
