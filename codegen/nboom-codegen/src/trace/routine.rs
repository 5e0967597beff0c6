use nboom_expr::Graph;
use nboom_formulation::{
    Coordinates, Equations, Forces, Layout, Motion, Parameters, inverse_dynamics, right_side,
};

use crate::request::{Output, Request};

/// Traces the request's formulation: parameters first, then the state.
///
/// # Panics
/// When equations are asked of a formulation that forms none.
pub fn trace(request: &Request) -> Graph {
    let Request { topology, formulation, output, .. } = request;
    let parameters = request.assumptions.len();
    let mut inputs = request.assumptions.clone();
    inputs.resize(parameters + output.coordinates(topology), None);
    if !request.external && *output != Output::RightSide {
        inputs[parameters + 3..parameters + 9].fill(Some(0.0));
    }
    Graph::trace_with(&inputs, |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        let (of_satellite, of_forces) = parameters.split_at(Layout::parameters(topology));
        let satellite = Parameters {
            main_is_held: request.holds_main_body(),
            ..Parameters::read(topology, of_satellite.iter().copied())
        };
        match output {
            Output::Accelerations => {
                let state = Coordinates::read(topology, state);
                formulation.solve(topology, &satellite, &state).write(topology)
            }
            Output::Equations => {
                let state = Coordinates::read(topology, state);
                let found = formulation.equations(topology, &satellite, &state);
                let Equations { mut matrix, forcing } = found.expect("the request was checked");
                matrix.extend(forcing);
                matrix
            }
            Output::InverseDynamics => {
                let motion = Motion::read(topology, state);
                inverse_dynamics(topology, &satellite, &motion).write(topology)
            }
            Output::RightSide => {
                let mut forces = Forces::read(topology.hinges(), of_forces.iter().copied());
                if !request.has_lines() {
                    forces.lines.clear();
                }
                if !request.has_couplings() {
                    forces.couplings.clear();
                }
                right_side(*formulation, topology, &satellite, &forces, state)
            }
        }
    })
}
