//! A routine whose evaluation is one straight line.

use nboom_expr::Graph;
use nboom_formulation::{Coordinates, Equations, Layout, Parameters};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::item::{Item, Signature};
use crate::stage::{constants, given};
use crate::straight::Statements;
use crate::{Generated, Level, Output, Request};

/// Traces the request's formulation: parameters first, then the state.
///
/// # Panics
/// When equations are asked of a formulation that forms none.
pub fn trace(request: &Request) -> Graph {
    let Request { topology, formulation, output, .. } = request;
    let parameters = Layout::parameters(topology);
    let mut pinned = request.pinned.clone();
    pinned.resize(parameters + Layout::coordinates(topology), None);
    if !request.external {
        pinned[parameters + 3..parameters + 9].fill(Some(0.0));
    }
    Graph::trace_with(&pinned, |inputs| {
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

/// Code for the request.
pub(crate) fn generate(request: &Request) -> Generated {
    straight(trace(request), request.level, &Signature::of(request))
}

/// Code for a graph: parameters are its first inputs, coordinates the others.
pub(crate) fn straight(graph: Graph, level: Level, signature: &Signature) -> Generated {
    let parameters = signature.pinned.len();
    let of_state = |input| input >= parameters;
    let graph = match level {
        Level::Exact => graph,
        Level::Fast => graph.regrouped(&graph.depends_on(of_state)),
    };
    let varies = graph.depends_on(of_state);
    let constants = constants(&graph, &varies);
    let prepare = prepare(&graph, &varies, &constants, level);
    let evaluate = evaluate(&graph, &varies, &constants, parameters, level);
    let tokens = Item {
        signature,
        constants: constants.len(),
        prepare,
        evaluate: quote!(Self::evaluate_on::<R, R>(k, x, out);),
        evaluate_packed: quote!(Self::evaluate_on::<f64, I::One>(k, x, out);),
        functions: quote! {
            #[inline(always)]
            fn evaluate_on<S: Copy, R: Pack<S>>(k: &[S], x: &[S], out: &mut [S]) {
                #evaluate
            }
        },
    }
    .tokens();
    Generated {
        tokens,
        evaluation: graph.operations_of(|i| varies[i]),
        preparation: graph.operations_of(|i| !varies[i]),
    }
}

fn prepare(
    graph: &Graph,
    varies: &[bool],
    constants: &[nboom_expr::Id],
    level: Level,
) -> TokenStream {
    let wanted: Vec<bool> = varies.iter().map(|varies| !varies).collect();
    let given = given(graph, |i| {
        let i = Literal::usize_unsuffixed(i);
        quote!(p[#i])
    });
    let statements = Statements::new(graph, &wanted, &given, level);
    let lines = statements.lines(graph, constants.iter().copied());
    let writes = constants.iter().enumerate().map(|(slot, &id)| {
        let (slot, value) = (Literal::usize_unsuffixed(slot), statements.read(graph, id));
        quote!(k[#slot] = #value;)
    });
    quote!(#(#lines)* #(#writes)*)
}

fn evaluate(
    graph: &Graph,
    varies: &[bool],
    constants: &[nboom_expr::Id],
    parameters: usize,
    level: Level,
) -> TokenStream {
    let mut given = given(graph, |i| {
        let i = Literal::usize_unsuffixed(i.wrapping_sub(parameters));
        quote!(R::gather(x, #i))
    });
    for (slot, id) in constants.iter().enumerate() {
        let slot = Literal::usize_unsuffixed(slot);
        given.insert(id.index(), quote!(R::gather(k, #slot)));
    }
    let statements = Statements::new(graph, varies, &given, level);
    let lines = statements.lines(graph, graph.outputs().iter().copied());
    let writes = graph.outputs().iter().enumerate().map(|(slot, &id)| {
        let (slot, value) = (Literal::usize_unsuffixed(slot), statements.read(graph, id));
        quote!(R::scatter(#value, out, #slot);)
    });
    quote!(#(#lines)* #(#writes)*)
}
