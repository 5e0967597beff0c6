//! Every reference run, from JSON and from its deck, within the limits that are promised.

use std::collections::BTreeSet;
use std::path::Path;

use nboom::formulation::Formulation;
use nboom::model::Scene;
use nboom::scalar::{Batch, Isa, Kernel, Real, Routine};
use nboom::sim::{Form, Method, Nobody, Options, OwnLaw, Simulator};

use crate::catalog::{AT_REST, Reference};
use crate::collect::{Collected, run, tight};
use crate::compare::compare;

/// Limits at a relative tolerance of 1e-12: states relative to the largest value of each series,
/// event times relative to the span, impulses relative.
const STATES: f64 = 1e-9;
const TIMES: f64 = 1e-10;
const IMPULSES: f64 = 1e-9;

/// A run at that tolerance is within the limits.
pub fn agrees(told: &str, found: &Collected, reference: &Reference) {
    let deviation = compare(found, reference);
    println!("{} {told}: {deviation}", reference.name);
    let within =
        deviation.states <= STATES && deviation.times <= TIMES && deviation.impulses <= IMPULSES;
    assert!(within, "{} {told}: {deviation}", reference.name);
}

/// By the recursion and by what the command takes: stock routines wherever one fits.
fn check(from: &str, scene_of: impl Fn(&Reference) -> Scene) {
    let mut events = 0;
    let mut routines = BTreeSet::new();
    for reference in Reference::all() {
        let scene = scene_of(&reference);
        let recursive = tight(reference.intervals());
        let shipped = Options {
            kernels: nboom_routines::for_runs(),
            batches: nboom_routines::right_sides_of_eight(),
            ..recursive
        };
        let (by_recursion, summary) = run(&scene, &recursive);
        agrees(&format!("from {from}, recursion"), &by_recursion, &reference);
        assert!(summary.selections.iter().all(|s| s.formulation == "recursive"), "{summary:?}");
        let (as_shipped, summary) = run(&scene, &shipped);
        agrees(&format!("from {from}, as shipped"), &as_shipped, &reference);
        // A stock routine fits every mode of every one of these scenes.
        assert!(summary.selections.iter().all(|s| s.path == "generated"), "{summary:?}");
        // And that of its whole right side, thrust and kick-off springs included, also where two of these push
        // one link: arm and paddle of the report's sample while the paddle is held on the arm.
        let is_whole = |reason: &str| reason.contains("; whole right side");
        assert!(summary.selections.iter().all(|s| is_whole(&s.reason)), "{summary:?}");
        routines.extend(summary.selections.into_iter().map(|s| s.reason));
        // Other operations leave other roundings; with the same ones it is the same code.
        let rounded_alike = as_shipped.samples == by_recursion.samples;
        assert!(!rounded_alike || scene.bodies.is_empty(), "{}: the same code", reference.name);
        for found in [by_recursion, as_shipped] {
            events += found.happenings().len();
        }
    }
    // All events of all scenes; a reference that lost its own would otherwise go unnoticed.
    assert_eq!(events, 2 * 55);
    assert!(routines.len() > 8, "{routines:?}");
}

#[test]
fn runs_from_json_agree_with_the_references() {
    check("json", Reference::scene);
}

#[test]
fn runs_from_decks_agree_with_the_references() {
    check("deck", Reference::deck);
}

#[test]
fn gauss_agrees_with_the_references() {
    for reference in Reference::all() {
        let options = Options { integrator: Method::Gauss, ..tight(reference.intervals()) };
        let (found, summary) = run(&reference.scene(), &options);
        println!("{} {summary:?}", reference.name);
        agrees("gauss", &found, &reference);
    }
}

#[test]
fn gauss_lanes_agrees_with_the_references_in_lanes_and_out_of_them() {
    for reference in Reference::all() {
        let options = Options { integrator: Method::GaussLanes, ..tight(reference.intervals()) };
        let shipped = Options {
            kernels: nboom_routines::for_runs(),
            batches: nboom_routines::right_sides_of_eight(),
            ..options
        };
        for (told, options) in [("gauss_lanes", options), ("gauss_lanes, as shipped", shipped)] {
            let (found, summary) = run(&reference.scene(), &options);
            println!("{} {summary:?}", reference.name);
            agrees(told, &found, &reference);
        }
    }
}

/// Other operations leave other roundings: so it shows which code ran.
#[test]
fn runs_take_right_sides_where_there_are_some() {
    for reference in Reference::all() {
        let told = |kernels| {
            let options = Options { integrator: Method::Dop853, kernels, ..tight(20) };
            run(&reference.scene(), &options).0.samples
        };
        let (whole, accelerations) =
            (told(nboom_routines::for_runs()), told(nboom_routines::all()));
        assert!(whole != accelerations, "{}", reference.name);
    }
}

/// By its constants the stock's right side of a rigid body without rotors under a thrust, on eight states; but
/// nothing changes.
struct Still;

impl Routine for Still {
    const RESULT: &'static str = "right_side";
    const TOPOLOGY: &'static str = "M";
    const FORMULATION: &'static str = "articulated";
    const ASSUMPTIONS: &'static [(usize, f64)] = &[(16, 0.0), (17, 0.0), (18, 0.0)];
    const EXTERNAL: bool = true;
    const PARAMETERS: usize = 19;
    const CONSTANTS: usize = 24;
    const COORDINATES: usize = 7;
    const OUTPUTS: usize = 8;

    fn prepare<R: Real>(_: &[R], constants: &mut [R]) {
        constants.fill(R::zero());
    }

    fn evaluate<R: Real>(_: &[R], _: &[R], outputs: &mut [R]) {
        outputs.fill(R::zero());
    }

    fn evaluate_packed<I: Isa>(_: &[f64], _: &[f64], outputs: &mut [f64]) {
        outputs.fill(0.0);
    }
}

/// Right sides on eight states leave the roundings of those on one, so a wrong one shows that it runs.
#[test]
fn stages_are_computed_by_code_for_eight_states_where_there_is_some() {
    let reference = Reference::all().find(|r| r.name == "s01_rigid_body").expect("a rigid body");
    let of_thrust = |kernel: &&Kernel| kernel.result != "right_side" || kernel.external;
    let kernels: Vec<Kernel> =
        nboom_routines::for_runs().iter().filter(of_thrust).copied().collect();
    let attitude = |batches: Vec<Batch>| {
        let (kernels, batches) = (kernels.clone().leak(), batches.leak());
        let options = Options { integrator: Method::GaussLanes, kernels, batches, ..tight(20) };
        let (found, _) = run(&reference.scene(), &options);
        found.last().attitude
    };
    let (right, still) = (attitude(Vec::new()), attitude(vec![Batch::of::<Still>()]));
    assert!((right.vector - still.vector).norm() > 0.1, "{right:?} {still:?}");
}

/// The method that chooses takes stages side by side where a mode has code for eight states.
#[test]
fn stages_go_side_by_side_by_default_where_code_takes_eight_states() {
    let reference = Reference::all().find(|r| r.name == "s11_long_spin").expect("a long motion");
    let methods = |batches| {
        let kernels = nboom_routines::for_runs();
        let (_, summary) = run(&reference.scene(), &Options { kernels, batches, ..tight(20) });
        summary.integrations.iter().map(|i| i.choice.method).collect::<Vec<_>>()
    };
    assert!(methods(nboom_routines::right_sides_of_eight()).contains(&Method::GaussLanes));
    assert!(!methods(&[]).contains(&Method::GaussLanes));
}

/// Rounds of a free body that are many, but converge well, do not look slow.
#[test]
fn stages_go_side_by_side_to_the_end_of_a_smooth_motion() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/scenes/top.nml");
    let top = nboom::io::read_scene(&path).expect("a free body").scene;
    for rtol in [1e-8, 1e-9] {
        let (kernels, batches) =
            (nboom_routines::for_runs(), nboom_routines::right_sides_of_eight());
        let (_, summary) = run(&top, &Options { kernels, batches, rtol, atol: rtol, ..tight(20) });
        let methods: Vec<_> = summary.integrations.iter().map(|i| i.choice.method).collect();
        assert_eq!(methods, [Method::Dop853, Method::GaussLanes], "{rtol:e}");
    }
}

/// Generated code for one state goes on with explicit steps, closed forms and laws of a program's own take few
/// evaluations, and code whose equal wings fill registers does not go side by side.
#[test]
fn long_motions_are_left_to_the_method_for_their_code() {
    let scene = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
        nboom::io::read_scene(&path).expect("it is in the clone").scene
    };
    let (kernels, batches) = (nboom_routines::for_runs(), nboom_routines::right_sides_of_eight());
    let shipped = Options { kernels, batches, rtol: 1e-8, atol: 1e-8, ..tight(2) };
    let one_by_one = Options { batches: &[], ..shipped };
    let closed_form = Options {
        path: nboom::sim::Path::Generic,
        formulation: Some(Form::Closed(Formulation::Articulated)),
        ..shipped
    };
    let methods = |scene: &Scene, options: &Options, laws: Vec<OwnLaw>| {
        let mut simulator = Simulator::under_laws(scene, *options, laws);
        let summary = simulator.run(&mut Nobody).expect("it runs to its end");
        summary.integrations.iter().map(|i| i.choice.method).collect::<Vec<_>>()
    };
    let smooth = scene("benches/scenes/T1_smooth.nml");
    let own = || vec![OwnLaw::new(0, |beta: f64, _: f64| -0.1 * beta)];
    use Method::{Adams, Dop853, GaussLanes};
    for (options, laws, follows) in [
        (&shipped, Vec::new(), Some(GaussLanes)),
        (&one_by_one, Vec::new(), None),
        (&closed_form, Vec::new(), Some(Adams)),
        (&shipped, own(), Some(Adams)),
    ] {
        let expected: Vec<_> = [Some(Dop853), follows].into_iter().flatten().collect();
        assert_eq!(methods(&smooth, options, laws), expected, "{follows:?}");
    }
    let wings = scene("examples/solar-array.toml");
    assert!(!methods(&wings, &shipped, Vec::new()).contains(&GaussLanes));
}

#[test]
fn runs_by_power_series_agree_with_the_references() {
    for reference in Reference::all() {
        let options = Options { integrator: Method::Taylor, ..tight(reference.intervals()) };
        let (found, summary) = run(&reference.scene(), &options);
        agrees("by power series", &found, &reference);
        assert_eq!(summary.steps_rejected, 0, "{}", reference.name);
    }
}

#[test]
fn events_are_told_in_time_order_and_leave_the_expected_state() {
    for reference in Reference::all() {
        let (found, summary) = run(&reference.scene(), &tight(1));
        let times: Vec<f64> = found.events.iter().map(|(event, _)| event.time).collect();
        assert!(times.is_sorted(), "{}: {times:?}", reference.name);
        assert_eq!(summary.events, found.events.len());
        assert_eq!(summary.end_time, reference.end_time());
        for (_, after) in &found.events {
            let energy = after.kinetic_energy;
            assert!(energy.is_finite() && energy >= 0.0);
        }
    }
}

/// Momentum and energy drift like the trajectory itself, whose error at this tolerance is below
/// 2e-11 in every scene.
fn check_residuals(reference: &Reference) {
    let recursive = tight(reference.intervals());
    let shipped = Options {
        kernels: nboom_routines::for_runs(),
        batches: nboom_routines::right_sides_of_eight(),
        ..recursive
    };
    let lanes = Options { integrator: Method::GaussLanes, ..shipped };
    for options in [recursive, shipped, lanes] {
        let (_, summary) = run(&reference.scene(), &options);
        let residuals = summary.conservation;
        println!("{}, {}: {residuals:?}", reference.name, options.integrator);
        for (_, residual) in residuals.laws() {
            assert!(residual < 2e-11, "{}: {residuals:?}", reference.name);
        }
    }
}

#[test]
fn conservation_residuals_are_at_rounding_and_truncation() {
    Reference::all()
        .filter(|scene| scene.name != AT_REST)
        .for_each(|scene| check_residuals(&scene));
}

#[test]
fn conservation_residuals_of_bodies_at_rest_are_rounding() {
    check_residuals(&Reference::load(AT_REST));
}
