//! The graph that a formulation leaves, interpreted, against the formulation itself on `f64`: bit
//! for bit, but for the sign of zeros, on random satellites.

#[path = "../../../../tests/support/random.rs"]
mod random;
mod satellite;

use std::collections::BTreeSet;

use nboom_codegen::{Level, Output, Request, trace};
use nboom_formulation::{Coordinates, Equations, Formulation, Parameters};

use satellite::Satellite;

/// Random satellites for each formulation.
const SATELLITES: u64 = 2000;

/// What the formulation computes.
fn closed_form(request: &Request, parameters: &[f64], state: &[f64]) -> Vec<f64> {
    let Request { topology, formulation, output, .. } = request;
    let satellite = Parameters::read(topology, parameters.iter().copied());
    let state = Coordinates::read(topology, state);
    match output {
        Output::Accelerations => formulation.solve(topology, &satellite, &state).write(topology),
        Output::Equations => {
            let found = formulation.equations(topology, &satellite, &state);
            let Equations { matrix, forcing } = found.expect("it has equations");
            [matrix, forcing].concat()
        }
    }
}

/// Inputs of the graph, with nothing that can be used where something is assumed.
fn inputs(request: &Request, parameters: &[f64], state: &[f64]) -> Vec<f64> {
    let assumed = |(&number, value): (&f64, &Option<f64>)| match value {
        Some(_) => f64::NAN,
        None => number,
    };
    let mut inputs: Vec<f64> = parameters.iter().zip(&request.assumptions).map(assumed).collect();
    inputs.extend(state);
    if !request.external {
        inputs[parameters.len() + 3..parameters.len() + 9].fill(f64::NAN);
    }
    inputs
}

fn assert_recorded(seed: u64, request: &Request, satellite: &Satellite) {
    let graph = trace(request);
    for state in &satellite.states {
        let expected = closed_form(request, &satellite.parameters, state);
        let found = graph.evaluate(&inputs(request, &satellite.parameters, state));
        let same = expected.iter().all(|number| number.is_finite()) && found == expected;
        let Request { topology, formulation, output, external, .. } = request;
        let assumptions = request.assumptions.iter().flatten().count();
        assert!(
            same,
            "satellite {seed}: {topology}, {} by {formulation}, {assumptions} assumptions, external wrench \
             {external}:\n{found:?} found,\n{expected:?} expected",
            output.name()
        );
    }
}

fn assert_all_recorded(formulation: Formulation) {
    for seed in 0..SATELLITES {
        let satellite = Satellite::random(seed);
        let Satellite { topology, assumptions, external, .. } = satellite.clone();
        let request = Request::new("Random", topology, Level::Exact).by(formulation);
        let request = Request { assumptions, external, ..request };
        assert_recorded(seed, &request, &satellite);
        if formulation.has_equations() {
            assert_recorded(seed, &request.for_equations(), &satellite);
        }
    }
}

#[test]
fn report_is_recorded_as_it_computes() {
    assert_all_recorded(Formulation::Report);
}

#[test]
fn relative_is_recorded_as_it_computes() {
    assert_all_recorded(Formulation::Relative);
}

#[test]
fn symmetric_is_recorded_as_it_computes() {
    assert_all_recorded(Formulation::Symmetric);
}

#[test]
fn articulated_is_recorded_as_it_computes() {
    assert_all_recorded(Formulation::Articulated);
}

#[test]
fn momentum_is_recorded_as_it_computes() {
    assert_all_recorded(Formulation::Momentum);
}

#[test]
fn the_satellites_are_of_all_kinds() {
    let all: Vec<Satellite> = (0..SATELLITES).map(Satellite::random).collect();
    let with = |holds: &dyn Fn(&Satellite) -> bool| all.iter().filter(|s| holds(s)).count();
    let topologies: BTreeSet<_> = all.iter().map(|satellite| &satellite.topology).collect();
    assert!(topologies.len() > 250, "{}", topologies.len());
    assert!(with(&|s| s.topology.hinges() > 20) > 10);
    assert!(with(&|s| s.topology.hinges() == 0) > 10);
    for holds in [
        |s: &Satellite| s.external,
        |s: &Satellite| s.assumptions.iter().all(Option::is_none),
        |s: &Satellite| s.assumptions.iter().all(Option::is_some),
        |s: &Satellite| s.assumptions.contains(&None) && s.assumptions.contains(&Some(0.0)),
        |s: &Satellite| s.assumptions.iter().flatten().any(|value| value.abs() > 1.5),
        |s: &Satellite| s.held > 0 && skew_links(s) > 0,
    ] {
        let count = with(&holds);
        assert!(count > SATELLITES as usize / 10 && count < SATELLITES as usize, "{count}");
    }
}

/// Links whose mass centre is not on the η axis, or whose inertia is not along the link's axes.
fn skew_links(satellite: &Satellite) -> usize {
    let parameters = Parameters::read(&satellite.topology, satellite.parameters.iter().copied());
    let links = parameters.branches.iter().flat_map(|branch| &branch.links);
    let skew = |inertia: &nboom_scalar::RigidInertia<f64>| {
        inertia.first_moment.z != 0.0 && inertia.about_origin.xy != 0.0
    };
    links.filter(|link| skew(&link.inertia)).count()
}
