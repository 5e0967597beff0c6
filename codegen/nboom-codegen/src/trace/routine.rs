use nboom_expr::Graph;
use nboom_formulation::{Coordinates, Equations, Layout, Parameters};

use crate::request::{Output, Request};

/// Traces the request's formulation: parameters first, then the state.
///
/// # Panics
/// When equations are asked of a formulation that forms none.
pub fn trace(request: &Request) -> Graph {
    let Request { topology, formulation, output, .. } = request;
    let parameters = Layout::parameters(topology);
    let mut inputs = request.assumptions.clone();
    inputs.resize(parameters + Layout::coordinates(topology), None);
    if !request.external {
        inputs[parameters + 3..parameters + 9].fill(Some(0.0));
    }
    Graph::trace_with(&inputs, |inputs| {
        let (of_satellite, of_state) = inputs.split_at(parameters);
        let satellite = Parameters::read(topology, of_satellite.iter().copied());
        let state = Coordinates::read(topology, of_state);
        match output {
            Output::Accelerations => {
                formulation.solve(topology, &satellite, &state).write(topology)
            }
            Output::Equations => {
                let found = formulation.equations(topology, &satellite, &state);
                let Equations { mut matrix, forcing } = found.expect("the request was checked");
                matrix.extend(forcing);
                matrix
            }
        }
    })
}
