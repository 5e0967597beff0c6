//! The events of the sample run against the printout and, where that is off, the reference.

use nboom::model::HingeState::{Free, Unreleased};
use nboom::sim::{EventKind, Snapshot};

use crate::collect::{Collected, DISENGAGES, run, tight};
use crate::sample_run::scene;
use crate::support::{data, number};

fn events() -> Collected {
    run(&scene(), &tight(1)).0
}

fn releases() -> Vec<(usize, f64, Snapshot)> {
    let found = events().events.into_iter();
    let releases = found.filter(|(event, _)| event.kind == EventKind::Release);
    releases
        .map(|(event, after)| (event.hinge.expect("a hinge is released"), event.time, after))
        .collect()
}

/// The true events, from 80-bit arithmetic: kinds, hinges and order exactly, times within the
/// limit of 1e-10 of the span for event times.
#[test]
fn events_are_the_true_ones() {
    let file = data("printed_output.json");
    let expected = file["events_true"].as_array().expect("a list");
    let found = events().happenings();
    assert_eq!(found.len(), 11);
    assert_eq!(found.len(), expected.len());
    for ((kind, hinge, time), expected) in found.iter().zip(expected) {
        let kind_there = match expected["kind"].as_str() {
            Some("release") => EventKind::Release,
            Some("lock") => EventKind::LockUp,
            Some("kick_off") => DISENGAGES,
            other => panic!("{other:?} does not occur in the sample run"),
        };
        assert_eq!((*kind, *hinge), (kind_there, Some(number(expected, "segment") as usize)));
        let time_there = number(expected, "t");
        assert!((time - time_there).abs() < 1e-10 * 0.5, "{time}, {time_there}");
    }
}

/// The four releases are printed with blocks of their own (blocks B to E, the last one just
/// before p. 18-28), in this order, with the angles that trigger them (p. 18-9 and following:
/// 89.51 and 89.5 degrees of segment 1, 181 degrees of segment 2).
#[test]
fn releases_happen_in_the_printed_order_at_the_printed_angles() {
    let found = releases();
    let order: Vec<usize> = found.iter().map(|(hinge, _, _)| *hinge).collect();
    assert_eq!(order, [0, 2, 1, 3]);
    // Triggering hinge and printed angle; units of the last printed digit.
    let printed = [(0, 90.0, 1e-3), (0, 89.510, 1e-3), (0, 89.500, 1e-3), (1, 181.00, 1e-2)];
    for ((_, time, after), (trigger, angle, unit)) in found.iter().zip(printed) {
        let found = after.beta[trigger].to_degrees();
        assert!((found - angle).abs() < unit, "{found} at {time}");
        // What the deck asks for is met far better: a rate below 4 rad/s in an instant of 1e-13.
        assert!((found - angle).abs() < 1e-10, "{found} at {time}");
    }
    let states = [
        [Free, Unreleased, Unreleased, Unreleased],
        [Free, Unreleased, Free, Unreleased],
        [Free, Free, Free, Unreleased],
        [Free; 4],
    ];
    for ((_, _, after), states) in found.iter().zip(states) {
        assert_eq!(after.hinges, states);
    }
}

/// The first release is at a given time and printed as .6999999E-02 in single precision. The
/// others wait for angles; there the 1970 run was early, because its kick-off springs pushed
/// segment 1 too hard (their moments lack the outboard segment's share) and because it
/// interpolated linearly over steps of a millisecond.
#[test]
fn printed_release_times_are_early_by_the_known_slips() {
    let found: Vec<f64> = releases().iter().map(|(_, time, _)| *time).collect();
    assert_eq!(found[0], 0.007);
    assert!((found[0] - 0.006_999_999).abs() < 1.001e-9);
    // Printed time, and the true one less it, from the reference to two digits.
    let printed = [(0.019_028_37, 3.7e-5), (0.019_146_58, 4.2e-5), (0.037_564_69, 1.5e-4)];
    for (time, (printed, early)) in found[1..].iter().zip(printed) {
        let difference = time - printed;
        assert!((difference - early).abs() < 0.05 * early, "{time}, printed {printed}");
    }
}
