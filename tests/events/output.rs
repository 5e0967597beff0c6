//! What is told, and when: output times, rows at events, the order within an instant, and that
//! output does not touch the motion.

use nboom::model::{External, HingeState, Release};
use nboom::scalar::Vec3;
use nboom::sim::{EventKind, Options, Snapshot};

use crate::collect::{Collected, run, tight};
use crate::rotors::{description, free, locking_at, oscillating, scene, waiting};

#[test]
fn output_times_are_uniform_and_include_both_ends() {
    for samples in [1, 3, 200] {
        let (found, _) = run(&scene(&[free(0.0, 1.0)], 0.7), &tight(samples));
        assert_eq!(found.samples.len(), samples + 1);
        for (i, sample) in found.samples.iter().enumerate() {
            let time = 0.7 * i as f64 / samples as f64;
            assert!((sample.time - time).abs() < 2e-16, "{} {time}", sample.time);
        }
        assert_eq!(found.last().time, 0.7);
    }
}

#[test]
fn a_row_at_an_event_holds_the_state_after_it() {
    // A release at the output time 0.5, and a lock-up at 0.25.
    let hinges = [waiting(Release::Time(0.5)), locking_at(free(0.0, 2.0), 0.5)];
    let (found, _) = run(&scene(&hinges, 1.0), &tight(4));
    let states: Vec<_> = found.samples.iter().map(|s| (s.hinges[0], s.hinges[1])).collect();
    use HingeState::{Free, Locked, Unreleased};
    assert_eq!(
        states,
        [(Unreleased, Free), (Unreleased, Locked), (Free, Locked), (Free, Locked), (Free, Locked)]
    );
    let row = &found.samples[1];
    assert_eq!((row.time, row.beta[1], row.tau[1]), (0.25, 0.5, 0.0));
    assert!(row.omega_body.x > 0.0, "the hub has taken up the momentum");
}

#[test]
fn an_event_at_the_end_time_is_still_an_event() {
    let timed = waiting(Release::Time(1.0));
    let crossing = locking_at(free(0.0, 1.0), 1.0);
    for (hinge, kind, state) in [
        (timed, EventKind::Release, HingeState::Free),
        (crossing, EventKind::LockUp, HingeState::Locked),
    ] {
        let (found, summary) = run(&scene(&[hinge], 1.0), &tight(2));
        let kinds: Vec<_> = found.events.iter().map(|(event, _)| event.kind).collect();
        assert_eq!(kinds, [kind, EventKind::End]);
        assert_eq!(summary.events, 2);
        assert_eq!(found.last().hinges, [state]);
        assert_eq!(found.samples.len(), 3);
    }
}

#[test]
fn the_end_is_the_last_event_and_changes_nothing() {
    let (found, summary) = run(&scene(&[free(0.0, 1.0)], 1.0), &tight(1));
    let [(end, after)] = &found.events[..] else { panic!("only the end") };
    assert_eq!((end.kind, end.time, end.hinge), (EventKind::End, 1.0, None));
    assert_eq!((end.impulse, end.before), (None, end.after));
    assert_eq!(after.beta, found.last().beta);
    assert_eq!((summary.end_time, summary.events), (1.0, 1));
}

#[test]
fn events_of_an_instant_come_as_lock_ups_releases_others() {
    let hinges = [
        waiting(Release::Time(0.5)),
        locking_at(free(0.0, 1.0), 0.5),
        waiting(Release::Angle { hinge: 1, angle: 0.5 }),
        locking_at(free(0.0, -1.0), -0.5),
    ];
    let mut description = description(&hinges, 1.0);
    let (force, point) = (Vec3::new(0.0, 0.0, 1.0), Vec3::zero());
    description.externals = vec![External::thrust(force, point, [0.5, 0.75])];
    let scene = nboom::model::Scene::new(description).expect("rotors are bodies");
    let (found, _) = run(&scene, &tight(1));
    let kinds: Vec<_> = found.happenings().iter().map(|h| (h.0, h.1)).collect();
    assert_eq!(
        kinds,
        [
            (EventKind::LockUp, Some(1)),
            (EventKind::LockUp, Some(3)),
            (EventKind::Release, Some(0)),
            (EventKind::Release, Some(2)),
            (EventKind::ThrustOn, None),
            (EventKind::ThrustOff, None),
        ]
    );
    let times: Vec<f64> = found.happenings().iter().map(|h| h.2).collect();
    assert!(times[..5].iter().all(|&time| time == times[0]), "{times:?}");
}

/// A motion with steps of many sizes and three events.
fn lively(samples: usize) -> (Collected, nboom::sim::Summary) {
    let hinges = [
        locking_at(oscillating(free(0.0, 1.0), 7.0, 0.3), 0.55),
        oscillating(waiting(Release::Angle { hinge: 0, angle: 0.4 }), 11.0, -0.2),
        locking_at(free(0.0, 0.5), 0.8),
    ];
    let options = Options { samples, rtol: 1e-8, atol: 1e-10, ..Options::default() };
    run(&scene(&hinges, 3.0), &options)
}

/// A snapshot without its account, whose residuals are relative to the largest energy at any output time so far.
fn motion(snapshot: &Snapshot) -> Snapshot {
    Snapshot { account: None, ..snapshot.clone() }
}

#[test]
fn output_does_not_touch_the_motion() {
    let (one, one_summary) = lively(1);
    assert!(one.happenings().len() >= 3, "{:?}", one.happenings());
    for samples in [2, 7, 1000] {
        let (many, summary) = lively(samples);
        assert_eq!(many.happenings(), one.happenings(), "bit for bit");
        assert_eq!(summary.steps_accepted, one_summary.steps_accepted);
        for ((a, after_a), (b, after_b)) in one.events.iter().zip(&many.events) {
            assert_eq!(a, b);
            assert_eq!(motion(after_a), motion(after_b));
        }
        assert_eq!(motion(many.last()), motion(one.last()));
    }
}
