//! Modes of a run for which there is no routine, in a routine for more hinges.

use nboom::model::{Scene, SceneDescription};
use nboom::sim::{Event, Form, Options, Path, Snapshot};

use crate::collect::{run, tight};
use crate::support::relative_error;

/// What two runs at a relative tolerance of 1e-12 may differ by, in times and in states.
const APART: f64 = 1e-9;

/// Four booms of five segments that swing out of 20 degrees each and lock one hinge after the
/// other, each at an angle of its own.
fn staggered() -> Scene {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/scenes/T2.nml");
    let file = nboom::io::read_scene(&path).expect("the scene is in the clone");
    let mut scene = SceneDescription::clone(&file.scene);
    for (i, body) in scene.bodies.iter_mut().enumerate() {
        body.hinge.lock_angle = Some(body.hinge.start.angle * (0.9 - 0.02 * i as f64));
    }
    Scene::new(scene).expect("a physical scene")
}

fn motion(snapshot: &Snapshot) -> Vec<f64> {
    let (omega, velocity) = (snapshot.omega_body, snapshot.velocity_inertial);
    let mut all = [omega.to_array(), velocity.to_array()].concat();
    all.extend(snapshot.beta.iter().chain(&snapshot.tau));
    all
}

#[test]
fn a_deployment_with_staggered_lock_ups_is_that_of_the_recursion() {
    let scene = staggered();
    let samples = 40;
    let recursive =
        Options { path: Path::Generic, formulation: Some(Form::Recursive), ..tight(samples) };
    let (expected, _) = run(&scene, &recursive);
    let (found, summary) = run(
        &scene,
        &Options {
            kernels: nboom_routines::for_runs(),
            batches: nboom_routines::right_sides_of_eight(),
            ..tight(samples)
        },
    );

    assert_eq!(found.happenings().len(), scene.bodies.len());
    for (found, expected) in found.happenings().iter().zip(expected.happenings()) {
        assert_eq!((found.0, found.1), (expected.0, expected.1));
        assert!((found.2 - expected.2).abs() < APART * scene.end_time, "{found:?} {expected:?}");
    }
    let motions = |all: &[(Event, Snapshot)]| -> Vec<Vec<f64>> {
        all.iter().map(|(_, after)| motion(after)).collect()
    };
    let after_events = motions(&found.events).into_iter().zip(motions(&expected.events));
    let at_samples = found.samples.iter().map(motion).zip(expected.samples.iter().map(motion));
    let mut worst = 0.0_f64;
    for (found, expected) in after_events.chain(at_samples) {
        worst = worst.max(relative_error(&found, &expected, 1.0));
    }
    println!("largest difference {worst:.1e}");
    assert!(worst < APART, "{worst:e}");

    // A mode for each number of free hinges, every one in a routine.
    assert_eq!(summary.selections.len(), scene.bodies.len() + 1);
    assert!(summary.selections.iter().all(|selection| selection.path == "generated"));
    for (mode, why) in [
        (0, "routine for 4xS5, "),
        (1, "routine for 4xS5, 1 of 20 links virtual, "),
        (8, "routine for 4xS4, 4 of 16 links virtual, "),
        (9, "routine for 4xS3, 1 of 12 links virtual, "),
        (16, "routine for 2xS2, "),
    ] {
        let reason = &summary.selections[mode].reason;
        assert!(reason.starts_with(why), "{reason}");
        assert_eq!(reason.contains("virtual"), why.contains("virtual"), "{reason}");
    }
}
