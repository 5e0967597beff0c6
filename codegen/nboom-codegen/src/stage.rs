//! One step of a sweep, traced and emitted as a function.

use std::collections::BTreeMap;

use nboom_expr::{Expr, Graph, Id, Node, Operations};
use nboom_formulation::stages::{Group, Stage};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::Level;
use crate::straight::{Given, Statements};

/// Which numbers of each group can be other than zero.
pub(crate) type Masks = BTreeMap<&'static str, Vec<bool>>;

/// A step traced with what is known of its parameters and inputs.
pub(crate) struct Traced {
    pub name: Ident,
    graph: Graph,
    parameters: usize,
    varies: Vec<bool>,
    constants: Vec<Id>,
    inputs: Vec<(Group, Vec<bool>)>,
    outputs: Vec<(Group, Vec<bool>)>,
}

impl Traced {
    /// Traces `stage`; `pinned` has a value for each parameter that is taken for granted, and
    /// groups that `masks` does not name can hold anything.
    pub fn new(prefix: &str, stage: &Stage<Expr>, pinned: &[Option<f64>], masks: &Masks) -> Self {
        let parameters = total(stage.parameters);
        assert_eq!(parameters, pinned.len(), "a pin or none for each parameter");
        let inputs: Vec<(Group, Vec<bool>)> =
            stage.inputs.iter().map(|&group| (group, mask_of(masks, group))).collect();
        let mut all = pinned.to_vec();
        let zero_or_open = |live: &bool| if *live { None } else { Some(0.0) };
        all.extend(inputs.iter().flat_map(|(_, mask)| mask).map(zero_or_open));
        let graph = Graph::trace_with(&all, stage.run);
        let varies = graph.depends_on(|input| input >= parameters);
        let mut ids = graph.outputs().iter();
        let outputs = stage.outputs.iter().map(|&group| {
            let live = ids.by_ref().take(group.size).map(|&id| !is_zero(&graph, id)).collect();
            (group, live)
        });
        let outputs = outputs.collect();
        let constants = constants(&graph, &varies);
        let name = format_ident!("{prefix}_{}", stage.name);
        Self { name, graph, parameters, varies, constants, inputs, outputs }
    }

    /// With sums regrouped, for a step that is taken once and that all others wait for.
    pub fn regrouped(self, level: Level) -> Self {
        if level == Level::Exact {
            return self;
        }
        let graph = self.graph.regrouped(&self.varies);
        let varies = graph.depends_on(|input| input >= self.parameters);
        Self { constants: constants(&graph, &varies), varies, graph, ..self }
    }

    /// Passes on the numbers of an output group that `mask` names, zeros among them, so that
    /// several steps hand over the same numbers.
    pub fn passing_on(mut self, group: Group, mask: &[bool]) -> Self {
        for (_, live) in self.outputs.iter_mut().filter(|(other, _)| *other == group) {
            live.copy_from_slice(mask);
        }
        self
    }

    /// Which numbers of an output group can be other than zero.
    pub fn live(&self, group: Group) -> &[bool] {
        let found = self.outputs.iter().find(|(other, _)| *other == group);
        &found.expect("the stage writes the group").1
    }

    /// How many numbers of an output group are passed on.
    pub fn size(&self, group: Group) -> usize {
        self.live(group).iter().filter(|live| **live).count()
    }

    /// Constants prepared for each set of parameters.
    pub fn constants(&self) -> usize {
        self.constants.len()
    }

    /// Operations of a call.
    pub fn operations(&self) -> Operations {
        self.graph.operations_of(|i| self.varies[i])
    }

    /// Operations of a preparation.
    pub fn preparation(&self) -> Operations {
        self.graph.operations_of(|i| !self.varies[i])
    }

    /// The function that prepares constants and the function that takes the step.
    pub fn functions(&self, level: Level) -> TokenStream {
        let (prepare, run) = (self.prepare(level), self.run(level));
        quote!(#prepare #run)
    }

    /// Name of the function that prepares constants.
    pub fn prepare_name(&self) -> Ident {
        format_ident!("{}_constants", self.name)
    }

    fn prepare(&self, level: Level) -> TokenStream {
        if self.constants.is_empty() {
            return TokenStream::new();
        }
        let wanted: Vec<bool> = self.varies.iter().map(|varies| !varies).collect();
        let given = given(&self.graph, |i| {
            let i = Literal::usize_unsuffixed(i);
            quote!(p[#i])
        });
        let statements = Statements::new(&self.graph, &wanted, &given, level);
        let lines = statements.lines(&self.graph, self.constants.iter().copied());
        let values = self.constants.iter().map(|&id| statements.read(&self.graph, id));
        let name = self.prepare_name();
        let (parameters, constants) = (
            Literal::usize_unsuffixed(self.parameters),
            Literal::usize_unsuffixed(self.constants()),
        );
        quote! {
            fn #name<R: Real>(p: &[R]) -> [R; #constants] {
                let p: &[R; #parameters] = p.try_into().expect("one value for each parameter");
                #(#lines)*
                [#(#values),*]
            }
        }
    }

    fn run(&self, level: Level) -> TokenStream {
        let mut places: BTreeMap<usize, TokenStream> = BTreeMap::new();
        let mut arguments = Vec::new();
        let mut at = self.parameters;
        for (i, (group, mask)) in self.inputs.iter().enumerate() {
            let name = format_ident!("{}_{i}", group.name);
            let live = mask.iter().enumerate().filter(|(_, live)| **live);
            for (slot, (offset, _)) in live.enumerate() {
                let slot = Literal::usize_unsuffixed(slot);
                places.insert(at + offset, quote!(#name[#slot]));
            }
            let size = Literal::usize_unsuffixed(mask.iter().filter(|live| **live).count());
            arguments.push(quote!(#name: [R; #size]));
            at += group.size;
        }
        let mut given = given(&self.graph, |i| places.get(&i).cloned().unwrap_or_default());
        for (slot, id) in self.constants.iter().enumerate() {
            let slot = Literal::usize_unsuffixed(slot);
            given.insert(id.index(), quote!(k[#slot]));
        }
        let statements = Statements::new(&self.graph, &self.varies, &given, level);
        let lines = statements.lines(&self.graph, self.graph.outputs().iter().copied());
        let mut ids = self.graph.outputs().iter();
        let groups = self.outputs.iter().map(|(group, mask)| {
            let of_group = ids.by_ref().take(group.size).zip(mask);
            let values = of_group
                .filter(|(_, live)| **live)
                .map(|(&id, _)| statements.read(&self.graph, id));
            quote!([#(#values),*])
        });
        let groups: Vec<TokenStream> = groups.collect();
        let types = self.outputs.iter().map(|(_, mask)| {
            let size = Literal::usize_unsuffixed(mask.iter().filter(|live| **live).count());
            quote!([R; #size])
        });
        let name = &self.name;
        let constants = Literal::usize_unsuffixed(self.constants());
        let constants = (!self.constants.is_empty()).then(|| quote!(k: [R; #constants],));
        quote! {
            #[inline(always)]
            fn #name<R: Real>(#constants #(#arguments),*) -> (#(#types,)*) {
                #(#lines)*
                (#(#groups,)*)
            }
        }
    }
}

fn total(groups: &[Group]) -> usize {
    groups.iter().map(|group| group.size).sum()
}

fn mask_of(masks: &Masks, group: Group) -> Vec<bool> {
    masks.get(group.name).cloned().unwrap_or_else(|| vec![true; group.size])
}

fn is_zero(graph: &Graph, id: Id) -> bool {
    matches!(graph.node(id), Node::Constant(bits) if f64::from_bits(bits) == 0.0)
}

/// Where each input that is not pinned can be read.
pub(crate) fn given(graph: &Graph, read: impl Fn(usize) -> TokenStream) -> Given {
    let input = |(id, node): (Id, Node)| match node {
        Node::Input(i) => Some((id.index(), read(i as usize))),
        _ => None,
    };
    graph.nodes().filter_map(input).collect()
}

/// Nodes that depend on parameters alone and are used by nodes that vary, or are results.
pub(crate) fn constants(graph: &Graph, varies: &[bool]) -> Vec<Id> {
    let mut needed = vec![false; varies.len()];
    for (_, node) in graph.nodes().filter(|(id, _)| varies[id.index()]) {
        for operand in node.operands().map(Id::index).filter(|&operand| !varies[operand]) {
            needed[operand] = true;
        }
    }
    for output in graph.outputs().iter().map(|id| id.index()).filter(|&output| !varies[output]) {
        needed[output] = true;
    }
    let is_literal = |node| matches!(node, Node::Constant(_));
    let wanted = graph.nodes().filter(|(id, node)| needed[id.index()] && !is_literal(*node));
    wanted.map(|(id, _)| id).collect()
}
