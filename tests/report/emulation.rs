//! The original's slips in the motion, against an emulation of it in 80-bit arithmetic, which has
//! other equations of motion (Kane's) with the same three slips and nothing else of the original.

use nboom::ode::Method;
use nboom::scalar::{Mat3, Quaternion, Vec3};
use nboom::sim::{EventKind, Form, Options, Path, Snapshot};
use nboom::strength::{Slip, Slips};
use serde_json::Value;

use crate::collect::{Collected, detail, run, tight, try_run};
use crate::sample_run::scene;
use crate::support::{data, number, numbers, relative_error};

const ALL: [Slip; 3] = [Slip::ChainKickOff, Slip::PaddleKickOff, Slip::PaddleInertia];

/// Of states and impulses, relative to the largest magnitude of their series, and of times [s]:
/// what runs at this tolerance keep to in all reference scenes (`tests/scenes/trajectories.rs`).
const STATES: f64 = 1e-9;
const TIMES: f64 = 1e-10;

fn emulation() -> Value {
    data("report_testcase_1970_emulation.expected.json")
}

fn list<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of[key].as_array().expect("a list")
}

fn with(slips: &[Slip], options: &Options) -> Collected {
    let slips: Slips = slips.iter().copied().collect();
    let samples = list(&emulation(), "samples").len() - 1;
    run(&slips.scene(scene()), &Options { samples, ..*options }).0
}

type OfSnapshot = fn(&Snapshot) -> Vec<f64>;

/// What is compared at every output time: key in the emulation, and the same of a snapshot.
const SERIES: [(&str, OfSnapshot); 11] = [
    ("t", |s| vec![s.time]),
    ("omega", |s| s.omega_body.to_array().into()),
    ("quat_wxyz", |s| attitude(s.attitude)),
    ("rho_inertial", |s| s.position_inertial.to_array().into()),
    ("vO_inertial", |s| s.velocity_inertial.to_array().into()),
    ("beta", |s| s.beta.clone()),
    ("tau", |s| s.tau.clone()),
    ("kinetic_energy", |s| vec![s.kinetic_energy]),
    ("Hc_inertial", |s| s.angular_momentum_inertial.to_array().into()),
    ("omega_dot", |s| detail(s).omega_dot_body.to_array().into()),
    ("beta_ddot", |s| detail(s).beta_ddot.clone()),
];

/// The nine entries of its matrix, in which the sign of a quaternion plays no part.
fn attitude(q: Quaternion<f64>) -> Vec<f64> {
    let Mat3 { rows } = q.normalized().to_matrix();
    rows.into_iter().flat_map(Vec3::to_array).collect()
}

fn expected(sample: &Value, key: &str) -> Vec<f64> {
    let found = numbers(&sample[key]);
    match (key, &found[..]) {
        ("quat_wxyz", &[scalar, x, y, z]) => {
            attitude(Quaternion { scalar, vector: Vec3::new(x, y, z) })
        }
        _ => found,
    }
}

/// The largest difference of each series over its largest magnitude.
fn deviations(found: &Collected, emulation: &Value) -> Vec<(&'static str, f64)> {
    let samples = list(emulation, "samples");
    let of_series = |&(key, of): &(&'static str, OfSnapshot)| {
        let found: Vec<f64> = found.samples.iter().flat_map(of).collect();
        let expected: Vec<f64> = samples.iter().flat_map(|s| expected(s, key)).collect();
        (key, relative_error(&found, &expected, 1e-3))
    };
    SERIES.iter().map(of_series).collect()
}

fn agrees(found: &Collected, emulation: &Value) -> bool {
    let found = deviations(found, emulation);
    println!("{found:?}");
    found.iter().all(|&(_, off)| off < STATES)
}

/// Releases and lock-ups as hinge, time and impulse. The emulation follows the paddle's springs, too,
/// which exert nothing, so that events of springs are left out.
fn told(emulation: &Value) -> Vec<(usize, f64, f64)> {
    let events = list(emulation, "events").iter().filter(|event| event["kind"] != "kick_off");
    let hinge = |event: &Value| event["segment"].as_u64().expect("a hinge") as usize;
    let impulse = |event: &Value| event["impulse_on_hinge"].as_f64().unwrap_or(0.0);
    events.map(|event| (hinge(event), number(event, "time"), impulse(event))).collect()
}

fn events(found: &Collected) -> Vec<(usize, f64, f64)> {
    let kept = |kind| matches!(kind, EventKind::Release | EventKind::LockUp);
    let events = found.events.iter().filter(|(event, _)| kept(event.kind));
    let of = |hinge: Option<usize>| hinge.expect("it is of a hinge");
    events.map(|(e, _)| (of(e.hinge), e.time, e.impulse.unwrap_or(0.0))).collect()
}

#[test]
fn all_three_reproduce_it() {
    let emulation = emulation();
    let found = with(&ALL, &tight(1));
    assert!(agrees(&found, &emulation));
    let (found, expected) = (events(&found), told(&emulation));
    assert_eq!(found.len(), 8);
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.0, expected.0);
        assert!((found.1 - expected.1).abs() < TIMES, "{found:?} {expected:?}");
        assert!(
            (found.2 - expected.2).abs() <= STATES * expected.2.abs(),
            "{found:?} {expected:?}"
        );
    }
}

/// Jacobians, power series and the method that otherwise keeps the angular momentum are of the same
/// equations.
#[test]
fn every_method_integrates_them() {
    let emulation = emulation();
    for integrator in [Method::Gauss, Method::Radau5, Method::Taylor] {
        assert!(
            agrees(&with(&ALL, &Options { integrator, ..tight(1) }), &emulation),
            "{integrator}"
        );
    }
}

/// Generated right sides have no place for what a spring withholds.
#[test]
fn what_springs_withhold_is_withheld_in_generated_code() {
    let slips: Slips = [Slip::ChainKickOff].into_iter().collect();
    let motion = |options: &Options| -> Vec<f64> {
        let (found, _) = run(&slips.scene(scene()), options);
        found.samples.iter().flat_map(|s| [&s.beta[..], &s.tau[..]].concat()).collect()
    };
    let by_recursion = motion(&tight(20));
    let as_shipped = motion(&Options { kernels: nboom_routines::for_runs(), ..tight(20) });
    let off = relative_error(&as_shipped, &by_recursion, 1e-3);
    // Generated code has other roundings.
    assert!(0.0 < off && off < STATES, "{off:e}");
}

#[test]
fn each_alone_and_each_left_out_is_something_else() {
    let emulation = emulation();
    for slip in ALL {
        let others: Vec<Slip> = ALL.into_iter().filter(|&other| other != slip).collect();
        for slips in [&[slip][..], &others] {
            let found = deviations(&with(slips, &tight(1)), &emulation);
            let most = found.iter().fold(0.0_f64, |most, &(_, off)| most.max(off));
            assert!(most > 1e-3, "{slips:?}: {found:?}");
        }
    }
}

#[test]
fn energy_and_angular_momentum_are_the_printed_ones() {
    let found = with(&ALL, &tight(1));
    let [first, last] = [&found.samples[0], found.last()];
    // Printed to five digits; the last |H| also has the original's errors of integration.
    assert!((first.kinetic_energy - 241_500.0).abs() < 0.5, "{}", first.kinetic_energy);
    let momentum = |at: &Snapshot| at.angular_momentum_inertial.norm();
    assert!((momentum(first) - 48_228.0).abs() < 0.5, "{}", momentum(first));
    assert!((momentum(last) - 48_270.0).abs() < 10.0, "{}", momentum(last));
    let right = with(&[], &tight(1));
    assert!((momentum(right.last()) / momentum(&right.samples[0]) - 1.0).abs() < 1e-11);
}

/// Generated routines and closed forms are of rigid bodies.
#[test]
fn the_recursion_alone_turns_inertia_so() {
    let slips: Slips = [Slip::PaddleInertia].into_iter().collect();
    let scene = slips.scene(scene());
    for formulation in nboom::formulation::Formulation::ALL {
        let form = Some(Form::Closed(formulation));
        let options = Options { path: Path::Generic, formulation: form, ..tight(1) };
        let error = try_run(&scene, &options).1.expect_err("it is not covered").error.to_string();
        assert!(error.contains("hinge 2,1") && error.contains("of rigid bodies"), "{error}");
    }
    let kernels = nboom_routines::all();
    let summary = run(&scene, &Options { kernels, ..tight(1) }).1;
    let paths = summary.selections.iter().map(|selection| selection.path);
    let (first, last) = (paths.clone().next(), paths.clone().next_back());
    // With arm and paddle held all is rigid, the tensor wrong or not.
    assert_eq!((first, last), (Some("generated"), Some("generated")), "{:?}", summary.selections);
    assert!(paths.clone().any(|path| path == "generic"));
}
