//! Forces and torques from outside on any body, along any axes, by pulses and tables: closed forms, balances, and all
//! code against the recursion.

use nboom::formulation::Formulation;
use nboom::model::{
    Appendage, Course, External, ExternalAxes, ExternalKind, Hinge, HingeState, MassProperties,
    Mount, Release, SceneDescription, Segment,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{EventKind, Form, Method, Options, Path};

use super::log::{options, run};
use super::random_scene::{Rng, description, external};

const MASS: f64 = 4.0;
const MOMENTS: Vec3<f64> = Vec3 { x: 2.0, y: 3.0, z: 1.5 };

/// A body whose mass centre is not O, at rest.
fn body(externals: Vec<External>) -> SceneDescription {
    let moments = Sym3::diagonal(MOMENTS.x, MOMENTS.y, MOMENTS.z);
    let body = MassProperties::new(MASS, Vec3::new(0.1, -0.2, 0.3), moments);
    SceneDescription { externals, ..SceneDescription::at_rest("pushed", body, 4.0) }
}

fn always(kind: ExternalKind, amount: Vec3<f64>) -> External {
    let force = External::thrust(amount, Vec3::zero(), [0.0, 9.0]);
    External { kind, course: Course::ALWAYS, ..force }
}

/// A few dozen steps at 1e-12; dense output adds ten times as much.
const CLOSE: f64 = 1e-10;

/// Along a principal axis it turns the body by M t² / 2 J, wherever it acts.
#[test]
fn a_constant_torque_about_a_principal_axis() {
    for axes in [ExternalAxes::Body, ExternalAxes::Inertial] {
        let torque = always(ExternalKind::Torque, Vec3::unit_y() * 0.6);
        let scene = body(vec![External { axes, point: Vec3::unit_x() * 2.0, ..torque }]);
        let log = run(&scene, &options(8, 1e-12));
        for seen in &log.samples {
            let rate = 0.6 / MOMENTS.y * seen.time;
            let (sin, cos) = (0.5 * rate * seen.time).sin_cos();
            assert!((seen.omega_body - Vec3::unit_y() * rate).norm() < CLOSE, "{axes:?}");
            let x_axis = seen.attitude.to_matrix() * Vec3::unit_x();
            assert!((x_axis - Vec3::new(cos, 0.0, -sin)).norm() < CLOSE, "{axes:?}");
        }
        let kept = log.summary.conservation;
        assert!(
            kept.energy < 1e-11 && kept.angular_momentum.is_some_and(|off| off < 1e-11),
            "{kept:?}"
        );
        assert!(kept.linear_momentum.is_some_and(|off| off < 1e-11), "{kept:?}");
    }
}

/// The mass centre of a body that tumbles goes along a parabola under a force that keeps its inertial direction, and a
/// torque does not move it.
#[test]
fn an_inertial_force_moves_the_mass_centre_on_a_parabola() {
    let force = Vec3::new(1.0, -2.0, 0.5);
    let thrust = External {
        axes: ExternalAxes::Inertial,
        point: Vec3::new(0.0, 1.0, -0.4),
        ..always(ExternalKind::Force, force)
    };
    let torque = always(ExternalKind::Torque, Vec3::new(0.3, 0.1, -0.2));
    let mut scene = body(vec![thrust, torque]);
    let dice = &mut Rng::new(3);
    scene.initial.attitude = dice.attitude();
    scene.initial.velocity_inertial = dice.vector(2.0);
    scene.initial.omega_body = dice.vector(2.0);
    let log = run(&scene, &options(8, 1e-12));
    let center = |i: usize| {
        let detail = log.samples[i].detail.as_ref().expect("asked for");
        (detail.mass_center_inertial, detail.mass_center_velocity_inertial)
    };
    let (at, velocity) = center(0);
    for (i, seen) in log.samples.iter().enumerate() {
        let (found, t) = (center(i), seen.time);
        let expected = at + velocity * t + force * (0.5 * t * t / MASS);
        assert!((found.0 - expected).norm() < CLOSE * (1.0 + expected.norm()), "{t}");
        assert!((found.1 - velocity - force * (t / MASS)).norm() < CLOSE, "{t}");
    }
    let turned = log.samples[8].omega_body - scene.initial.omega_body;
    assert!(turned.norm() > 0.5, "{turned:?}");
    let kept = log.summary.conservation;
    assert!(
        kept.energy < 1e-10 && kept.angular_momentum.is_some_and(|off| off < 1e-10),
        "{kept:?}"
    );
    assert!(kept.linear_momentum.is_some_and(|off| off < 1e-10), "{kept:?}");
}

/// A table gives the integral of its straight pieces, times are met to the last bit, and corners within it are no events.
#[test]
fn a_table_over_time_has_the_impulse_of_its_integral() {
    let points = [[0.3, 2.0], [1.1, -1.0], [1.7, 4.0], [2.9, 0.5]];
    let force = Vec3::new(0.0, 2.0, -1.0);
    let course = Course::Table(points.to_vec());
    let axes = ExternalAxes::Inertial;
    let log = run(
        &body(vec![External { course, axes, ..always(ExternalKind::Force, force) }]),
        &options(40, 1e-12),
    );
    let share = |t: f64| {
        let part = |pair: &[[f64; 2]]| {
            let ([t0, s0], [t1, s1]) = (pair[0], pair[1]);
            let end = t.clamp(t0, t1);
            let at_end = s0 + (s1 - s0) * (end - t0) / (t1 - t0);
            0.5 * (s0 + at_end) * (end - t0)
        };
        points.windows(2).map(part).sum::<f64>()
    };
    for seen in &log.samples {
        let detail = seen.detail.as_ref().expect("asked for");
        let expected = force * (share(seen.time) / MASS);
        let off = (detail.mass_center_velocity_inertial - expected).norm();
        // Quadratic in time, which the method integrates but for rounding; the body turns meanwhile.
        assert!(off < 1e-11, "{off:e} at {}", seen.time);
    }
    let times: Vec<_> = log.events.iter().map(|(e, _)| (e.kind, e.time)).collect();
    let expected = [(EventKind::ThrustOn, 0.3), (EventKind::ThrustOff, 2.9), (EventKind::End, 4.0)];
    assert_eq!(times, expected);
}

/// A panel on a hub that is as good as fixed: a force at its tip turns it about its hinge, and opens or closes it.
#[test]
fn a_thruster_at_the_tip_of_a_panel_turns_it() {
    let hub = MassProperties::new(1e9, Vec3::zero(), Sym3::diagonal(1e9, 1e9, 1e9));
    let (length, mass, moment) = (2.0, 3.0, 1.0);
    let panel =
        MassProperties::new(mass, Vec3::unit_y() * 1.0, Sym3::diagonal(moment, 0.1, moment));
    let mut scene = SceneDescription::at_rest("panel", hub, 1.0);
    let segments = vec![Segment { length, mass_properties: panel, hinge: Hinge::free() }];
    scene.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    let force = 0.7;
    let tip = External {
        body: Some(0),
        point: Vec3::unit_y() * length,
        ..always(ExternalKind::Force, Vec3::unit_z() * force)
    };
    scene.externals = vec![tip];
    let log = run(&scene, &options(4, 1e-12));
    // The hinge axis is x: z at the tip is a torque of force times length about it.
    let expected = 0.5 * force * length / (moment + mass);
    // The hub yields by the ratio of masses.
    assert!((log.last().beta[0] - expected).abs() < 1e-8, "{} {expected}", log.last().beta[0]);
    let reaction = log.last().detail.as_ref().expect("asked for").hinge_torque[0];
    assert!(reaction.abs() < 1e-15);
    assert!(log.summary.conservation.energy < 1e-11, "{:?}", log.summary.conservation);
}

/// Random trees with hinges that lock and are released, under forces and torques of every kind.
fn pushed(bodies: usize, seed: u64) -> SceneDescription {
    let mut scene = description(bodies, seed);
    let dice = &mut Rng::new(seed ^ 0x0a7);
    scene.end_time = 1.0;
    for _ in 0..1 + dice.below(3) {
        scene.externals.push(external(dice, bodies));
    }
    for body in &mut scene.bodies {
        let hinge = &mut body.hinge;
        hinge.spring.quadratic = 0.0;
        hinge.dashpot.rate_quadratic = 0.0;
        hinge.dashpot.angle_quadratic = 0.0;
        if dice.chance(0.4) {
            hinge.lock_angle = Some(hinge.start.angle + 0.2 * hinge.start.rate.signum());
        } else if dice.chance(0.4) {
            hinge.start.state = HingeState::Unreleased;
            hinge.start.rate = 0.0;
            hinge.release = Release::Time(dice.between(0.1, 0.9));
        }
    }
    scene
}

/// Work is the change of energy, and impulses those of momenta, through latches and releases.
#[test]
fn work_and_impulses_account_for_energy_and_momenta() {
    let by = |integrator| Options { integrator, ..options(10, 1e-11) };
    let momenta =
        Options { formulation: Some(Form::Closed(Formulation::Momentum)), ..options(10, 1e-11) };
    for seed in 0..12 {
        let scene = pushed(1 + seed as usize % 5, seed);
        for options in [options(10, 1e-11), momenta, by(Method::Taylor), by(Method::Radau5)] {
            let kept = run(&scene, &options).summary.conservation;
            // Some hundred steps at 1e-11.
            let worst = kept.laws().map(|(_, residual)| residual).fold(0.0, f64::max);
            assert!(worst < 1e-8, "{seed}, {}: {kept:?}", options.integrator);
        }
    }
}

/// A chain pushed at its end, by code of every formulation.
#[test]
fn every_formulation_takes_what_acts_from_outside() {
    let boom = MassProperties::new(2.0, Vec3::unit_y() * 0.5, Sym3::diagonal(0.4, 0.1, 0.4));
    let mut scene = body(Vec::new());
    scene.end_time = 1.0;
    let segment = Segment { length: 1.0, mass_properties: boom, hinge: Hinge::free() };
    let segments = vec![segment.clone(), segment];
    scene.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_x()), segments });
    scene.initial.omega_body = Vec3::new(0.3, -0.2, 0.4);
    let dice = &mut Rng::new(11);
    scene.externals = (0..4).map(|_| external(dice, 2)).collect();
    scene.externals[0].body = Some(1);
    scene.externals[1].body = Some(0);
    let expected = run(&scene, &options(4, 1e-12)).last().clone();
    for form in Form::all() {
        let by = Options { path: Path::Generic, formulation: Some(form), ..options(4, 1e-12) };
        let found = run(&scene, &by).last().clone();
        let off = (found.omega_body - expected.omega_body).norm()
            + (found.position_inertial - expected.position_inertial).norm()
            + (found.beta[1] - expected.beta[1]).abs();
        assert!(off < CLOSE, "{form}: {off:e}");
    }
}
