//! The example of four equal wings: they deploy as one, and what they end with is known beforehand.

use nboom::io::read_scene;
use nboom::model::HingeState;
use nboom::sim::EventKind::{LockUp, Release};

use crate::collect::{run, tight};

#[test]
fn four_equal_wings_deploy_and_lock_as_one() {
    let file = read_scene("examples/four-wings.nml".as_ref()).expect("an example");
    assert!(file.warnings.is_empty() && file.scene.warnings().is_empty(), "{:?}", file.warnings);
    let (found, _) = run(&file.scene, &tight(100));

    // Four inner and four outer hinges at a time, in this order.
    let (inner, outer) = ([0, 2, 4, 6], [1, 3, 5, 7]);
    let events = found.happenings();
    assert_eq!(events.len(), 16);
    let expected = [(Release, inner), (Release, outer), (LockUp, outer), (LockUp, inner)];
    for (of_instant, (kind, hinges)) in events.chunks(4).zip(expected) {
        for (event, hinge) in of_instant.iter().zip(hinges) {
            assert_eq!(*event, (kind, Some(hinge), of_instant[0].2));
        }
    }
    assert_eq!(events[0].2, 1.0);
    assert!(found.last().hinges.iter().all(|state| *state == HingeState::Locked));
    let impulses: Vec<f64> = found.events.iter().filter_map(|(event, _)| event.impulse).collect();
    for of_instant in impulses.chunks(4) {
        // Rounding of an impulse of order 1 by the joint solution of four.
        assert!(of_instant.iter().all(|impulse| (impulse - of_instant[0]).abs() < 1e-12));
    }

    for sample in &found.samples {
        for hinges in [inner, outer] {
            let angles = hinges.map(|i| sample.beta[i]);
            // Wings differ by rounding, which a few thousand evaluations do not let grow far.
            assert!(angles.iter().all(|angle| (angle - angles[0]).abs() < 1e-12), "{angles:?}");
        }
        let across = [sample.omega_body.y, sample.omega_body.z];
        assert!(across.iter().all(|rate| rate.abs() < 1e-13), "{across:?}");
    }

    // About x, from the deck: panels of 4 kg whose mass centres are 0.5 m off the axis when they are
    // stowed along it, and 1 and 2 m when they stand out.
    let stowed = 20.0 + 8.0 * (0.214 + 4.0 * 0.5 * 0.5);
    let deployed = 20.0 + 4.0 * (2.0 * 0.547 + 4.0 * (1.0 + 4.0));
    let rate = 6.0_f64.to_radians() * stowed / deployed;
    // The tolerance of the run is 1e-12.
    assert!((found.last().omega_body.x - rate).abs() < 1e-11);
}
