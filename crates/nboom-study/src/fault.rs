//! What a fault changes in a scene.

use nboom_model::{Hinge, HingeState, Release, SceneDescription, Spring};

use crate::study::{FailureMode, Fault, LateRelease};

/// Why a fault cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{} found, {} expected", self.found(), Self::EXPECTED)]
#[non_exhaustive]
pub enum FaultError {
    /// A hinge that is to be released late waits for the angle of another one.
    ReleaseByAngle,
    /// A hinge that is to be released late is never released.
    NoRelease,
}

impl FaultError {
    /// What would have been right.
    pub(crate) const EXPECTED: &str = "one by time";

    /// What is there instead.
    pub(crate) fn found(self) -> &'static str {
        match self {
            Self::ReleaseByAngle => "a release by another hinge's angle",
            Self::NoRelease => "no release",
        }
    }
}

impl Fault {
    /// Breaks what the fault breaks; its changes of single numbers are made before.
    ///
    /// # Errors
    /// When a hinge cannot be released late.
    pub fn apply(&self, description: &mut SceneDescription) -> Result<(), FaultError> {
        let SceneDescription { bodies: hinges, initial, .. } = description;
        for &LateRelease { hinge, by } in &self.late_release {
            let release = &mut hinges[hinge].hinge.release;
            *release = match *release {
                // What was due before the start is released then.
                Release::Time(time) => Release::Time(time.max(initial.time) + by),
                Release::AfterLock { hinge, delay } => {
                    Release::AfterLock { hinge, delay: delay + by }
                }
                Release::Angle { .. } => return Err(FaultError::ReleaseByAngle),
                Release::Never => return Err(FaultError::NoRelease),
            };
        }
        self.failures.iter().for_each(|&(mode, i)| mode.apply(&mut hinges[i].hinge));
        Ok(())
    }
}

impl FailureMode {
    fn apply(self, hinge: &mut Hinge) {
        match self {
            Self::Stuck => {
                hinge.start.rate = 0.0;
                // A latch that has closed stays closed.
                if hinge.start.state == HingeState::Free {
                    hinge.start.state = HingeState::Unreleased;
                }
                hinge.release = Release::Never;
            }
            Self::MissedRelease => hinge.release = Release::Never,
            Self::FailedLatch => hinge.lock_angle = None,
            Self::BrokenSpring => {
                hinge.spring = Spring::default();
                hinge.kick_off = None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use nboom_model::Scene;
    use nboom_sim::{Event, EventKind, Options, Recorder, Snapshot, simulate};

    use super::*;

    fn none() -> Fault {
        Fault {
            name: "broken".to_owned(),
            failures: Vec::new(),
            late_release: Vec::new(),
            changes: Vec::new(),
        }
    }

    fn failing(mode: FailureMode, hinge: usize) -> Fault {
        Fault { failures: vec![(mode, hinge)], ..none() }
    }

    #[derive(Default)]
    struct Events(Vec<(EventKind, Option<usize>, f64)>, Vec<f64>);

    impl Recorder for Events {
        fn event(&mut self, event: &Event, after: &Snapshot) -> std::io::Result<()> {
            self.0.push((event.kind, event.hinge, event.time));
            self.1.clone_from(&after.beta);
            Ok(())
        }
    }

    /// Events, and the angles at the end, of the cubesat with a fault.
    fn run(fault: &Fault) -> Events {
        run_of(fault, (*cubesat()).clone())
    }

    fn cubesat() -> Scene {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/cubesat.toml");
        nboom_io::read_scene(&path).expect("a scene").scene
    }

    fn run_of(fault: &Fault, mut description: SceneDescription) -> Events {
        fault.apply(&mut description).expect("possible");
        let scene = Scene::new(description).expect("a scene");
        let mut events = Events::default();
        simulate(&scene, &Options::default(), &mut events).expect("a run");
        events
    }

    fn time(events: &Events, kind: EventKind, hinge: usize) -> Option<f64> {
        events.0.iter().find(|of| (of.0, of.1) == (kind, Some(hinge))).map(|of| of.2)
    }

    #[test]
    fn a_stuck_hinge_stays_and_the_others_go_on() {
        for mode in [FailureMode::Stuck, FailureMode::MissedRelease] {
            let events = run(&failing(mode, 1));
            assert_eq!(time(&events, EventKind::Release, 1), None);
            assert_eq!(events.1[1], 90_f64.to_radians());
            assert!(time(&events, EventKind::LockUp, 0).is_some());
        }
    }

    #[test]
    fn a_late_release_is_later_by_so_much() {
        let late = LateRelease { hinge: 0, by: 0.25 };
        let events = run(&Fault { late_release: vec![late], ..none() });
        assert_eq!(time(&events, EventKind::Release, 0), Some(1.25));
        assert_eq!(time(&events, EventKind::Release, 1), Some(1.0));
    }

    #[test]
    fn a_release_that_was_due_before_the_start_is_late_from_the_start_on() {
        let mut description = (*cubesat()).clone();
        description.bodies[0].hinge.release = Release::Time(-5.0);
        let late = LateRelease { hinge: 0, by: 0.25 };
        let fault = Fault { late_release: vec![late], ..none() };
        let events = run_of(&fault, description);
        assert_eq!(time(&events, EventKind::Release, 0), Some(0.25));
    }

    #[test]
    fn a_failed_latch_lets_the_hinge_swing_on() {
        let events = run(&failing(FailureMode::FailedLatch, 2));
        assert_eq!(time(&events, EventKind::LockUp, 2), None);
        assert!(time(&events, EventKind::LockUp, 3).is_some());
    }

    /// Without its spring a panel is moved by the satellite's rates alone, of some degrees per second.
    #[test]
    fn a_broken_spring_does_not_push() {
        let events = run(&failing(FailureMode::BrokenSpring, 3));
        assert_eq!(time(&events, EventKind::LockUp, 3), None);
        assert!((events.1[3] - 90_f64.to_radians()).abs() < 1.0);
    }

    #[test]
    fn what_cannot_be_late_is_refused() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/n-boom-1970.nml");
        let scene = nboom_io::read_scene(&path).expect("a deck").scene;
        let late = |hinge| Fault { late_release: vec![LateRelease { hinge, by: 1.0 }], ..none() };
        assert_eq!(late(0).apply(&mut (*scene).clone()), Ok(()));
        let refused = late(1).apply(&mut (*scene).clone());
        assert_eq!(refused, Err(FaultError::ReleaseByAngle));
    }
}
