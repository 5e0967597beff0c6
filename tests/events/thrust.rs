//! The thrust pulse: on while t_on <= t < t_off.

use nboom::model::{External, Scene, SceneDescription};
use nboom::scalar::Vec3;
use nboom::sim::EventKind::{self, ThrustOff, ThrustOn};

use crate::collect::{Collected, run, tight};
use crate::rotors::ball;

const FORCE: f64 = 3.0;
/// Mass of the balls of `rotors`.
const MASS: f64 = 2.0;
const START: f64 = 1.0;
const END: f64 = 5.0;

/// Expected events with their times.
type Switches = &'static [(EventKind, f64)];

fn pushed(force: f64, on: f64, off: f64) -> Collected {
    let mut description = SceneDescription::at_rest("pushed", ball(1.0), END);
    description.initial.time = START;
    let force = Vec3::new(force, 0.0, 0.0);
    description.externals = vec![External::thrust(force, Vec3::zero(), [on, off])];
    run(&Scene::new(description).expect("a ball is a body"), &tight(8)).0
}

/// The velocity and path after pushing over [on, off] within the run.
fn expected(time: f64, on: f64, off: f64) -> (f64, f64) {
    let pushed = (time.min(off) - on.max(START)).max(0.0);
    let coasted = (time - off.max(START)).max(0.0);
    let speed = FORCE / MASS * pushed;
    (speed, 0.5 * speed * pushed + speed * coasted)
}

#[test]
fn it_changes_the_motion_between_its_times_and_has_events_there() {
    let cases: [(f64, f64, Switches); 7] = [
        (1.7, 2.9, &[(ThrustOn, 1.7), (ThrustOff, 2.9)]),
        (2.0, 3.0, &[(ThrustOn, 2.0), (ThrustOff, 3.0)]),
        (0.0, 2.5, &[(ThrustOff, 2.5)]),
        (START, 2.5, &[(ThrustOff, 2.5)]),
        (0.0, START, &[]),
        (4.0, 9.0, &[(ThrustOn, 4.0)]),
        (6.0, 9.0, &[]),
    ];
    for (on, off, events) in cases {
        let found = pushed(FORCE, on, off);
        let times: Vec<_> = found.happenings().iter().map(|h| (h.0, h.2)).collect();
        assert_eq!(times, events, "{on} to {off}");
        assert!(found.happenings().iter().all(|h| h.1.is_none()));
        for sample in &found.samples {
            let (speed, path) = expected(sample.time, on, off);
            // A polynomial of second degree, which the method integrates but for rounding.
            let errors = [sample.velocity_inertial.x - speed, sample.position_inertial.x - path];
            assert!(errors.iter().all(|e| e.abs() < 1e-13), "{on} to {off}: {errors:?}");
        }
    }
}

#[test]
fn without_magnitude_there_are_no_events() {
    let found = pushed(0.0, 1.7, 2.9);
    assert_eq!(found.happenings(), []);
    assert_eq!(found.last().velocity_inertial, Vec3::zero());
}
