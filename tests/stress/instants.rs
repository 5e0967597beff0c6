//! Loads that jump at events, between output times that see nothing of it.

use std::f64::consts::TAU;

use nboom::model::{
    Dashpot, External, Hinge, HingeStart, HingeState, KickOffSpring, Release, Scene,
    SceneDescription, Spring,
};
use nboom::scalar::Vec3;
use nboom::strength::{Cause, Settings, Worst};

use crate::follow::{Follow, HUB_MASS, LENGTH, MASS, RADIUS, STATIONS, THICKNESS, boom, held};

fn with_thrust(scene: &Scene, thrust: External) -> Scene {
    let externals = vec![thrust];
    let description = SceneDescription { externals, ..SceneDescription::clone(scene) };
    Scene::new(description).expect("a thrust may be added")
}

/// The worst of each station by a run with outputs at its start and its end.
fn worst(scene: &Scene) -> Vec<Worst> {
    let follow = Follow::run_with(scene, Settings::default(), 1);
    assert_eq!(follow.samples.len(), 2);
    follow.analysis.envelope().to_vec()
}

/// The largest von Mises stress of each station at so many output times.
fn sampled(scene: &Scene, samples: usize) -> Vec<f64> {
    let follow = Follow::run_with(scene, Settings::default(), samples);
    let stations = 0..STATIONS.len();
    let von_mises =
        |i: usize| follow.at_samples.iter().map(move |all| all[i].max_von_mises.stress.von_mises());
    stations.map(|i| von_mises(i).fold(0.0, f64::max)).collect()
}

/// The envelope has what output times approach as they become many.
fn is_approached(scene: &Scene, event: f64) {
    const SAMPLES: usize = 4000;
    let (found, few, many) = (worst(scene), sampled(scene, 1), sampled(scene, SAMPLES));
    for (station, worst) in found.iter().enumerate() {
        let limit = worst.max_von_mises.stress.von_mises();
        assert!(few[station] < 0.9 * limit, "outputs alone see it: {few:?} {found:?}");
        // Stresses change by less than ten times themselves in a unit of time.
        let change = 10.0 / SAMPLES as f64;
        assert!(many[station] <= limit, "{many:?} {found:?}");
        assert!(many[station] > limit * (1.0 - change), "{many:?} {found:?}");
        assert_eq!(worst.cause, Cause::Motion);
        assert!((worst.time - event).abs() < 1e-9, "{worst:?}");
    }
}

#[test]
fn a_thrust_between_output_times_loads_what_it_accelerates() {
    let force = 40.0;
    let thrust = External::thrust(Vec3::unit_y() * force, Vec3::zero(), [0.3, 0.6]);
    let area = TAU * RADIUS * THICKNESS;
    for (worst, s) in worst(&with_thrust(&held(Vec3::zero()), thrust)).iter().zip(STATIONS) {
        let outboard = MASS * (LENGTH - s) / LENGTH;
        let pressure = outboard * force / (HUB_MASS + MASS) / area;
        // The line of the force has both mass centres: nothing turns. A few roundings.
        let found = worst.max_von_mises.stress;
        assert!((found.normal + pressure).abs() < 1e-12 * pressure, "{s}: {found:?} {pressure}");
        assert_eq!(worst.cause, Cause::Motion);
        assert!((0.3..=0.6).contains(&worst.time), "{worst:?}");
    }
}

/// A spring against a dashpot pulls most before anything moves.
#[test]
fn the_load_after_a_release() {
    let start = HingeStart { angle: -0.8, rate: 0.0, state: HingeState::Unreleased };
    let hinge = Hinge {
        spring: Spring { linear: -30.0, ..Spring::default() },
        dashpot: Dashpot { rate_linear: -15.0, ..Dashpot::default() },
        release: Release::Time(0.4),
        start,
        ..Hinge::free()
    };
    is_approached(&boom(hinge, Vec3::zero(), 1.6), 0.4);
}

/// A kick-off spring that pushes the more the longer it is.
#[test]
fn the_load_before_a_kick_off_spring_lets_go() {
    let start = HingeStart { angle: -0.8, rate: 0.0, state: HingeState::Free };
    let kick_off = KickOffSpring {
        main_body_point: Vec3::new(0.0, 0.3, -0.6),
        body_point: Vec3::new(0.0, 0.5, 0.0),
        coefficients: [0.0, 0.0, 0.0, 1500.0],
        limit_length: 0.4,
    };
    let hinge = Hinge { kick_off: Some(kick_off), start, ..Hinge::free() };
    let scene = boom(hinge, Vec3::zero(), 1.0);
    let follow = Follow::run_with(&scene, Settings::default(), 1);
    let [event] = follow.instants[..] else { panic!("one event: {:?}", follow.instants) };
    is_approached(&scene, event);
}
