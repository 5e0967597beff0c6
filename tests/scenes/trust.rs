//! What a certificate says is off against what is off.

use std::f64::consts::PI;

use nboom::model::{
    Appendage, Hinge, HingeStart, HingeState, MassProperties, Mount, Scene, SceneDescription,
    Segment,
};
use nboom::scalar::{Mat3, Quaternion, Sym3, Vec3};
use nboom::sim::{
    Event, EventKind, Nobody, Options, Recorder, Reference as Truth, Snapshot, Witness, simulate,
    trust,
};

use serde_json::Value;

use crate::catalog::Reference;
use crate::collect::{run, tight};
use crate::compare::{hinge_of, kind_of};
use crate::support::json_scene::vector;
use crate::support::{number, numbers};

/// How far what is said may be from what is found: a thousand times tighter, a reference is off by
/// some hundredths of the error at most, besides its rounding.
const TIGHTER: [f64; 2] = [0.1, 1e-10];

/// In double-double it is not off, but 80-bit arithmetic is, with which it is compared.
const EXACT: [f64; 2] = [0.0, OF_REFERENCES];

#[test]
fn differences_from_a_tighter_run_are_the_errors() {
    differences_are_the_errors(1e-6, Truth::TighterTolerance, TIGHTER);
}

#[test]
fn differences_from_double_double_are_the_errors() {
    differences_are_the_errors(1e-9, Truth::DoubleDouble, EXACT);
}

fn differences_are_the_errors(rtol: f64, truth: Truth, [share, least]: [f64; 2]) {
    let close = |said: f64, found: f64| (said - found).abs() < share * found + least;
    let (mut events, mut large) = (0, 0);
    for reference in Reference::all() {
        let scene = reference.scene();
        let options = Options { rtol, atol: 0.1 * rtol, ..Options::default() };
        let mut witness = Witness::new();
        simulate(&scene, &options, &mut witness).expect("every scene runs to its end");
        let said =
            trust(&scene, &options, &witness, truth, &mut Nobody).expect("the reference runs, too");
        assert!(said.same_events, "{}", reference.name);

        for event in &said.events {
            let is_it = |other: &&serde_json::Value| {
                kind_of(other) == event.event.kind
                    && hinge_of(other) == event.event.hinge
                    && (number(other, "time") - event.event.time).abs() < 1e-3
            };
            // A release at the initial time is none of the oracle's.
            let Some(truth) = reference.events.iter().find(is_it) else { continue };
            let since = number(truth, "time") - scene.initial.time;
            let off =
                (event.event.time - number(truth, "time")).abs() / since.max(f64::MIN_POSITIVE);
            assert!(close(event.time.difference, off), "{}: {off:e} {event:?}", reference.name);
            events += 1;
            large += usize::from(off > 100.0 * least);
        }

        let omega = |sample: &Value| vector(&sample["omega"]);
        let largest = |v: Vec3<f64>| v.to_array().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let last = reference.samples.last().expect("there are samples");
        let ours = witness.end().expect("the run has ended").omega_body;
        // The oracle's samples, and the run's output times, may miss the largest rate by some.
        let size = witness.scales(&scene).omega;
        let of_oracle = reference.samples.iter().map(|at| largest(omega(at))).fold(0.0, f64::max);
        assert!((size / of_oracle - 1.0).abs() < 0.05, "{}: {size} {of_oracle}", reference.name);
        let off = largest(ours - omega(last)) / size;
        let said = said.end.iter().find(|digits| digits.quantity == "omega").expect("a row");
        assert!(close(said.difference, off), "{}: {off:e} {said:?}", reference.name);
    }
    assert!(events > 40 && large > 5, "{events} events, {large} of them off by much");
}

/// The oracle's run as a witness saw it; what a certificate does not compare is another run's.
fn oracle(reference: &Reference) -> Witness {
    let (found, _) = run(&reference.scene(), &tight(1));
    let mut witness = Witness::new();
    for (event, after) in found.events.iter().filter(|(event, _)| event.kind != EventKind::End) {
        let is_it = |other: &&Value| {
            kind_of(other) == event.kind
                && hinge_of(other) == event.hinge
                && (number(other, "time") - event.time).abs() < 1e-6
        };
        let told = reference.events.iter().find(is_it).expect("the oracle has it, too");
        let (time, impulse) = (number(told, "time"), told["impulse_on_hinge"].as_f64());
        witness.event(&Event { time, impulse, ..*event }, after).expect("it is kept");
    }
    let last = reference.samples.last().expect("there are samples");
    let q = numbers(&last["quat_wxyz"]);
    let attitude = Quaternion { scalar: q[0], vector: Vec3::new(q[1], q[2], q[3]) };
    let ours = found.last();
    let cosine = attitude.scalar * ours.attitude.scalar + attitude.vector.dot(ours.attitude.vector);
    let sign = cosine.signum();
    let end = Snapshot {
        attitude: Quaternion { scalar: sign * attitude.scalar, vector: attitude.vector * sign },
        omega_body: vector(&last["omega"]),
        beta: numbers(&last["beta"]),
        tau: numbers(&last["tau"]),
        position_inertial: vector(&last["rho_inertial"]),
        velocity_inertial: vector(&last["vO_inertial"]),
        ..ours.clone()
    };
    let (last, _) = found.events.last().expect("a run ends with an event");
    witness.event(last, &end).expect("it is kept");
    witness
}

/// What the references are known to, of the size of each quantity: that of their own event times,
/// which their states at the end do not exceed.
const OF_REFERENCES: f64 = 6e-14;

/// All that the two programs have in common is the scene: other equations, other arithmetic, another
/// integrator.
#[test]
fn double_double_agrees_with_the_references() {
    let (mut events, mut impulses) = (0, 0);
    for reference in Reference::all() {
        let (scene, name) = (reference.scene(), reference.name);
        let said = trust(
            &scene,
            &Options::default(),
            &oracle(&reference),
            Truth::DoubleDouble,
            &mut Nobody,
        );
        let said = said.expect("every scene runs to its end");
        assert!(said.same_events, "{name}");
        events += said.events.len();
        let of_impulses = said.events.iter().filter_map(|event| event.impulse);
        impulses += of_impulses.clone().count();
        let of_end = said.end.iter().copied();
        let of_times = said.events.iter().map(|event| event.time);
        for digits in of_end.chain(of_times).chain(of_impulses) {
            assert!(digits.difference < OF_REFERENCES, "{name}: {digits:?}");
        }
    }
    assert!(events >= 55 && impulses > 10, "{events} events, {impulses} impulses");
}

/// Nothing moves but by rounding, everything turns about one axis, or what should stand still does not
/// quite: right answers of 1e-17 have all their digits.
#[test]
fn what_is_zero_is_known_to_all_digits() {
    for (told, omega, rate) in
        [("at rest", 0.0, 0.0), ("about one axis", 2.0, 0.0), ("unfolding", 0.0, 0.5)]
    {
        let scene = wings(omega, rate);
        for (rtol, truth) in [(1e-9, Truth::TighterTolerance), (1e-9, Truth::DoubleDouble)] {
            let options = Options { rtol, ..Options::default() };
            let mut witness = Witness::new();
            simulate(&scene, &options, &mut witness).expect("a short run");
            let said = trust(&scene, &options, &witness, truth, &mut Nobody)
                .expect("the reference runs, too");
            assert!(said.same_events, "{told}");
            let impulses = said.events.iter().filter_map(|event| event.impulse);
            for digits in said.end.iter().copied().chain(impulses) {
                // Some hundred steps at most, each of which may err by the tolerance.
                assert!(digits.difference < 100.0 * rtol, "{told}: {digits:?}");
            }
        }
    }
}

/// A hub with two wings that unfold alike about parallel axes, so that the hub does not turn by them,
/// in a frame turned by angles that have no exact sine.
fn wings(omega: f64, rate: f64) -> Scene {
    let frame = Mat3::about_axis(Vec3::new(0.48, 0.6, 0.64), 1.1);
    let ball = |mass: f64, at| MassProperties::new(mass, at, Sym3::diagonal(1.0, 1.0, 1.0));
    let mut description = SceneDescription::at_rest("wings", ball(10.0, Vec3::zero()), 2.0);
    description.initial.omega_body = frame * Vec3::unit_z() * omega;
    for side in [1.0, -1.0] {
        let turned = Mat3::about_axis(Vec3::unit_z(), if side > 0.0 { 0.0 } else { PI });
        let start = HingeStart { angle: 0.3, rate, state: HingeState::Free };
        let hinge = Hinge { start, lock_angle: Some(0.9), ..Hinge::free() };
        let mount =
            Mount { point: frame * Vec3::unit_y() * side, rot_inboard_from_hinge: frame * turned };
        let segment = Segment { length: 1.0, mass_properties: ball(1.0, Vec3::unit_y()), hinge };
        description.attach(&Appendage::Regular { mount, segments: vec![segment] });
    }
    Scene::new(description).expect("the bodies are physical")
}

/// A run that missed an event, wherever it was, and one that has one too many.
#[test]
fn events_that_only_one_of_the_runs_has_are_told() {
    let reference = Reference::load("s02_single_boom");
    let (scene, options) = (reference.scene(), Options::default());
    let (found, _) = run(&scene, &options);
    let inner = found.events.iter().filter(|(event, _)| event.kind != EventKind::End);
    let events: Vec<Event> = inner.map(|(event, _)| *event).collect();
    let (end, _) = found.events.last().expect("a run ends with an event");
    let witness = |events: &[Event]| {
        let mut witness = Witness::new();
        let kept = |event: &Event| witness.event(event, found.last()).expect("it is kept");
        events.iter().chain([end]).for_each(kept);
        witness
    };
    let same_events = |events: &[Event], truth| {
        let said = trust(&scene, &options, &witness(events), truth, &mut Nobody)
            .expect("the reference runs");
        (said.same_events, said.events.len())
    };
    assert!(events.len() >= 2, "{events:?}");
    for truth in Truth::ALL {
        assert_eq!(same_events(&events, truth), (true, events.len()), "{}", truth.name());
        for missed in 0..events.len() {
            let mut rest = events.clone();
            rest.remove(missed);
            assert_eq!(same_events(&rest, truth), (false, missed), "{}", truth.name());
        }
        let one_more = [&events[..], &events[events.len() - 1..]].concat();
        assert_eq!(same_events(&one_more, truth), (false, events.len()), "{}", truth.name());
    }
}
