//! The sample deck run with correct physics, and its motion at any time.

use std::path::Path;

use nboom::model::{HingeStart, HingeState, InitialMotion, Release, Scene, SceneDescription};
use nboom::sim::Snapshot;

use crate::collect::{run, tight};

/// The deck of Section 17, ending after its last event.
pub fn scene() -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/n-boom-1970.nml");
    let file = nboom::io::read_scene(&path).expect("the sample deck is valid");
    file.scene.ending_at(0.5).expect("it starts at zero")
}

/// The true motion at `time`, seen with the hinges in the states `hinges`.
pub fn motion_at(time: f64, hinges: &[HingeState]) -> Snapshot {
    run(&scene_at(time, hinges), &tight(1)).0.samples[0].clone()
}

/// A scene that starts with the true motion at `time` and the hinges in the states `hinges`.
///
/// The 1970 run released its hinges 4e-5 to 1.5e-4 s early (see `events.rs`). Its blocks are
/// therefore compared with the true motion at the printed time, in which those hinges have
/// become free that the block shows as free.
pub fn scene_at(time: f64, hinges: &[HingeState]) -> Scene {
    let scene = scene();
    let until = scene.ending_at(time).expect("no block is before the start");
    let at = run(&until, &tight(1)).0.last().clone();
    let mut bodies = scene.bodies.clone();
    for (i, body) in bodies.iter_mut().enumerate() {
        let (angle, rate) = (at.beta[i], at.tau[i]);
        body.hinge.start = HingeStart { angle, rate, state: hinges[i] };
        body.hinge.release = Release::Never;
    }
    let initial = InitialMotion {
        time,
        attitude: at.attitude,
        position_inertial: at.position_inertial,
        velocity_inertial: at.velocity_inertial,
        omega_body: at.omega_body,
    };
    let end_time = time + 1e-6;
    let seen = SceneDescription { bodies, initial, end_time, ..(*scene).clone() };
    Scene::new(seen).expect("the bodies are those of the deck")
}
