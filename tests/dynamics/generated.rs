//! What code is generated from, on a thousand random trees: graphs as they are emitted, interpreted, against the
//! recursion. Nothing that a graph assumes can be used, for it is NaN.

use nboom::formulation::{Formulation, Layout, Motion, Recognised};
use nboom_codegen::{Level, Request, trace};

use crate::inverse::{assert_drives, motion};
use crate::limbs;
use crate::satellites::Satellite;
use crate::support::relative_error;

const TREES: u64 = 1000;

/// Nothing, all zeros and ones, or all numbers assumed.
fn request(recognised: &Recognised, seed: u64) -> Request {
    let Recognised { topology, parameters, .. } = recognised;
    let request = Request::new("Tree", topology.clone(), Level::Fast).with_external_wrench();
    let assumed = |value: f64| match seed % 3 {
        0 => None,
        1 => (value == 0.0 || value.abs() == 1.0).then_some(value),
        _ => Some(value),
    };
    let assumptions = parameters.write().into_iter().map(assumed).collect();
    Request { assumptions, ..request }
}

/// The graph of a routine, sums regrouped as at level `fast`, at a state.
fn evaluate(request: &Request, recognised: &Recognised, state: &[f64]) -> Vec<f64> {
    let parameters = recognised.parameters.write();
    let graph = trace(request);
    let graph = graph.regrouped(&graph.depends_on(|input| input >= parameters.len()));
    let assumed = |(value, assumed): (f64, &Option<f64>)| assumed.map_or(value, |_| f64::NAN);
    let mut inputs: Vec<f64> =
        parameters.into_iter().zip(&request.assumptions).map(assumed).collect();
    inputs.extend(state);
    graph.evaluate(&inputs)
}

/// Accelerations by the recursion, in the order in which a graph has them.
fn expected(satellite: &Satellite, recognised: &Recognised) -> Vec<f64> {
    let of_recursion = satellite.expected(&recognised.links);
    let mut expected = [&of_recursion[3..6], &of_recursion[..3]].concat();
    expected.resize(of_recursion.len(), 0.0);
    for (i, place) in Layout::places(&recognised.topology).into_iter().enumerate() {
        expected[Layout::OUTPUT + place] = of_recursion[6 + i];
    }
    expected
}

#[test]
fn graphs_of_trees_on_a_rig_accelerate_as_the_recursion_says() {
    let (mut shorter, mut all) = (0, 0);
    for seed in 0..TREES {
        let satellite = limbs::satellite_on_a_rig(seed);
        let recognised = satellite.recognised();
        let topology = &recognised.topology;
        let state = satellite.coordinates_of(&recognised).write(topology);
        let expected = expected(&satellite, &recognised);
        let free = request(&recognised, seed);
        let held = free.clone().with_held_main_body();
        let found = evaluate(&held, &recognised, &state);
        let error = relative_error(&found, &expected, 0.0);
        assert!(error < satellite.allowed(), "seed {seed}, {topology}: {error:e}");
        let [of_held, of_free] = [held, free].map(|request| trace(&request).operations().flops());
        (shorter, all) = (shorter + of_held, all + of_free);
    }
    // Of a main body with six unknowns some 300 operations are gone, of each tree what it shows at O.
    assert!(4 * shorter < 3 * all, "{shorter} of {all}");
}

#[test]
fn graphs_of_trees_accelerate_as_the_recursion_says() {
    for seed in 0..TREES {
        let satellite = limbs::satellite(seed);
        let recognised = satellite.recognised();
        let topology = &recognised.topology;
        let state = satellite.coordinates_of(&recognised).write(topology);
        let expected = expected(&satellite, &recognised);
        for formulation in [Formulation::Articulated, Formulation::Symmetric] {
            let request = request(&recognised, seed).by(formulation);
            let found = evaluate(&request, &recognised, &state);
            let error = relative_error(&found, &expected, 0.0);
            let allowed = satellite.allowed();
            assert!(error < allowed, "seed {seed}, {topology}, {formulation}: {error:e}");
        }
    }
}

#[test]
fn graphs_of_trees_give_back_what_acts() {
    for seed in 0..TREES {
        let satellite: Satellite = limbs::satellite(seed);
        let recognised = satellite.recognised();
        let topology = &recognised.topology;
        let motion: Motion<f64> = motion(&satellite, &recognised);
        let request = request(&recognised, seed).for_inverse_dynamics();
        let found = evaluate(&request, &recognised, &motion.write(topology));
        let mut drive = [&found[3..6], &found[..3]].concat();
        let places = Layout::places(topology).into_iter();
        drive.extend(places.map(|place| found[Layout::OUTPUT + place]));
        assert_drives(&satellite, &recognised, &drive, &format!("seed {seed}, {topology}"));
    }
}
