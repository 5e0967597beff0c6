//! Steps as recorders see them.

use std::io;

use nboom::model::{External, Rotor, RotorSpeed, Scene};
use nboom::scalar::Vec3;
use nboom::sim::EventKind::LockUp;
use nboom::sim::{Method, Options, Recorder, Snapshot, StepMotion, Summary, simulate};

use crate::collect::run;
use crate::rotors::{description, free, locking_at, oscillating, scene};

/// When steps start that do not go on from the one before, and how many do.
#[derive(Default)]
struct Starts {
    anew: Vec<f64>,
    others: usize,
    end: f64,
}

impl Recorder for Starts {
    fn sample(&mut self, _: &Snapshot) -> io::Result<()> {
        Ok(())
    }

    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        let [start, end] = step.span();
        assert_eq!(start, self.end, "steps leave nothing out");
        self.end = end;
        if step.goes_on() {
            self.others += 1;
        } else {
            self.anew.push(start);
        }
        Ok(())
    }
}

/// A push begins and ends with events; where a rotor's speed bends accelerations jump, and there is no event.
#[test]
fn a_step_says_whether_accelerations_jump_where_it_starts() {
    let mut scene = description(&[oscillating(free(0.5, 0.0), 4.0, 0.0)], 9.0);
    let speed = RotorSpeed::Table(vec![[1.0, 3.0], [3.0, 40.0], [6.0, 10.0]]);
    scene.rotors = vec![Rotor { body: None, axis: Vec3::unit_x(), inertia: 0.2, speed }];
    scene.externals = vec![External::thrust(Vec3::unit_x(), Vec3::zero(), [2.0, 4.5])];
    let scene = Scene::new(scene).expect("rotors are bodies");
    let mut starts = Starts::default();
    simulate(&scene, &Options::default(), &mut starts).expect("it runs");
    assert_eq!(starts.anew, [0.0, 1.0, 2.0, 3.0, 4.5, 6.0]);
    assert!(starts.others > 20 && starts.end == 9.0);
}

/// A step of `dop853` takes twelve evaluations, and three for its inside, so nothing is left in which one would be
/// taken twice.
#[test]
fn a_step_goes_just_beyond_the_event_that_ends_it() {
    let swing = oscillating(free(0.0, 1.0), 1.0, 0.0);
    // Not in the first steps, each of which is several times as long as the one before.
    for angle in [0.5_f64, 0.8, 0.95] {
        let scene = scene(&[locking_at(swing, angle)], angle.asin() + 0.01);
        let options = Options { samples: 1, integrator: Method::Dop853, ..Options::default() };
        let (found, summary) = run(&scene, &options);
        let [(LockUp, Some(0), time)] = found.happenings()[..] else { panic!("one lock-up") };
        assert!((time - angle.asin()).abs() < 1e-8, "{angle}: {time}");
        let Summary { steps_accepted, steps_rejected, evaluations, .. } = summary;
        assert!(steps_accepted > 2, "{angle}");
        // The start takes two, and the restart one.
        let at_most = 12 * (steps_accepted + steps_rejected) + 3 * steps_accepted + 3;
        assert!(evaluations <= at_most, "{angle}: {evaluations}, {at_most}");
    }
}

/// The second hinge locks in the first step after the first one has, which changes its rate at once.
#[test]
fn a_lock_up_right_after_another_is_expected_too() {
    let swing = oscillating(free(0.0, 1.0), 1.0, 0.0);
    for angle in [0.5, 0.52, 0.55] {
        let hinges = [locking_at(swing, 0.45), locking_at(swing, angle)];
        let options = Options { samples: 1, integrator: Method::Dop853, ..Options::default() };
        let (found, summary) = run(&scene(&hinges, 0.7), &options);
        let [(LockUp, Some(0), _), (LockUp, Some(1), _)] = found.happenings()[..] else {
            panic!("two lock-ups: {:?}", found.happenings())
        };
        let Summary { steps_accepted, steps_rejected, evaluations, .. } = summary;
        // As above, with one restart more.
        let at_most = 12 * (steps_accepted + steps_rejected) + 3 * steps_accepted + 4;
        assert!(evaluations <= at_most, "{angle}: {evaluations}, {at_most}");
    }
}
