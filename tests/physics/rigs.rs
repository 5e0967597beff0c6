//! A main body that a test rig holds: closed forms, and the motion of a free one under the reaction.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::model::{
    Base, Body, Gravity, Hinge, HingeStart, HingeState, InitialMotion, Joint, MassProperties,
    Mount, Release, Scene, SceneDescription,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{EventKind, Form, Options};

use super::collect::detail;
use super::log::{options, run};
use super::random_scene::{all_acting, conservative, hinged};

/// Runs at the tightest tolerance err by a few 1e-14 of each quantity.
const TOLERANCE: f64 = 1e-12;

fn is_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= TOLERANCE * expected.abs(), "{found} {expected}");
}

/// A main body that is fixed, which carries one body.
fn on_rig(
    mass_properties: MassProperties,
    joint: Joint,
    axis: Vec3<f64>,
    hinge: Hinge,
) -> SceneDescription {
    let hub = MassProperties::new(5.0, Vec3::unit_z(), Sym3::diagonal(2.0, 3.0, 4.0));
    let mut scene = SceneDescription::at_rest("rig", hub, 3.0);
    scene.base = Base::Fixed;
    let mount = Mount::at(Vec3::zero());
    let tip = Vec3::unit_x();
    scene.bodies = vec![Body { inboard: None, mount, joint, axis, mass_properties, tip, hinge }];
    scene
}

/// A quarter of the period of a pendulum of the natural frequency 1 that turns back at `amplitude`, by the
/// arithmetic-geometric mean.
fn quarter_period(amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * std::f64::consts::PI / a
}

/// A pendulum on a rig falls from rest and latches at the bottom. The rig is turned in space, and so is
/// gravity with it.
#[test]
fn a_pendulum_takes_a_quarter_of_its_period_to_the_bottom() {
    let (mass, length, about_centre, g, amplitude) = (2.0, 1.5, 0.4, 9.81, 2.0);
    let bob =
        MassProperties::new(mass, Vec3::unit_x() * length, Sym3::diagonal(0.2, 0.3, about_centre));
    let start = HingeStart { angle: -amplitude, rate: 0.0, state: HingeState::Free };
    let hinge = Hinge { start, lock_angle: Some(0.0), ..Hinge::free() };
    let mut scene = on_rig(bob, Joint::Revolute, Vec3::unit_z(), hinge);
    let tilted = super::random_scene::Rng::new(5).attitude();
    // At angle zero the pendulum hangs along x of the rig.
    let up = tilted.to_matrix() * -Vec3::unit_x();
    scene.gravity = Some(Gravity { acceleration: g, up });
    let position_inertial = Vec3::new(3.0, -2.0, 1.0);
    scene.initial =
        InitialMotion { attitude: tilted, position_inertial, ..InitialMotion::at_rest() };
    let found = run(&scene, &options(3, 1e-13));

    let about_hinge = about_centre + mass * length * length;
    let frequency = (mass * g * length / about_hinge).sqrt();
    let [(latch, after)] = found.of_kind(EventKind::LockUp)[..] else { panic!("one latch") };
    is_close(latch.time, quarter_period(amplitude) / frequency);
    let rate = 2.0 * frequency * (0.5 * amplitude).sin();
    is_close(latch.impulse.expect("a latch has an impulse"), -about_hinge * rate);
    is_close(latch.before.kinetic_energy, 0.5 * about_hinge * rate * rate);
    assert_eq!(latch.after.kinetic_energy, 0.0);
    assert_eq!(after.omega_body, Vec3::zero());
    for seen in &found.samples {
        assert_eq!(seen.position_inertial, position_inertial);
    }
    // At rest the rig carries the weight of all.
    let reaction = detail(found.last()).reaction.expect("the rig holds the main body");
    is_close(reaction.force.x, -(mass + 5.0) * g);
    is_close(reaction.moment.y, -5.0 * g);
    let balance = found.summary.conservation;
    assert!(balance.energy < 1e-12, "{balance:?}");
    assert_eq!((balance.linear_momentum, balance.angular_momentum), (None, None));
}

/// A spring pushes a mast out of a rig: the mass that moves is that of the mast alone.
#[test]
fn a_mast_on_a_rig_is_pushed_out_and_caught() {
    let (mass, k, rest, [from, to]) = (8.0, 40.0, 3.0, [0.2, 2.0]);
    let mast = MassProperties::new(mass, Vec3::zero(), Sym3::diagonal(0.3, 0.4, 0.5));
    let start = HingeStart { angle: from, rate: 0.0, state: HingeState::Unreleased };
    let release = Release::Time(0.5);
    let mut hinge = Hinge { start, release, lock_angle: Some(to), ..Hinge::free() };
    (hinge.spring.linear, hinge.spring.preload_angle) = (-k, -rest);
    let found = run(&on_rig(mast, Joint::Prismatic, Vec3::unit_x(), hinge), &options(10, 1e-13));

    let frequency = (k / mass).sqrt();
    let phase = ((to - rest) / (from - rest)).acos();
    let speed = (rest - from) * frequency * phase.sin();
    let [(latch, _)] = found.of_kind(EventKind::LockUp)[..] else { panic!("one latch") };
    is_close(latch.time, 0.5 + phase / frequency);
    is_close(latch.impulse.expect("a latch has an impulse"), -mass * speed);
    for seen in &found.samples {
        let moves = seen.hinges[0] == HingeState::Free;
        let push = if moves { k * (rest - seen.beta[0]) } else { 0.0 };
        let reaction = detail(seen).reaction.expect("the rig holds the main body");
        assert!((reaction.force.x - push).abs() < 1e-11 * k, "{reaction:?} {push}");
    }
}

/// Mass matrix and right side of the free satellite, another derivation, hold with the accelerations of the
/// held one and the reaction that was found.
#[test]
fn a_free_main_body_moves_likewise_under_the_reaction() {
    for seed in 0..60 {
        let bodies = 1 + (seed % 6) as usize;
        let mut scene = hinged(bodies, seed);
        (scene.base, scene.initial.omega_body) = (Base::Fixed, Vec3::zero());
        scene.initial.velocity_inertial = Vec3::zero();
        scene.externals.clear();
        scene.gravity = Some(Gravity { acceleration: 3.0, up: Vec3::unit_y() });
        let scene = Scene::new(scene).expect("a valid scene");
        let beta: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
        let tau: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.rate).collect();
        let mode = all_acting(&scene, vec![HingeState::Free; bodies]);
        let mut dynamics = Recursive::new(&scene);
        dynamics.set_mode(&mode, &beta);
        let mut found = Accelerations::for_hinges(bodies);
        let motion = Motion { omega_body: Vec3::zero(), beta: &beta, tau: &tau };
        dynamics.accelerations(&motion, &mut found);
        assert_eq!(found.omega_dot_body, Vec3::zero());
        // Gravity is no acceleration here, so the rig accelerates upward.
        let upward = scene.initial.attitude.to_matrix().transpose() * Vec3::unit_y() * 3.0;
        assert!((found.origin_body - upward).norm() < 1e-14);
        let reaction = dynamics.reaction(&motion, &found);

        let size = 6 + bodies;
        let (mut matrix, mut right) = (vec![0.0; size * size], vec![0.0; size]);
        dynamics.equations(&motion, &mut matrix, &mut right);
        let unknowns = [found.origin_body.to_array(), found.omega_dot_body.to_array()].concat();
        let unknowns = [unknowns, found.tau_dot].concat();
        let acting = [reaction.force.to_array(), reaction.moment.to_array()].concat();
        for (i, right) in right.iter().enumerate() {
            let terms = matrix[i * size..][..size].iter().zip(&unknowns).map(|(m, x)| m * x);
            let terms: Vec<f64> = terms.collect();
            let scale = terms.iter().fold(right.abs(), |most, term| most.max(term.abs()));
            let left: f64 = terms.iter().sum();
            let expected = right + acting.get(i).copied().unwrap_or(0.0);
            // The elimination errs by rounding times the condition of the hinges' block.
            assert!((left - expected).abs() < 1e-11 * scale, "seed {seed}, row {i}");
        }
    }
}

#[test]
fn trees_on_a_rig_keep_their_energy_by_all_code_that_covers_them() {
    for seed in 0..20 {
        let bodies = 1 + (seed % 5) as usize;
        let mut scene = conservative(bodies, seed);
        (scene.base, scene.initial.omega_body) = (Base::Fixed, Vec3::zero());
        (scene.initial.velocity_inertial, scene.end_time) = (Vec3::zero(), 0.5);
        let mut ends = Vec::new();
        for formulation in [None, Form::named("symmetric")] {
            let options = Options { formulation, ..options(2, 1e-12) };
            let found = run(&scene, &options);
            assert!(found.summary.conservation.energy < 1e-9, "{seed}");
            ends.push(found.last().beta.clone());
        }
        for (a, b) in ends[0].iter().zip(&ends[1]) {
            assert!((a - b).abs() < 1e-9, "seed {seed}: {a} {b}");
        }
    }
}
