//! The graph that a formulation leaves, interpreted, against the formulation itself on `f64`: bit
//! for bit, but for the sign of zeros, on random satellites.

#[path = "../../../../tests/support/random.rs"]
mod random;
mod satellite;

use std::collections::BTreeSet;

use nboom_codegen::{Level, Output, Request, trace};
use nboom_formulation::{
    Coordinates, Equations, Forces, Formulation, Layout, Motion, Parameters, inverse_dynamics,
    right_side,
};

use satellite::Satellite;

/// Random satellites for each formulation.
const SATELLITES: u64 = 2000;

/// What the formulation computes.
fn closed_form(request: &Request, parameters: &[f64], state: &[f64]) -> Vec<f64> {
    let Request { topology, formulation, output, .. } = request;
    let (of_satellite, of_forces) = parameters.split_at(Layout::parameters(topology));
    let main_is_held = of_satellite[..Layout::MAIN] == Layout::held_main();
    let satellite = Parameters::read(topology, of_satellite.iter().copied());
    let satellite = Parameters { main_is_held, ..satellite };
    let coordinates = || Coordinates::read(topology, state);
    match output {
        Output::Accelerations => {
            formulation.solve(topology, &satellite, &coordinates()).write(topology)
        }
        Output::Equations => {
            let found = formulation.equations(topology, &satellite, &coordinates());
            let Equations { matrix, forcing } = found.expect("it has equations");
            [matrix, forcing].concat()
        }
        Output::InverseDynamics => {
            let motion = Motion::read(topology, state);
            inverse_dynamics(topology, &satellite, &motion).write(topology)
        }
        Output::RightSide => {
            let forces = Forces::read(topology.hinges(), of_forces.iter().copied());
            right_side(*formulation, topology, &satellite, &forces, state)
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
    if !request.external && request.output != Output::RightSide {
        inputs[parameters.len() + 3..parameters.len() + 9].fill(f64::NAN);
    }
    inputs
}

fn assert_recorded(seed: u64, request: &Request, parameters: &[f64], states: &[Vec<f64>]) {
    let graph = trace(request);
    for state in states {
        let expected = closed_form(request, parameters, state);
        let found = graph.evaluate(&inputs(request, parameters, state));
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

/// The request for a right side, with what is assumed of the forces.
fn right_side_of(request: &Request, satellite: &Satellite) -> Request {
    let mut request = request.clone().for_right_side();
    let topology = &request.topology;
    let of_forces = &mut request.assumptions[Layout::parameters(topology)..];
    // Where nothing is assumed, it stays that no line pushes if none does.
    if satellite.pushed_or_known() {
        of_forces.copy_from_slice(&satellite.force_assumptions);
    }
    request
}

fn assert_all_recorded(formulation: Formulation) {
    for seed in 0..SATELLITES {
        let satellite = Satellite::random(seed);
        let Satellite { topology, assumptions, external, parameters, states, .. } =
            satellite.clone();
        if !formulation.takes(&topology) {
            continue;
        }
        let request = Request::new("Random", topology, Level::Exact).by(formulation);
        let request = Request { assumptions, external, ..request };
        assert_recorded(seed, &request, &parameters, &states);
        let right_side = right_side_of(&request, &satellite);
        let all = [&parameters[..], &satellite.forces].concat();
        assert_recorded(seed, &right_side, &all, &satellite.variables);
        if formulation.has_equations() {
            assert_recorded(seed, &request.for_equations(), &parameters, &states);
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
fn inverse_dynamics_is_recorded_as_it_computes() {
    for seed in 0..SATELLITES {
        let Satellite { topology, assumptions, parameters, mut states, .. } =
            Satellite::random(seed);
        // Accelerations of the main body are there whether something acts from outside or not.
        states.iter_mut().for_each(|state| state[3..9].fill(0.5 + seed as f64));
        let request = Request::new("Random", topology, Level::Exact).for_inverse_dynamics();
        let request = Request { assumptions, ..request };
        assert_recorded(seed, &request, &parameters, &states);
    }
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
        |s: &Satellite| s.topology.has_limbs(),
        Satellite::is_on_a_rig,
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
