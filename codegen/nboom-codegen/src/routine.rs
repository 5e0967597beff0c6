//! A routine whose evaluation is one straight line.

use nboom_expr::{Graph, Node, Operations};
use nboom_formulation::{Coordinates, Layout, Parameters, articulated};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::straight::{Given, Statements};
use crate::{Level, Request};

/// Generated code and what it costs.
pub struct Generated {
    /// The items.
    pub tokens: TokenStream,
    /// Operations of one evaluation.
    pub evaluation: Operations,
    /// Operations done once for each set of parameters.
    pub preparation: Operations,
}

/// Traces the request's formulation: parameters first, then the state.
pub fn trace(request: &Request) -> Graph {
    let topology = &request.topology;
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
        articulated::solve(topology, &satellite, &state).write(topology)
    })
}

/// Code for the request.
pub fn generate(request: &Request) -> Generated {
    let graph = trace(request);
    let parameters = Layout::parameters(&request.topology);
    let varies = graph.depends_on(|input| input >= parameters);
    let constants = constants(&graph, &varies);
    let prepare = prepare(&graph, &varies, &constants, request.level);
    let evaluate = evaluate(&graph, &varies, &constants, parameters, request.level);
    let name = format_ident!("{}", request.name);
    let topology = request.topology.to_string();
    let pinned = request.pinned.iter().enumerate().filter_map(|(i, value)| {
        let (i, value) = (Literal::usize_unsuffixed(i), (*value)?);
        Some(quote!((#i, #value)))
    });
    let count = Literal::usize_unsuffixed;
    let (parameters, constants) = (count(parameters), count(constants.len()));
    let coordinates = count(Layout::coordinates(&request.topology));
    let outputs = count(graph.outputs().len());
    let tokens = quote! {
        pub struct #name;
        impl Routine for #name {
            const TOPOLOGY: &'static str = #topology;
            const FORMULATION: &'static str = "articulated";
            const PINNED: &'static [(usize, f64)] = &[#(#pinned),*];
            const PARAMETERS: usize = #parameters;
            const CONSTANTS: usize = #constants;
            const COORDINATES: usize = #coordinates;
            const OUTPUTS: usize = #outputs;
            fn prepare<R: Real>(p: &[R], k: &mut [R]) {
                let p: &[R; #parameters] = p.try_into().expect("one value for each parameter");
                let k: &mut [R; #constants] = k.try_into().expect("room for each constant");
                #prepare
            }
            #[inline(always)]
            fn evaluate<R: Real>(k: &[R], x: &[R], out: &mut [R]) {
                let k: &[R; #constants] = k.try_into().expect("one value for each constant");
                let x: &[R; #coordinates] = x.try_into().expect("one value for each coordinate");
                let out: &mut [R; #outputs] = out.try_into().expect("room for each output");
                #evaluate
            }
        }
    };
    Generated {
        tokens,
        evaluation: graph.operations_of(|i| varies[i]),
        preparation: graph.operations_of(|i| !varies[i]),
    }
}

/// Nodes that depend on parameters alone and are used by nodes that vary, or are results.
fn constants(graph: &Graph, varies: &[bool]) -> Vec<nboom_expr::Id> {
    let mut needed = vec![false; varies.len()];
    for (id, node) in graph.nodes().filter(|(id, _)| varies[id.index()]) {
        let _ = id;
        node.operands().for_each(|operand| needed[operand.index()] = !varies[operand.index()]);
    }
    graph.outputs().iter().for_each(|id| needed[id.index()] = !varies[id.index()]);
    let is_literal = |node| matches!(node, Node::Constant(_));
    graph
        .nodes()
        .filter(|(id, node)| needed[id.index()] && !is_literal(*node))
        .map(|(id, _)| id)
        .collect()
}

fn prepare(
    graph: &Graph,
    varies: &[bool],
    constants: &[nboom_expr::Id],
    level: Level,
) -> TokenStream {
    let wanted: Vec<bool> = varies.iter().map(|varies| !varies).collect();
    let given = inputs(graph, |i| {
        let i = Literal::usize_unsuffixed(i);
        quote!(p[#i])
    });
    let statements = Statements::new(graph, &wanted, &given, level);
    let lines = &statements.lines;
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
    let mut given = inputs(graph, |i| {
        let i = Literal::usize_unsuffixed(i.wrapping_sub(parameters));
        quote!(x[#i])
    });
    for (slot, id) in constants.iter().enumerate() {
        let slot = Literal::usize_unsuffixed(slot);
        given.insert(id.index(), quote!(k[#slot]));
    }
    let statements = Statements::new(graph, varies, &given, level);
    let lines = &statements.lines;
    let writes = graph.outputs().iter().enumerate().map(|(slot, &id)| {
        let (slot, value) = (Literal::usize_unsuffixed(slot), statements.read(graph, id));
        quote!(out[#slot] = #value;)
    });
    quote!(#(#lines)* #(#writes)*)
}

fn inputs(graph: &Graph, read: impl Fn(usize) -> TokenStream) -> Given {
    let input = |(id, node): (nboom_expr::Id, Node)| match node {
        Node::Input(i) => Some((id.index(), read(i as usize))),
        _ => None,
    };
    graph.nodes().filter_map(input).collect()
}
