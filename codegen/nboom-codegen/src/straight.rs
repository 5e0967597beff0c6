//! Straight-line code from a graph.

use std::collections::BTreeMap;

use nboom_expr::{Graph, Id, Node};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::Level;
use crate::blocks::{Line, in_blocks};

/// Where the value of a node that other code computes can be read.
pub(crate) type Given = BTreeMap<usize, TokenStream>;

/// Statements for the nodes in `wanted`, operands first, and how to read any node afterwards.
pub(crate) struct Statements {
    lines: Vec<Line>,
    names: BTreeMap<usize, TokenStream>,
}

impl Statements {
    /// Code for the nodes for which `wanted` holds; the others that they use are in `given`.
    pub fn new(graph: &Graph, wanted: &[bool], given: &Given, level: Level) -> Self {
        let mut statements = Self { lines: Vec::new(), names: given.clone() };
        let fused = match level {
            Level::Exact => vec![None; wanted.len()],
            Level::Fast => fusions(graph, wanted),
        };
        let angles = angles(graph, wanted);
        let early = feeding(graph, &angles, wanted);
        let in_order = |early_ones: bool| {
            let early = &early;
            graph
                .nodes()
                .filter(move |(id, _)| wanted[id.index()] && early[id.index()] == early_ones)
        };
        for (id, node) in in_order(true) {
            statements.push(graph, id, node, &fused);
        }
        statements.push_angles(&angles);
        for (id, node) in in_order(false) {
            statements.push(graph, id, node, &fused);
        }
        statements
    }

    /// The statements, after which `results` can be read.
    pub fn lines(&self, graph: &Graph, results: impl IntoIterator<Item = Id>) -> Vec<TokenStream> {
        let results = results.into_iter().map(|id| self.read(graph, id));
        in_blocks(&self.lines, &results.collect::<Vec<_>>())
    }

    /// An expression that reads node `id`.
    pub fn read(&self, graph: &Graph, id: Id) -> TokenStream {
        match graph.node(id) {
            Node::Constant(bits) => constant(f64::from_bits(bits)),
            _ => self.names[&id.index()].clone(),
        }
    }

    fn push(&mut self, graph: &Graph, id: Id, node: Node, fused: &[Option<Fusion>]) {
        if self.names.contains_key(&id.index()) {
            return;
        }
        let read = |id: Id| self.read(graph, id);
        let value = match (node, fused[id.index()]) {
            (_, Some(Fusion::Inside)) => return,
            (_, Some(Fusion::Outside { negative, a, b, term })) => {
                let (a, b, term) = (read(a), read(b), read(term));
                if negative {
                    quote!((-#a).mul_add(#b, #term))
                } else {
                    quote!(#a.mul_add(#b, #term))
                }
            }
            (_, Some(Fusion::Less { a, b, term })) => {
                let (a, b, term) = (read(a), read(b), read(term));
                quote!(#a.mul_add(#b, -#term))
            }
            (Node::Input(_) | Node::Constant(_), _) => return,
            (Node::Add(a, b), _) => binary(read(a), quote!(+), read(b)),
            (Node::Sub(a, b), _) => binary(read(a), quote!(-), read(b)),
            (Node::Mul(a, b), _) => binary(read(a), quote!(*), read(b)),
            (Node::Div(a, b), _) => binary(read(a), quote!(/), read(b)),
            (Node::Neg(a), _) => {
                let a = read(a);
                quote!(-#a)
            }
            (Node::Sqrt(a), _) => {
                let a = read(a);
                quote!(#a.sqrt())
            }
            (Node::Sin(a), _) => {
                let name = format_ident!("s{}", a.index());
                self.names.insert(id.index(), quote!(#name));
                return;
            }
            (Node::Cos(a), _) => {
                let name = format_ident!("c{}", a.index());
                self.names.insert(id.index(), quote!(#name));
                return;
            }
        };
        let name = format_ident!("t{}", id.index());
        self.lines.push(Line::Value { name: name.clone(), value });
        self.names.insert(id.index(), quote!(#name));
    }

    fn push_angles(&mut self, angles: &[Id]) {
        if angles.is_empty() {
            return;
        }
        let pairs = angles.iter().map(|angle| {
            let (s, c) = (format_ident!("s{}", angle.index()), format_ident!("c{}", angle.index()));
            quote!((#s, #c))
        });
        let values = angles.iter().map(|angle| &self.names[&angle.index()]);
        let line = quote!(let [#(#pairs),*] = R::sin_cos_all([#(#values),*]););
        self.lines.push(Line::Other(line));
    }
}

fn binary(a: TokenStream, operator: TokenStream, b: TokenStream) -> TokenStream {
    quote!(#a #operator #b)
}

/// A constant as the shortest literal that reads back the same.
pub(crate) fn constant(value: f64) -> TokenStream {
    let literal = Literal::f64_suffixed(value.abs());
    if value < 0.0 { quote!(R::constant(-#literal)) } else { quote!(R::constant(#literal)) }
}

/// The angles whose sine or cosine is wanted.
fn angles(graph: &Graph, wanted: &[bool]) -> Vec<Id> {
    let mut angles = Vec::new();
    for (_, node) in graph.nodes().filter(|(id, _)| wanted[id.index()]) {
        if let Node::Sin(angle) | Node::Cos(angle) = node
            && !angles.contains(&angle)
        {
            angles.push(angle);
        }
    }
    angles
}

/// The wanted nodes that the angles are computed from.
fn feeding(graph: &Graph, angles: &[Id], wanted: &[bool]) -> Vec<bool> {
    let mut feeding = vec![false; wanted.len()];
    angles.iter().for_each(|id| feeding[id.index()] = true);
    for i in (0..wanted.len()).rev() {
        if feeding[i] && wanted[i] {
            let id = graph.nodes().nth(i).map(|(_, node)| node);
            id.into_iter().flat_map(Node::operands).for_each(|o| feeding[o.index()] = true);
        }
    }
    feeding
}

/// A product and the sum it goes into, taken together.
#[derive(Clone, Copy)]
enum Fusion {
    /// The product: part of another node.
    Inside,
    /// term ± a b
    Outside { negative: bool, a: Id, b: Id, term: Id },
    /// a b − term
    Less { a: Id, b: Id, term: Id },
}

fn fusions(graph: &Graph, wanted: &[bool]) -> Vec<Option<Fusion>> {
    let uses = graph.uses();
    let mut fused: Vec<Option<Fusion>> = vec![None; wanted.len()];
    let product = |id: Id, fused: &[Option<Fusion>]| match graph.node(id) {
        Node::Mul(a, b)
            if uses[id.index()] == 1 && wanted[id.index()] && fused[id.index()].is_none() =>
        {
            Some((a, b))
        }
        _ => None,
    };
    for (id, node) in graph.nodes().filter(|(id, _)| wanted[id.index()]) {
        let (fusion, inside) = match node {
            Node::Add(x, y) => match (product(x, &fused), product(y, &fused)) {
                (_, Some((a, b))) => (Fusion::Outside { negative: false, a, b, term: x }, y),
                (Some((a, b)), None) => (Fusion::Outside { negative: false, a, b, term: y }, x),
                (None, None) => continue,
            },
            Node::Sub(x, y) => match (product(x, &fused), product(y, &fused)) {
                (_, Some((a, b))) => (Fusion::Outside { negative: true, a, b, term: x }, y),
                (Some((a, b)), None) => (Fusion::Less { a, b, term: y }, x),
                (None, None) => continue,
            },
            _ => continue,
        };
        fused[inside.index()] = Some(Fusion::Inside);
        fused[id.index()] = Some(fusion);
    }
    fused
}
