//! A locked hinge is a weld: the same scene with the two bodies merged by hand moves alike.

use nalgebra::{Matrix3, Vector3};
use nboom::model::{HingeState, MassProperties, Release, SceneDescription};
use nboom::scalar::{Mat3, Quaternion, Sym3, Vec3};
use nboom::sim::{EventKind, Snapshot};

use super::independence::eventful;
use super::log::{options, run};
use super::newton_euler::{matrix, vector};
use super::random_scene::{Rng, description};
use super::transforms::reordered;

fn tensor(i: &Sym3<f64>) -> Matrix3<f64> {
    Matrix3::new(i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz)
}

/// Two bodies as one, along the first one's axes (theorem of parallel axes).
fn merged(
    first: &MassProperties,
    second: &MassProperties,
    point: Vec3<f64>,
    rot: &Mat3<f64>,
) -> MassProperties {
    let (r, mass) = (matrix(rot), first.mass + second.mass);
    let centers = [vector(first.center_of_mass), vector(point) + r * vector(second.center_of_mass)];
    let common = (centers[0] * first.mass + centers[1] * second.mass) / mass;
    let shifted = |mass: f64, center: Vector3<f64>| {
        let d = center - common;
        (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * mass
    };
    let i = tensor(&first.inertia)
        + r * tensor(&second.inertia) * r.transpose()
        + shifted(first.mass, centers[0])
        + shifted(second.mass, centers[1]);
    let inertia = Sym3 {
        xx: i[(0, 0)],
        yy: i[(1, 1)],
        zz: i[(2, 2)],
        xy: i[(0, 1)],
        xz: i[(0, 2)],
        yz: i[(1, 2)],
    };
    MassProperties::new(mass, Vec3::new(common.x, common.y, common.z), inertia)
}

/// The scene without hinge `i`, which stood at `beta`, and the old number of each hinge left.
/// The hinge has no kick-off spring and releases none.
fn welded(original: &SceneDescription, i: usize, beta: f64) -> (SceneDescription, Vec<usize>) {
    let gone = original.bodies[i];
    assert!(gone.hinge.kick_off.is_none());
    let at_zero = gone.mount.rot_inboard_from_hinge;
    let rot = at_zero * gone.joint.turn(gone.axis, beta);
    let point = gone.mount.point + at_zero * gone.joint.travel(gone.axis, beta);
    let mut scene = original.clone();
    let onto = match gone.inboard {
        Some(p) => &mut scene.bodies[p].mass_properties,
        None => &mut scene.main_body,
    };
    *onto = merged(onto, &gone.mass_properties, point, &rot);
    for body in scene.bodies.iter_mut().filter(|body| body.inboard == Some(i)) {
        body.inboard = gone.inboard;
        body.mount.point = point + rot * body.mount.point;
        body.mount.rot_inboard_from_hinge = rot * body.mount.rot_inboard_from_hinge;
    }
    // What hung on a first body now makes branches of its own, which must stand together.
    let order = depth_first(&scene, i);
    for body in &scene.bodies {
        let trigger = |release| matches!(release, Release::Angle { hinge, .. } if hinge == i);
        assert!(!trigger(body.hinge.release));
    }
    let mut padded = order.clone();
    padded.push(i);
    let mut scene = reordered(&scene, &padded);
    scene.bodies.pop();
    (scene, order)
}

fn depth_first(scene: &SceneDescription, without: usize) -> Vec<usize> {
    fn visit(scene: &SceneDescription, at: Option<usize>, without: usize, order: &mut Vec<usize>) {
        for i in 0..scene.bodies.len() {
            if i != without && scene.bodies[i].inboard == at {
                order.push(i);
                visit(scene, Some(i), without, order);
            }
        }
    }
    let mut order = Vec::new();
    visit(scene, None, without, &mut order);
    order
}

/// Largest difference between two motions, positions and rates being of order one to ten.
fn difference(held: &Snapshot, merged: &Snapshot, order: &[usize]) -> f64 {
    let vectors = [
        held.position_inertial - merged.position_inertial,
        held.velocity_inertial - merged.velocity_inertial,
        held.omega_body - merged.omega_body,
        held.linear_momentum_inertial - merged.linear_momentum_inertial,
        held.angular_momentum_inertial - merged.angular_momentum_inertial,
    ];
    let size = [&held.velocity_inertial, &held.omega_body, &held.linear_momentum_inertial]
        .iter()
        .fold(held.angular_momentum_inertial.norm().max(1.0), |m, v| m.max(v.norm()));
    let of_vectors = vectors.iter().map(|v| v.norm() / size).fold(0.0, f64::max);
    let turned = held.attitude.to_matrix() - merged.attitude.to_matrix();
    let of_attitude = turned.rows.iter().map(|row| row.norm()).fold(0.0, f64::max);
    let of_hinge = |(&old, (beta, tau)): (&usize, (&f64, &f64))| {
        (held.beta[old] - beta).abs().max((held.tau[old] - tau).abs() / size)
    };
    let hinges = order.iter().zip(merged.beta.iter().zip(&merged.tau));
    hinges.map(of_hinge).fold(of_vectors.max(of_attitude), f64::max)
}

/// Both runs integrate the same equations from data that differ by rounding; the allowance is
/// for what some dozen steps and the events in between make of it.
const SAME: f64 = 1e-12;

#[test]
fn a_hinge_that_starts_locked() {
    for seed in 0..12 {
        let mut scene = description(6, seed);
        scene.end_time = 1.0;
        let i = Rng::new(seed ^ 0x3e1d).below(6);
        let hinge = &mut scene.bodies[i].hinge;
        hinge.kick_off = None;
        hinge.start.rate = 0.0;
        hinge.start.state = if seed % 2 == 0 { HingeState::Locked } else { HingeState::Unreleased };
        let (other, order) = welded(&scene, i, scene.bodies[i].hinge.start.angle);
        let (held, merged) = (run(&scene, &options(5, 1e-12)), run(&other, &options(5, 1e-12)));
        assert_eq!(held.events.len(), merged.events.len(), "seed {seed}");
        for (a, b) in held.samples.iter().zip(&merged.samples) {
            let error = difference(a, b, &order);
            assert!(error < SAME, "seed {seed}, time {}: {error:e}", a.time);
        }
    }
}

/// After the first lock-up of a run the motion is that of the welded scene, started from there. Its steps are others,
/// since steps before a start say where the next event is expected: each run errs by its own tolerance, a fiftieth
/// of the allowance.
#[test]
fn a_hinge_that_locks_on_the_way() {
    let mut compared = 0;
    for seed in 0..30 {
        let mut scene = eventful(seed);
        for body in &mut scene.bodies {
            body.hinge.kick_off = None;
            body.hinge.start.state = HingeState::Free;
            body.hinge.release = Release::Never;
            body.hinge.dashpot = Default::default();
        }
        scene.externals.clear();
        let log = run(&scene, &options(3, 2e-14));
        let locks = log.of_kind(EventKind::LockUp);
        let Some((event, after)) = locks.first() else { continue };
        let i = event.hinge.expect("a lock-up has a hinge");
        let mut from_there = scene.clone();
        start_from(&mut from_there, after);
        let (mut other, order) = welded(&from_there, i, after.beta[i]);
        // Every other hinge still locks at the same angle, so it must start on the same side.
        other.end_time = scene.end_time;
        let merged = run(&other, &options(3, 2e-14));
        assert_eq!(merged.of_kind(EventKind::LockUp).len() + 1, locks.len(), "seed {seed}");
        let error = difference(log.last(), merged.last(), &order);
        assert!(error < SAME, "seed {seed}: {error:e}");
        compared += 1;
    }
    assert!(compared >= 15, "only {compared} of the scenes lock at all");
}

fn start_from(scene: &mut SceneDescription, seen: &Snapshot) {
    scene.initial.time = seen.time;
    scene.initial.attitude =
        Quaternion { scalar: seen.attitude.scalar, vector: seen.attitude.vector };
    scene.initial.position_inertial = seen.position_inertial;
    scene.initial.velocity_inertial = seen.velocity_inertial;
    scene.initial.omega_body = seen.omega_body;
    for (i, body) in scene.bodies.iter_mut().enumerate() {
        body.hinge.start.angle = seen.beta[i];
        body.hinge.start.rate = seen.tau[i];
        body.hinge.start.state = seen.hinges[i];
    }
}
