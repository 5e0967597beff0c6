//! A deck and the JSON of a scene are the same physics.
//!
//! The decks were written from the same numbers in degrees with 17 digits, so that both scenes
//! agree to the rounding of a conversion between degrees and radians.

use nboom::model::{Body, Course, Release, Scene};
use nboom::scalar::{Mat3, Vec3};

use crate::catalog::Reference;

/// A few roundings of a conversion, relative to the largest number of a body.
const LIMIT: f64 = 1e-14;

fn flat(rot: &Mat3<f64>) -> Vec<f64> {
    rot.rows.into_iter().flat_map(Vec3::to_array).collect()
}

/// Groups of numbers that have a common scale.
fn numbers_of(body: &Body, initial_time: f64) -> Vec<Vec<f64>> {
    let (mass, hinge) = (&body.mass_properties, &body.hinge);
    let inertia = mass.inertia.to_matrix();
    let (spring, dashpot) = (hinge.spring, hinge.dashpot);
    let release = match hinge.release {
        // Whatever is not after the initial time is the initial time.
        Release::Time(at) => vec![at.max(initial_time)],
        Release::Angle { hinge, angle } => vec![hinge as f64, angle],
        Release::AfterLock { hinge, delay } => vec![hinge as f64, delay],
        Release::Never => Vec::new(),
    };
    let mut groups = vec![
        body.mount.point.to_array().to_vec(),
        flat(&body.mount.rot_inboard_from_hinge),
        body.axis.to_array().to_vec(),
        vec![mass.mass],
        mass.center_of_mass.to_array().to_vec(),
        flat(&inertia),
        vec![spring.quadratic, spring.linear, spring.preload_angle],
        vec![dashpot.rate_quadratic, dashpot.rate_linear],
        vec![dashpot.angle_quadratic, dashpot.angle_linear, dashpot.preload_angle],
        release,
        hinge.lock_angle.into_iter().collect(),
        vec![hinge.start.angle, hinge.start.rate],
    ];
    if let Some(kick_off) = hinge.kick_off {
        groups.push(kick_off.main_body_point.to_array().to_vec());
        groups.push(kick_off.body_point.to_array().to_vec());
        groups.push(kick_off.coefficients.to_vec());
        groups.push(vec![kick_off.limit_length]);
    }
    groups
}

fn environment(scene: &Scene) -> Vec<Vec<f64>> {
    let initial = &scene.initial;
    let mut groups = vec![
        vec![initial.time, scene.end_time],
        flat(&initial.attitude.normalized().to_matrix()),
        initial.position_inertial.to_array().to_vec(),
        initial.velocity_inertial.to_array().to_vec(),
        initial.omega_body.to_array().to_vec(),
        vec![scene.main_body.mass],
        scene.main_body.center_of_mass.to_array().to_vec(),
        flat(&scene.main_body.inertia.to_matrix()),
    ];
    if let Some(gravity) = scene.gravity {
        groups.push((gravity.up * gravity.acceleration).to_array().to_vec());
    }
    for thrust in &scene.externals {
        groups.push(thrust.amount.to_array().to_vec());
        groups.push(thrust.point.to_array().to_vec());
        let Course::Pulse { on, off } = thrust.course else { panic!("a deck has pulses") };
        groups.push(vec![on, off]);
    }
    groups
}

fn assert_same(name: &str, deck: &[Vec<f64>], json: &[Vec<f64>]) {
    assert_eq!(deck.len(), json.len(), "{name}");
    for (d, j) in deck.iter().zip(json) {
        assert_eq!(d.len(), j.len(), "{name}: {d:?}, {j:?}");
        let scale = j.iter().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
        for (a, b) in d.iter().zip(j) {
            let same = a == b || (a - b).abs() <= LIMIT * scale;
            assert!(same, "{name}: {d:?}, {j:?}");
        }
    }
}

#[test]
fn a_deck_is_the_scene_of_its_json() {
    for reference in Reference::all() {
        let (deck, json) = (reference.deck(), reference.scene());
        assert_same(reference.name, &environment(&deck), &environment(&json));
        let start = json.initial.time;
        assert_eq!(deck.bodies.len(), json.bodies.len());
        for (d, j) in deck.bodies.iter().zip(&json.bodies) {
            assert_eq!(d.inboard, j.inboard, "{}", reference.name);
            assert_eq!(d.hinge.start.state, j.hinge.start.state, "{}", reference.name);
            assert_same(reference.name, &numbers_of(d, start), &numbers_of(j, start));
        }
    }
}
