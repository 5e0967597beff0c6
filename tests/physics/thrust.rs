//! A body under the thrust pulse: closed forms for thrust along and across the spin axis.

use nboom::model::{External, MassProperties, SceneDescription};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::EventKind;

use super::log::{options, run};
use super::random_scene::Rng;

const MASS: f64 = 4.0;
const AXIAL: f64 = 3.0;
const ON: f64 = 0.7;
const OFF: f64 = 2.9;
const END: f64 = 4.0;
const SPIN: f64 = 1.3;

/// Positions of order ten, integrated with rtol 1e-12 in the two dozen steps of the pulse;
/// dense output adds ten times as much.
const CLOSE: f64 = 1e-10;

/// A symmetric top spinning about its z axis, with the thrust in a pulse.
fn scene(force: Vec3<f64>, point: Vec3<f64>) -> SceneDescription {
    let dice = &mut Rng::new(5);
    let center = Vec3::new(0.0, 0.0, 0.6);
    let body = MassProperties::new(MASS, center, Sym3::diagonal(2.0, 2.0, AXIAL));
    let mut scene = SceneDescription::at_rest("thruster", body, END);
    scene.externals = vec![External::thrust(force, point, [ON, OFF])];
    scene.initial.attitude = dice.attitude();
    scene.initial.position_inertial = dice.vector(2.0);
    scene.initial.velocity_inertial = dice.vector(2.0);
    scene.initial.omega_body = Vec3::unit_z() * SPIN;
    scene
}

/// How long the thrust has been on at time `t`.
fn on_time(t: f64) -> f64 {
    (t.min(OFF) - ON).max(0.0)
}

#[test]
fn along_the_spin_axis_through_the_mass_center() {
    let force = 5.0;
    let scene = scene(Vec3::unit_z() * force, Vec3::new(0.0, 0.0, -1.0));
    let log = run(&scene, &options(40, 1e-12));
    let along = scene.initial.attitude.to_matrix() * Vec3::unit_z();
    let start = &log.samples[0];
    for seen in &log.samples {
        let (on, t) = (on_time(seen.time), seen.time);
        let coasted = (t - OFF).max(0.0);
        let a = force / MASS;
        let far = a * (0.5 * on * on + on * coasted);
        // O is on the spin axis, so it moves as the mass centre does.
        let at = start.position_inertial + start.velocity_inertial * t + along * far;
        let velocity = start.velocity_inertial + along * (a * on);
        assert!((seen.position_inertial - at).norm() < CLOSE, "{t}");
        assert!((seen.velocity_inertial - velocity).norm() < CLOSE, "{t}");
        assert!((seen.omega_body - Vec3::unit_z() * SPIN).norm() < 1e-13);
    }
    let times: Vec<_> = log.events.iter().map(|(e, _)| (e.kind, e.time)).collect();
    let expected = [(EventKind::ThrustOn, ON), (EventKind::ThrustOff, OFF), (EventKind::End, END)];
    assert_eq!(times, expected);
}

/// ∫ f over [0, end] by Gauss's rule of five points on 64 equal parts: exact to rounding for
/// the smooth integrands here.
fn integral(end: f64, f: impl Fn(f64) -> (f64, f64)) -> (f64, f64) {
    let points = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    let half = 0.5 * end / 64.0;
    let mut sum = (0.0, 0.0);
    for part in 0..64 {
        for (x, weight) in points {
            let (a, b) = f(half * (f64::from(2 * part + 1) + x));
            sum = (sum.0 + weight * half * a, sum.1 + weight * half * b);
        }
    }
    sum
}

#[test]
fn across_the_spin_axis_with_a_lever() {
    // Force along x at a point off to −y, at the height of the mass centre: a torque along z.
    let (force, arm) = (2.0, 0.9);
    let scene = scene(Vec3::unit_x() * force, Vec3::new(0.0, -arm, 0.6));
    let log = run(&scene, &options(40, 1e-12));
    let spin_up = force * arm / AXIAL;
    let axes = scene.initial.attitude.to_matrix();
    let (start, a) = (&log.samples[0], force / MASS);
    // Angle turned since the thrust came on.
    let turned = |s: f64| SPIN * s + 0.5 * spin_up * s * s;
    let direction = |s: f64| (SPIN * ON + turned(s)).sin_cos();
    for seen in &log.samples {
        let (on, t) = (on_time(seen.time), seen.time);
        let coasted = (t - OFF).max(0.0);
        let omega = Vec3::unit_z() * (SPIN + spin_up * on);
        assert!((seen.omega_body - omega).norm() < CLOSE, "{t}: {:?}", seen.omega_body);
        let angle = SPIN * t.min(ON) + turned(on) + omega.z * coasted;
        // The body's x axis, seen from the axes at the start.
        let x_axis = axes.transpose_mul(seen.attitude.to_matrix() * Vec3::unit_x());
        assert!((x_axis - Vec3::new(angle.cos(), angle.sin(), 0.0)).norm() < CLOSE, "{t}");

        // Velocity and position gained: Fresnel integrals of the turning direction.
        let (vy, vx) = integral(on, direction);
        let (py, px) = integral(on, |s| {
            let (y, x) = direction(s);
            ((on - s) * y, (on - s) * x)
        });
        let gained = Vec3::new(vx, vy, 0.0) * a;
        let far = Vec3::new(px, py, 0.0) * a + gained * coasted;
        let velocity = start.velocity_inertial + axes * gained;
        let at = start.position_inertial + start.velocity_inertial * t + axes * far;
        assert!((seen.velocity_inertial - velocity).norm() < CLOSE, "{t}");
        assert!((seen.position_inertial - at).norm() < CLOSE, "{t}");
    }
    // The whole impulse and the whole work are accounted for.
    let kept = log.summary.conservation;
    assert!(
        kept.linear_momentum.is_some_and(|off| off < 1e-12)
            && kept.angular_momentum.is_some_and(|off| off < 1e-12),
        "{kept:?}"
    );
    assert!(kept.energy < 1e-12, "{kept:?}");
}
