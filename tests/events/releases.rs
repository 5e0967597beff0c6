//! When an unreleased hinge becomes free, against closed forms.

use std::f64::consts::PI;

use nboom::model::{Hinge, HingeLabel, HingeStart, HingeState, ModelWarning, Release, SAME_ANGLE};
use nboom::sim::EventKind::{LockUp, Release as Released};

use crate::collect::{run, tight};
use crate::rotors::{ROUNDING, description, free, locking_at, oscillating, scene, waiting};

#[test]
fn at_a_time_and_from_then_on_in_motion() {
    let (frequency, rest, at, end) = (3.0, 0.4, 0.37, 1.0);
    let hinge = oscillating(waiting(Release::Time(at)), frequency, rest);
    let (found, _) = run(&scene(&[hinge], end), &tight(10));
    assert_eq!(found.happenings(), [(Released, Some(0), at)]);
    for sample in &found.samples {
        let phase = frequency * (sample.time - at).max(0.0);
        let expected = rest * (1.0 - phase.cos());
        // The tolerance is 1e-12, over three radians of a smooth motion.
        assert!((sample.beta[0] - expected).abs() < 1e-11, "at {}", sample.time);
        let state = if sample.time < at { HingeState::Unreleased } else { HingeState::Free };
        assert_eq!(sample.hinges[0], state, "at {}", sample.time);
    }
}

#[test]
fn when_an_angle_is_passed_in_either_direction() {
    for direction in [1.0, -1.0] {
        let angle = 0.5 * direction;
        let waits = waiting(Release::Angle { hinge: 0, angle });
        let (found, _) = run(&scene(&[free(0.0, 2.0 * direction), waits], 1.0), &tight(1));
        let [(Released, Some(1), time)] = found.happenings()[..] else { panic!("one release") };
        assert!((time - 0.25).abs() < ROUNDING, "{time}");
    }
}

#[test]
fn only_once_when_the_angle_is_passed_again_and_again() {
    // Until its release hinge 2 is rigid with the hub, whose moment of inertia is then 5: β₁ is
    // sin(wt)/w with w below 5, and passes 0.1 six times in the run.
    let trigger = oscillating(free(0.0, 1.0), 5.0, 0.0);
    let waits = waiting(Release::Angle { hinge: 0, angle: 0.1 });
    let (found, _) = run(&scene(&[trigger, waits], 3.0), &tight(1));
    let [(Released, Some(1), time)] = found.happenings()[..] else { panic!("one release") };
    let frequency = 5.0 * (0.8 / (5.0 / 6.0_f64)).sqrt();
    // The tolerance is 1e-12 in the angle, at a rate near 1.
    assert!((time - (0.1 * frequency).asin() / frequency).abs() < 1e-11, "{time}");
}

#[test]
fn at_the_initial_time_when_the_angle_holds_there() {
    let angle = 0.3;
    let held = HingeStart { angle, rate: 0.0, state: HingeState::Locked };
    let trigger_free = free(angle, 1.0);
    let trigger_held = Hinge { start: held, ..Hinge::free() };
    for trigger in [trigger_free, trigger_held] {
        let waits = waiting(Release::Angle { hinge: 0, angle });
        let (found, _) = run(&scene(&[trigger, waits], 1.0), &tight(4));
        assert_eq!(found.happenings(), [(Released, Some(1), 0.0)]);
        assert_eq!(found.samples[0].hinges[1], HingeState::Free);
    }
}

#[test]
fn at_the_initial_time_when_the_release_time_is_over() {
    for release in [Release::Time(f64::NEG_INFINITY), Release::Time(1.0), Release::Time(2.0)] {
        let mut description = description(&[waiting(release)], 4.0);
        description.initial.time = 2.0;
        let scene = nboom::model::Scene::new(description).expect("rotors are bodies");
        let (found, _) = run(&scene, &tight(4));
        assert_eq!(found.happenings(), [(Released, Some(0), 2.0)]);
        assert_eq!(found.samples[0].hinges[0], HingeState::Free);
    }
}

#[test]
fn the_lock_angle_of_the_trigger_counts_as_reached() {
    let angle = 0.7;
    let trigger = locking_at(free(0.0, 1.0), angle);
    let waits = waiting(Release::Angle { hinge: 0, angle });
    // With the waiting hinge numbered before its trigger, and after it.
    let (found, _) = run(&scene(&[trigger, waits], 2.0), &tight(1));
    let [(LockUp, Some(0), lock), (Released, Some(1), release)] = found.happenings()[..] else {
        panic!("a lock-up, then a release: {:?}", found.happenings())
    };
    assert_eq!(lock, release);
    assert!((lock - angle).abs() < ROUNDING);

    let waits = waiting(Release::Angle { hinge: 1, angle });
    let (found, _) = run(&scene(&[waits, trigger], 2.0), &tight(1));
    let [(LockUp, Some(1), lock), (Released, Some(0), release)] = found.happenings()[..] else {
        panic!("a lock-up, then a release: {:?}", found.happenings())
    };
    assert_eq!(lock, release);
}

/// The angle that releases lies beyond the lock angle by less than two angles differ, and the trigger is so
/// slow that it would not come there within the instant.
#[test]
fn a_slow_trigger_that_locks_has_reached_its_angle() {
    let (angle, rate) = (0.7, 1e-7);
    let trigger = locking_at(free(angle - 5e-9, rate), angle);
    let waits = waiting(Release::Angle { hinge: 0, angle: angle + 0.9 * SAME_ANGLE });
    let (found, _) = run(&scene(&[trigger, waits], 1.0), &tight(1));
    let [(LockUp, Some(0), lock), (Released, Some(1), release)] = found.happenings()[..] else {
        panic!("a lock-up, then a release: {:?}", found.happenings())
    };
    assert_eq!(lock, release);
}

/// Its lock angle is where it starts from, not where it comes to: it does not lock as it leaves.
#[test]
fn a_hinge_released_on_its_lock_angle_leaves_it_in_either_direction() {
    let (frequency, at) = (3.0, 0.1);
    for rest in [0.5, -0.5] {
        let hinge = oscillating(locking_at(waiting(Release::Time(at)), 0.0), frequency, rest);
        let end = at + PI / frequency;
        let (found, _) = run(&scene(&[hinge], end), &tight(1));
        assert_eq!(found.happenings(), [(Released, Some(0), at)]);
        // Half a period later it is as far beyond the rest of its spring; the tolerance is 1e-12.
        let beta = found.samples.last().expect("a sample").beta[0];
        assert!((beta - 2.0 * rest).abs() < 1e-11, "{beta}");
    }
}

#[test]
fn a_chain_of_triggers_at_one_angle_is_one_release_after_the_other() {
    // Hinge 1 is released at 0.5 and driven; hinge 2 waits for it to pass 0.2.
    let driven = oscillating(waiting(Release::Time(0.5)), 2.0, 1.0);
    let waits = waiting(Release::Angle { hinge: 0, angle: 0.2 });
    let (found, _) = run(&scene(&[driven, waits], 2.0), &tight(1));
    let [(Released, Some(0), first), (Released, Some(1), second)] = found.happenings()[..] else {
        panic!("two releases")
    };
    assert_eq!(first, 0.5);
    // 1 - cos 2(t - 0.5) = 0.2, except that hinge 2 is rigid with the hub until then: the hub's
    // moment of inertia is 5 instead of 4, which changes the frequency.
    let frequency = 2.0 * (0.8 / (5.0 / 6.0_f64)).sqrt();
    let expected = 0.5 + 0.8_f64.acos() / frequency;
    assert!((second - expected).abs() < 1e-11, "{second}, {expected}");
}

#[test]
fn never_at_an_angle_that_the_trigger_locks_before() {
    let at = |angle| [locking_at(free(0.0, 1.0), 0.5), waiting(Release::Angle { hinge: 0, angle })];
    let (hinge, trigger) = (HingeLabel::new(1, 0), HingeLabel::new(0, 0));
    let warned =
        [ModelWarning::TriggerLocksBefore { hinge: hinge.clone(), trigger: trigger.clone() }];
    let (start, lock) = (0.0, 0.5);
    let other_way = [ModelWarning::TriggerOtherWay { hinge, trigger, angle: -0.1, start, lock }];
    for (angle, warnings, releases) in
        [(0.6, &warned[..], 0), (0.5, &[], 1), (0.4, &[], 1), (-0.1, &other_way, 0)]
    {
        let scene = scene(&at(angle), 1.0);
        assert_eq!(scene.warnings(), warnings, "{angle}");
        let found = run(&scene, &tight(1)).0.happenings();
        assert_eq!(found.iter().filter(|h| h.0 == Released).count(), releases, "{angle}");
    }
    let from_above = [locking_at(free(0.9, -1.0), 0.5), at(0.4)[1]];
    assert_eq!(scene(&from_above, 1.0).warnings(), warned);
}

#[test]
fn hinges_that_start_free_or_locked_or_stay_held_have_no_release() {
    let locked = HingeStart { angle: 0.1, rate: 0.0, state: HingeState::Locked };
    let hinges = [
        Hinge { release: Release::Time(0.5), ..free(0.0, 1.0) },
        Hinge { release: Release::Time(0.5), start: locked, ..Hinge::free() },
        waiting(Release::Never),
        waiting(Release::Angle { hinge: 2, angle: 0.5 }),
        waiting(Release::Time(1.5)),
    ];
    let (found, _) = run(&scene(&hinges, 1.0), &tight(3));
    assert_eq!(found.happenings(), []);
    let last = found.last();
    assert!((last.beta[0] - 1.0).abs() < 1e-12);
    assert_eq!(last.beta[1..], [0.1, 0.0, 0.0, 0.0]);
    assert_eq!(last.hinges[2..], [HingeState::Unreleased; 3]);
}
