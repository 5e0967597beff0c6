//! Differences between a run and its reference.

use std::fmt;

use nboom::scalar::{Mat3, Quaternion, Vec3};
use nboom::sim::{EventKind, Snapshot};
use serde_json::Value;

use crate::catalog::Reference;
use crate::collect::{Collected, DISENGAGES, ENGAGES, detail, forces_and_lengths};
use crate::support::{number, numbers};

/// The largest differences, each relative to what the limits of the tests refer to.
pub struct Deviation {
    /// Of any series, relative to its largest expected magnitude (at least 1e-3), and of which.
    pub states: f64,
    pub worst_series: String,
    /// Of event times, relative to the time span.
    pub times: f64,
    /// Of impulses, relative.
    pub impulses: f64,
}

impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { states, worst_series, times, impulses } = self;
        write!(
            f,
            "states {states:.1e} ({worst_series}), times {times:.1e}, impulses {impulses:.1e}"
        )
    }
}

type OfSnapshot = fn(&Snapshot) -> Vec<f64>;

/// What is compared at every output time: key in the reference, and the same of a snapshot.
const SERIES: [(&str, OfSnapshot); 21] = [
    ("t", |s| vec![s.time]),
    ("rho_inertial", |s| s.position_inertial.to_array().into()),
    ("vO_inertial", |s| s.velocity_inertial.to_array().into()),
    ("quat_wxyz", |s| entries(s.attitude)),
    ("omega", |s| s.omega_body.to_array().into()),
    ("beta", |s| s.beta.clone()),
    ("tau", |s| s.tau.clone()),
    ("alpha", |s| s.alpha.clone()),
    ("sigma", |s| s.sigma.clone()),
    ("hinge_state", |s| s.hinges.iter().map(|hinge| f64::from(hinge.code())).collect()),
    ("kinetic_energy", |s| vec![s.kinetic_energy]),
    ("linear_momentum_inertial", |s| s.linear_momentum_inertial.to_array().into()),
    ("Hc_inertial", |s| s.angular_momentum_inertial.to_array().into()),
    ("nutation_angle", |s| vec![s.nutation]),
    ("omega_dot", |s| detail(s).omega_dot_body.to_array().into()),
    ("beta_ddot", |s| detail(s).beta_ddot.clone()),
    ("S_body", |s| detail(s).mass_center_body.to_array().into()),
    ("cm_inertial", |s| detail(s).mass_center_inertial.to_array().into()),
    ("hinge_torque_free_formula", |s| detail(s).hinge_torque.clone()),
    ("kick_extension", |s| of_lines(s)[1].clone()),
    ("kick_force", |s| of_lines(s)[0].clone()),
];

fn of_lines(snapshot: &Snapshot) -> [Vec<f64>; 2] {
    forces_and_lengths(&detail(snapshot).lines, snapshot.beta.len())
}

/// The nine entries of the matrix of an attitude, in which its sign plays no part.
fn entries(attitude: Quaternion<f64>) -> Vec<f64> {
    let Mat3 { rows } = attitude.normalized().to_matrix();
    rows.into_iter().flat_map(Vec3::to_array).collect()
}

/// The expected values of one series at one time.
fn expected(sample: &Value, key: &str) -> Vec<f64> {
    match key {
        "quat_wxyz" => {
            let q = numbers(&sample[key]);
            entries(Quaternion { scalar: q[0], vector: Vec3::new(q[1], q[2], q[3]) })
        }
        "hinge_state" => {
            let states = sample[key].as_array().expect("a list").iter();
            let code = |state: &Value| match state.as_str() {
                Some("unreleased") => -1.0,
                Some("free") => 0.0,
                Some("locked") => 1.0,
                _ => panic!("{state} is no hinge state"),
            };
            states.map(code).collect()
        }
        _ => numbers(&sample[key]),
    }
}

/// Compares a run with its reference; panics where the two differ in kind.
pub fn compare(found: &Collected, reference: &Reference) -> Deviation {
    let springs: Vec<bool> =
        reference.scene().bodies.iter().map(|body| body.hinge.kick_off.is_some()).collect();
    assert_eq!(found.samples.len(), reference.samples.len(), "{}", reference.name);
    let (mut states, mut worst_series) = (0.0, String::new());
    for (key, of_snapshot) in SERIES {
        let error = series_error(found, reference, &springs, key, of_snapshot);
        if error > states {
            (states, worst_series) = (error, key.to_owned());
        }
    }
    check_attitudes(found);
    let (times, impulses) = event_errors(found, reference);
    Deviation { states, worst_series, times, impulses }
}

/// Largest difference in a series, relative to its largest magnitude (at least 1e-3, so that
/// what is zero throughout is not compared with its own rounding).
fn series_error(
    found: &Collected,
    reference: &Reference,
    springs: &[bool],
    key: &str,
    of: OfSnapshot,
) -> f64 {
    let (mut scale, mut difference) = (1e-3_f64, 0.0_f64);
    for (snapshot, sample) in found.samples.iter().zip(&reference.samples) {
        let (found, mut expected) = (of(snapshot), expected(sample, key));
        if key == "kick_extension" {
            // The references measure a length where there is no spring, too.
            expected
                .iter_mut()
                .zip(springs)
                .filter(|(_, spring)| !**spring)
                .for_each(|(e, _)| *e = 0.0);
        }
        assert_eq!(found.len(), expected.len(), "{}: {key}", reference.name);
        for (f, e) in found.iter().zip(&expected) {
            assert!(f.is_finite(), "{}: {key} at {}", reference.name, snapshot.time);
            difference = difference.max((f - e).abs());
            scale = scale.max(e.abs());
        }
    }
    difference / scale
}

/// Norm 1 within 1e-12, a scalar that starts non-negative, and no jump of the sign.
fn check_attitudes(found: &Collected) {
    let attitudes = || found.samples.iter().map(|s| s.attitude);
    assert!(attitudes().all(|q| (q.norm_squared().sqrt() - 1.0).abs() < 1e-12));
    assert!(found.samples[0].attitude.scalar >= 0.0);
    for (q, next) in attitudes().zip(attitudes().skip(1)) {
        let cosine = q.scalar * next.scalar + q.vector.dot(next.vector);
        // Between two output times a fast body may turn by half a turn; then nothing is known.
        assert!(cosine > 0.0 || cosine.abs() < 0.1, "an attitude changes its sign");
    }
}

/// The events of one kind and hinge, in the order of their times: time and impulse.
type Group = ((EventKind, Option<usize>), Vec<(f64, Option<f64>)>);

fn grouped(mut events: Vec<(EventKind, Option<usize>, f64, Option<f64>)>) -> Vec<Group> {
    events.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
    let mut groups: Vec<Group> = Vec::new();
    for (kind, hinge, time, impulse) in events {
        match groups.last_mut() {
            Some((key, times)) if *key == (kind, hinge) => times.push((time, impulse)),
            _ => groups.push(((kind, hinge), vec![(time, impulse)])),
        }
    }
    groups
}

/// The kind of an expected event.
pub fn kind_of(event: &Value) -> EventKind {
    match event["kind"].as_str() {
        Some("release") => EventKind::Release,
        Some("lock") => EventKind::LockUp,
        Some("kick_off") => DISENGAGES,
        Some("kick_on") => ENGAGES,
        Some("thrust_on") => EventKind::ThrustOn,
        Some("thrust_off") => EventKind::ThrustOff,
        _ => panic!("{event} has no known kind"),
    }
}

/// The hinge of an expected event; the thrust has −1.
pub fn hinge_of(event: &Value) -> Option<usize> {
    event["segment"].as_u64().map(|hinge| hinge as usize)
}

/// Largest differences of times, relative to the span, and of impulses, relative to each.
fn event_errors(found: &Collected, reference: &Reference) -> (f64, f64) {
    let inner = found.events.iter().filter(|(event, _)| event.kind != EventKind::End);
    let ours = inner.map(|(event, _)| (event.kind, event.hinge, event.time, event.impulse));
    let theirs = reference.events.iter().map(|event| {
        let impulse = event["impulse_on_hinge"].as_f64();
        (kind_of(event), hinge_of(event), number(event, "time"), impulse)
    });
    let (ours, theirs) = (grouped(ours.collect()), grouped(theirs.collect()));
    let counts = |groups: &[Group]| -> Vec<_> {
        groups.iter().map(|(key, times)| (*key, times.len())).collect()
    };
    assert_eq!(counts(&ours), counts(&theirs), "{}", reference.name);
    let (mut times, mut impulses) = (0.0_f64, 0.0_f64);
    let pairs = ours.iter().zip(&theirs).flat_map(|((_, a), (_, b))| a.iter().zip(b));
    for (&(time, impulse), &(time_there, impulse_there)) in pairs {
        times = times.max((time - time_there).abs() / reference.time_span());
        assert_eq!(impulse.is_some(), impulse_there.is_some(), "only lock-ups have impulses");
        if let (Some(a), Some(b)) = (impulse, impulse_there) {
            impulses = impulses.max((a - b).abs() / b.abs().max(1e-9));
        }
    }
    (times, impulses)
}
