//! The physical answer does not depend on how the scene is told: numbering, axes, origins,
//! zeros and directions of angles, units. In single evaluations and in whole runs with every
//! kind of event.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::model::{Course, HingeState, Release, Scene, SceneDescription};
use nboom::scalar::{Mat3, Vec3};
use nboom::sim::{EventKind, Snapshot};

use super::collect::{DISENGAGES, ENGAGES};
use super::log::{Log, options, run};
use super::random_scene::{Rng, all_acting, description, external};
use super::transforms::{
    Variant, View, in_units, other_angle, other_body_axes, other_inertial_axes,
    other_main_body_axes, renumbered,
};

const BODIES: usize = 7;

/// A random tree in which hinges are released by time and by angle, lock, and push off, and
/// the thrust comes and goes, under more from outside.
pub fn eventful(seed: u64) -> SceneDescription {
    let mut scene = description(BODIES, seed);
    let dice = &mut Rng::new(seed ^ 0xe4e17);
    scene.end_time = 1.2;
    for thrust in &mut scene.externals {
        thrust.course = Course::Pulse { on: 0.21, off: 0.77 };
    }
    scene.externals.extend((0..2).map(|_| external(dice, BODIES)));
    for i in 0..BODIES {
        let trigger = (i + 1) % BODIES;
        let of_trigger = scene.bodies[trigger].hinge.start;
        let hinge = &mut scene.bodies[i].hinge;
        if i % 3 == 1 {
            hinge.start.state = HingeState::Unreleased;
            hinge.start.rate = 0.0;
            hinge.release = match i {
                1 => Release::Angle {
                    hinge: trigger,
                    angle: of_trigger.angle + 0.1 * of_trigger.rate,
                },
                _ => Release::Time(dice.between(0.1, 0.4)),
            };
        }
        if i % 2 == 0 {
            let rate = if hinge.start.rate == 0.0 { 1.0 } else { hinge.start.rate };
            hinge.lock_angle = Some(hinge.start.angle + dice.between(0.05, 0.4) * rate);
        }
    }
    scene
}

fn variants(scene: &SceneDescription, seed: u64) -> Vec<Variant> {
    let dice = &mut Rng::new(seed ^ 0x7e11);
    vec![
        renumbered(scene),
        other_main_body_axes(scene, dice.attitude(), dice.vector(1.0)),
        other_inertial_axes(scene, dice.attitude()),
        other_body_axes(scene, dice.below(BODIES), dice.rotation(), dice.between(-1.0, 1.0)),
        other_angle(scene, dice.below(BODIES), dice.between(-2.0, 2.0)),
        // Feet and slugs to metres and kilograms, and something with another unit of time.
        in_units(scene, 0.3048, 14.593_902_937_206_364, 1.0),
        in_units(scene, 1000.0, 0.001, 60.0),
    ]
}

fn view(seen: &Snapshot) -> View {
    View {
        time: seen.time,
        position: seen.position_inertial,
        velocity: seen.velocity_inertial,
        acceleration: Vec3::zero(),
        attitude: seen.attitude.to_matrix(),
        omega: seen.omega_body,
        omega_dot: Vec3::zero(),
        beta: seen.beta.clone(),
        tau: seen.tau.clone(),
        tau_dot: vec![0.0; seen.beta.len()],
    }
}

/// The motion at the initial time with all hinges free, accelerations included.
fn evaluated(description: &SceneDescription) -> View {
    let scene = Scene::new(description.clone()).expect("a valid scene");
    let mut dynamics = Recursive::new(&scene);
    let beta: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
    let tau: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.rate).collect();
    let mode = all_acting(&scene, vec![HingeState::Free; beta.len()]);
    dynamics.set_mode(&mode, &beta);
    let initial = &scene.initial;
    dynamics.set_outside(initial.attitude, initial.time);
    let motion = Motion { omega_body: initial.omega_body, beta: &beta, tau: &tau };
    let mut found = Accelerations::for_hinges(beta.len());
    dynamics.accelerations(&motion, &mut found);
    let attitude = initial.attitude.to_matrix();
    let gravity = scene.gravity.map_or(Vec3::zero(), |g| g.up * g.acceleration);
    View {
        time: initial.time,
        position: initial.position_inertial,
        velocity: initial.velocity_inertial,
        acceleration: attitude * found.origin_body - gravity,
        attitude,
        omega: initial.omega_body,
        omega_dot: found.omega_dot_body,
        tau_dot: found.tau_dot,
        beta,
        tau,
    }
}

/// Largest difference, each relative to the size of its kind of quantity (at least one).
pub fn difference(a: &View, b: &View) -> f64 {
    let vectors = |a: Vec3<f64>, b: Vec3<f64>| (a - b).norm() / a.norm().max(1.0);
    let lists = |a: &[f64], b: &[f64]| {
        let size = a.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        a.iter().zip(b).map(|(x, y)| (x - y).abs() / size).fold(0.0, f64::max)
    };
    let matrices =
        |a: Mat3<f64>, b: Mat3<f64>| (a - b).rows.iter().map(|row| row.norm()).fold(0.0, f64::max);
    [
        (a.time - b.time).abs(),
        vectors(a.position, b.position),
        vectors(a.velocity, b.velocity),
        vectors(a.acceleration, b.acceleration),
        matrices(a.attitude, b.attitude),
        vectors(a.omega, b.omega),
        vectors(a.omega_dot, b.omega_dot),
        lists(&a.beta, &b.beta),
        lists(&a.tau, &b.tau),
        lists(&a.tau_dot, &b.tau_dot),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

#[test]
fn single_evaluations() {
    for seed in 0..200 {
        let scene = eventful(seed);
        let original = evaluated(&scene);
        for variant in variants(&scene, seed) {
            let found = (variant.back)(evaluated(&variant.scene));
            let error = difference(&original, &found);
            // Rounding of the rewritten data, 1e-16 each, magnified by the condition of the
            // mass matrix, which reaches some thousands in these trees.
            assert!(error < EVALUATION_ERROR, "seed {seed}, {}: {error:e}", variant.name);
        }
    }
}

const EVALUATION_ERROR: f64 = 1e-12;

/// The steps differ from one telling to another, since the error norm looks at components; so
/// two runs agree within the errors of both: 1e-13 a step, over some hundred steps, magnified
/// by the events' times and by lock-up impulses.
const RUN_ERROR: f64 = 1e-11;

#[test]
fn whole_runs_with_events() {
    let mut kinds = std::collections::BTreeSet::new();
    for seed in 0..8 {
        let scene = eventful(seed);
        let original = run(&scene, &options(6, 1e-13));
        kinds.extend(original.events.iter().map(|(event, _)| event.kind));
        for variant in variants(&scene, seed) {
            let told = format!("seed {seed}, {}", variant.name);
            let other = run(&variant.scene, &options(6, 1e-13));
            same_events(&original, &other, &variant, &told);
            for (a, b) in original.samples.iter().zip(&other.samples) {
                let found = View { acceleration: Vec3::zero(), ..(variant.back)(view(b)) };
                let error = difference(&view(a), &found);
                assert!(error < RUN_ERROR, "{told}, time {}: {error:e}", a.time);
            }
        }
    }
    for kind in [
        EventKind::Release,
        EventKind::LockUp,
        DISENGAGES,
        ENGAGES,
        EventKind::ThrustOn,
        EventKind::ThrustOff,
    ] {
        assert!(kinds.contains(&kind), "no {kind:?} in any of the scenes");
    }
}

/// Asserts equal events of equal hinges; those of one instant may stand in another order.
fn same_events(original: &Log, other: &Log, variant: &Variant, told: &str) {
    let mut found: Vec<_> = other
        .events
        .iter()
        .map(|(event, _)| {
            let hinge = event.hinge.map(|i| variant.order[i]);
            let impulse = event.impulse.map(|p| p * hinge.map_or(1.0, &variant.impulse));
            (event.time * variant.time, event.kind, hinge, impulse)
        })
        .collect();
    assert_eq!(found.len(), original.events.len(), "{told}");
    for (event, _) in &original.events {
        let same = |&(time, kind, hinge, _): &(f64, EventKind, Option<usize>, _)| {
            (time - event.time).abs() < RUN_ERROR && kind == event.kind && hinge == event.hinge
        };
        let at = found.iter().position(same);
        let (_, _, _, impulse) = found.remove(at.unwrap_or_else(|| panic!("{told}: {event:?}")));
        let (a, b) = (impulse.unwrap_or(0.0), event.impulse.unwrap_or(0.0));
        assert!((a - b).abs() < RUN_ERROR * b.abs().max(1.0), "{told}: {a} {event:?}");
    }
}

/// What the others are worth: a scene that is changed in earnest gives another answer.
#[test]
fn another_scene_gives_another_answer() {
    let scene = eventful(0);
    let mut changed = scene.clone();
    changed.bodies[3].hinge.spring.linear -= 1e-3;
    assert!(difference(&evaluated(&scene), &evaluated(&changed)) > 1e-6);
}
