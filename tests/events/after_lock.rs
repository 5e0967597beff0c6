//! Releases that follow the lock-up of another hinge, against closed forms.

use nboom::model::{
    Hinge, HingeLabel, HingeStart, HingeState, ModelWarning, Release, Scene, SceneDescription,
};
use nboom::sim::EventKind::{LockUp, Release as Released};
use nboom::sim::{Digits, Nobody, Reference, Simulator, Witness, simulate, trust};

use crate::collect::{Collected, run, tight};
use crate::rotors::{
    BOOM, HUB, ROUNDING, description, free, locking_at, oscillating, scene, waiting,
};

/// A hinge that waits at angle zero for another to lock.
fn after(hinge: usize, delay: f64) -> Hinge {
    waiting(Release::AfterLock { hinge, delay })
}

fn label(appendage: usize) -> HingeLabel {
    HingeLabel::new(appendage, 0)
}

/// Hinge 1 turns freely and locks at 0.7; hinges 2 and 3 follow, each on a spring that takes it to its
/// own lock angle.
fn three_in_turn() -> [Hinge; 3] {
    let on_a_spring = |hinge: Hinge| locking_at(oscillating(hinge, 3.0, 1.0), 0.9);
    [locking_at(free(0.0, 1.0), 0.7), on_a_spring(after(0, 0.37)), on_a_spring(after(1, 0.21))]
}

#[test]
fn each_so_long_after_the_one_before() {
    let (found, _) = run(&scene(&three_in_turn(), 4.0), &tight(1));
    let [
        (LockUp, Some(0), first),
        (Released, Some(1), second_free),
        (LockUp, Some(1), second),
        (Released, Some(2), third_free),
        (LockUp, Some(2), _),
    ] = found.happenings()[..]
    else {
        panic!("three lock-ups and two releases: {:?}", found.happenings())
    };
    assert!((first - 0.7).abs() < ROUNDING, "{first}");
    assert_eq!(second_free, first + 0.37);
    assert_eq!(third_free, second + 0.21);
}

/// Nothing tells a delay that is shorter than an instant from none.
#[test]
fn in_the_instant_of_the_lock_up_without_a_delay() {
    let trigger = locking_at(free(0.0, 1.0), 0.7);
    for delay in [0.0, 1e-13] {
        for (hinges, trigger, waits) in
            [([trigger, after(0, delay)], 0, 1), ([after(1, delay), trigger], 1, 0)]
        {
            let (found, _) = run(&scene(&hinges, 2.0), &tight(1));
            let lock = found.happenings()[0].2;
            let expected = [(LockUp, Some(trigger), lock), (Released, Some(waits), lock)];
            assert_eq!(found.happenings(), expected);
            // The lock-up is solved with the waiting boom still held, which takes its share.
            let rate = BOOM / (HUB + 2.0 * BOOM);
            assert!((found.last().omega_body.x - rate).abs() < ROUNDING);
            assert!(found.last().tau[waits].abs() < ROUNDING);
        }
    }
}

#[test]
fn a_hinge_that_starts_locked_counts_from_the_initial_time() {
    let locked = HingeStart { angle: 0.3, rate: 0.0, state: HingeState::Locked };
    let trigger = Hinge { start: locked, ..Hinge::free() };
    for delay in [0.0, 0.4] {
        let mut description = description(&[trigger, after(0, delay)], 4.0);
        description.initial.time = 2.0;
        let scene = Scene::new(description).expect("rotors are bodies");
        assert_eq!(scene.warnings(), []);
        let (found, _) = run(&scene, &tight(4));
        assert_eq!(found.happenings(), [(Released, Some(1), 2.0 + delay)]);
    }
}

#[test]
fn never_if_the_other_never_locks() {
    let trigger = free(0.0, 1.0);
    let held = waiting(Release::Never);
    let (hinge, of_trigger) = (|| label(1), || label(0));
    let never_locks = ModelWarning::TriggerNeverLocks { hinge: hinge(), trigger: of_trigger() };
    let never_turns = ModelWarning::TriggerNeverTurns { hinge: hinge(), trigger: of_trigger() };
    let circle = ModelWarning::ReleaseCircle(vec![of_trigger(), hinge()]);
    for (trigger, warnings) in [
        (trigger, vec![never_locks]),
        // Behind the trigger, which goes on and on: nobody is warned of what a motion brings.
        (locking_at(trigger, -0.5), vec![]),
        (locking_at(held, 0.5), vec![never_turns]),
        (locking_at(after(1, 0.1), 0.5), vec![circle]),
    ] {
        let scene = scene(&[trigger, after(0, 0.1)], 1.0);
        assert_eq!(scene.warnings(), warnings);
        assert_eq!(run(&scene, &tight(1)).0.happenings(), []);
    }
}

#[test]
fn every_run_of_a_simulator_waits_anew() {
    let scene = scene(&three_in_turn(), 4.0);
    let mut simulator = Simulator::new(&scene, tight(3));
    let mut told = || {
        let mut found = Collected::default();
        simulator.run(&mut found).expect("it runs to its end");
        (found.events, found.samples)
    };
    let first = told();
    assert_eq!(first.0.len(), 6);
    assert_eq!(told(), first);
    // Ended between a lock-up and the release that follows, it has no part in the next run.
    let short = scene.ending_at(0.9).expect("an end after the start");
    simulator.set_scene(&short);
    assert_eq!(simulator.run(&mut Nobody).expect("it runs to its end").events, 2);
    let early = SceneDescription { end_time: 0.6, ..SceneDescription::clone(&scene) };
    simulator.set_scene(&Scene::new(early).expect("a scene"));
    assert_eq!(simulator.run(&mut Nobody).expect("it runs to its end").events, 1);
}

#[test]
fn a_run_in_double_double_has_the_same_releases() {
    let (scene, options) = (scene(&three_in_turn(), 4.0), tight(1));
    let mut witness = Witness::new();
    simulate(&scene, &options, &mut witness).expect("it runs to its end");
    let found = trust(&scene, &options, &witness, Reference::DoubleDouble, &mut Nobody)
        .expect("it runs again");
    assert!(found.same_events, "{found:?}");
    let digits = found.events.iter().map(|event| &event.time).chain(&found.end);
    let fewest = digits.map(Digits::count).min();
    // The tolerance is 1e-12, over a dozen radians of a smooth motion.
    assert!(fewest >= Some(10), "{found:?}");
}
