//! Masts that slide: closed forms of two and three bodies on a line, and of a spinning hub.

use nboom::model::{
    Body, Hinge, HingeStart, HingeState, Joint, KickOffSpring, MassProperties, Mount, Release,
    SceneDescription,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::EventKind;

use super::log::{options, run};

/// Runs at the tightest tolerance err by a few 1e-14 of each quantity.
const TOLERANCE: f64 = 1e-12;

fn mass(mass: f64) -> MassProperties {
    MassProperties::new(mass, Vec3::zero(), Sym3::diagonal(0.3, 0.4, 0.5) * mass)
}

/// A body that slides along x and whose mass centre is on that line.
fn stage(inboard: Option<usize>, of_stage: f64, hinge: Hinge) -> Body {
    Body {
        inboard,
        mount: Mount::at(Vec3::zero()),
        joint: Joint::Prismatic,
        axis: Vec3::unit_x(),
        mass_properties: mass(of_stage),
        tip: Vec3::unit_x(),
        hinge,
    }
}

/// A spring of stiffness `k` without force at the travel `rest`.
fn sprung(k: f64, rest: f64, latch: Option<f64>, start: HingeStart, release: Release) -> Hinge {
    let mut hinge = Hinge { lock_angle: latch, start, release, ..Hinge::free() };
    (hinge.spring.linear, hinge.spring.preload_angle) = (-k, -rest);
    hinge
}

/// When a spring has moved a reduced mass from rest at `from` to `to`, and how fast it is there.
fn arrival(k: f64, reduced_mass: f64, rest: f64, [from, to]: [f64; 2]) -> (f64, f64) {
    let frequency = (k / reduced_mass).sqrt();
    let phase = ((to - rest) / (from - rest)).acos();
    (phase / frequency, -(from - rest) * frequency * phase.sin())
}

fn is_close(found: f64, expected: f64) {
    assert!((found - expected).abs() < TOLERANCE * expected.abs(), "{found} {expected}");
}

#[test]
fn a_telescope_runs_out_stage_by_stage() {
    let [hub, inner, outer] = [100.0, 8.0, 5.0];
    let (k, rest) = (40.0, 3.0);
    let held = HingeStart { angle: 0.2, rate: 0.0, state: HingeState::Unreleased };
    let mut scene = SceneDescription::at_rest("telescope", mass(hub), 6.0);
    let at_once = sprung(k, rest, Some(2.0), held, Release::Time(0.5));
    let after = Release::AfterLock { hinge: 0, delay: 0.25 };
    let in_turn = sprung(2.0 * k, rest, Some(1.5), held, after);
    scene.bodies = vec![stage(None, inner, at_once), stage(Some(0), outer, in_turn)];
    let found = run(&scene, &options(1, 1e-13));

    let carried = inner + outer;
    let first = hub * carried / (hub + carried);
    let (first_takes, first_speed) = arrival(k, first, rest, [0.2, 2.0]);
    let second = outer * (hub + inner) / (hub + carried);
    let (second_takes, second_speed) = arrival(2.0 * k, second, rest, [0.2, 1.5]);
    let first_latch = 0.5 + first_takes;
    let expected = [
        (first_latch, first, first_speed),
        (first_latch + 0.25 + second_takes, second, second_speed),
    ];
    let latches = found.of_kind(EventKind::LockUp);
    assert_eq!(latches.len(), 2);
    for ((event, after), (time, reduced_mass, speed)) in latches.into_iter().zip(expected) {
        is_close(event.time, time);
        is_close(event.impulse.expect("a latch has an impulse"), -reduced_mass * speed);
        let lost = event.before.kinetic_energy - event.after.kinetic_energy;
        is_close(lost, 0.5 * reduced_mass * speed * speed);
        // Nothing has pushed the whole.
        let momentum = after.linear_momentum_inertial.norm();
        assert!(momentum < 1e-13 * reduced_mass * speed, "{momentum:e}");
    }
    // The hub has made room by the shares of the masses that went.
    let last = found.last();
    assert_eq!(last.beta, [2.0, 1.5]);
    let moved = -(1.8 * carried + 1.3 * outer) / (hub + carried);
    is_close(last.position_inertial.x, moved);
}

#[test]
fn a_kick_off_spring_drives_a_stage_until_its_limit() {
    let [hub, of_stage, force, limit] = [60.0, 4.0, 12.0, 0.75];
    let spring = KickOffSpring {
        main_body_point: Vec3::zero(),
        body_point: Vec3::zero(),
        coefficients: [force, 0.0, 0.0, 0.0],
        limit_length: limit,
    };
    let mut hinge = Hinge { kick_off: Some(spring), lock_angle: Some(2.0), ..Hinge::free() };
    hinge.start.angle = 0.25;
    let mut scene = SceneDescription::at_rest("kicked", mass(hub), 5.0);
    scene.bodies = vec![stage(None, of_stage, hinge)];
    let found = run(&scene, &options(1, 1e-13));

    let acceleration = force * (1.0 / hub + 1.0 / of_stage);
    let pushed = (2.0 * (limit - 0.25) / acceleration).sqrt();
    let speed = acceleration * pushed;
    let let_go = &found.events[0].0;
    is_close(let_go.time, pushed);
    let latch = found.of_kind(EventKind::LockUp)[0].0;
    is_close(latch.time, pushed + (2.0 - limit) / speed);
    let reduced_mass = hub * of_stage / (hub + of_stage);
    is_close(latch.impulse.expect("a latch has an impulse"), -reduced_mass * speed);
}

#[test]
fn masses_that_slide_out_slow_a_spinning_hub_down() {
    let (of_hub, of_stage, start, spin) = (30.0, 2.0, 0.5, 3.0);
    let mut scene = SceneDescription::at_rest("spinner", mass(of_hub), 1.0);
    let mut hinge = Hinge::free();
    hinge.start.angle = start;
    scene.bodies = [1.0, -1.0]
        .map(|way| {
            let body = stage(None, of_stage, hinge);
            Body { axis: Vec3::unit_x() * way, ..body }
        })
        .into();
    scene.initial.omega_body = Vec3::unit_z() * spin;
    let found = run(&scene, &options(8, 1e-13));

    let about_z = |radius: f64| 0.5 * of_hub + 2.0 * of_stage * (0.5 + radius * radius);
    let momentum = about_z(start) * spin;
    let energy = 0.5 * momentum * spin;
    assert!(found.last().beta[0] > 2.0 * start, "{}", found.last().beta[0]);
    for seen in &found.samples[1..] {
        let radius = seen.beta[0];
        is_close(seen.beta[1], radius);
        let rate = momentum / about_z(radius);
        is_close(seen.omega_body.z, rate);
        // Both masses move outward with what the spin has lost.
        let speed = ((energy - 0.5 * momentum * rate) / of_stage).sqrt();
        is_close(seen.tau[0], speed);
    }
}
