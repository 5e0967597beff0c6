//! Sums in another order, so that no term waits for one that comes later.

use std::cmp::Reverse;

use crate::fold;
use crate::graph::{Builder, Graph, Id, Node};

/// Cycles from operands to result, about those of processors of these years. Their ratios
/// decide how terms are grouped.
mod latency {
    pub const SUM: u32 = 3;
    pub const PRODUCT: u32 = 4;
    /// A product taken together with the sum it goes into.
    pub const FUSED: u32 = 4;
    pub const QUOTIENT: u32 = 13;
    pub const ROOT: u32 = 18;
    pub const SINE: u32 = 60;
}

/// A term of a sum.
#[derive(Clone, Copy)]
struct Term {
    id: Id,
    negative: bool,
    /// When it can go into a sum: a product that is used nowhere else goes in with its factors.
    ready: u32,
    product: bool,
}

/// A graph under construction, and when each of its nodes is ready.
struct Timed {
    builder: Builder,
    ready: Vec<u32>,
}

impl Graph {
    /// Regroups sums: of all terms of a sum the two that are ready first are added first. Nodes for
    /// which `varies` does not hold are ready from the start.
    ///
    /// A sum that is used more than once stays one node. Results differ by rounding.
    pub fn regrouped(&self, varies: &[bool]) -> Self {
        let (uses, inside) = (self.uses(), self.inside_sums(varies));
        let mut timed = Timed { builder: Builder::remarked_as(&self.remarks), ready: Vec::new() };
        let mut new: Vec<Id> = Vec::with_capacity(self.nodes.len());
        for (i, &node) in self.nodes.iter().enumerate() {
            timed.builder.remarked = self.remarks.before[i];
            if inside[i] {
                // Its terms go into the sum that uses it.
                new.push(Id(u32::MAX));
                continue;
            }
            let (id, ready) = match node {
                Node::Add(..) | Node::Sub(..) => {
                    let term = |id: Id, negative| {
                        let product = uses[id.index()] == 1
                            && varies[id.index()]
                            && matches!(self.node(id), Node::Mul(..));
                        timed.term(new[id.index()], negative, product)
                    };
                    let terms = self.terms(i, &inside).into_iter();
                    let terms = terms.map(|(id, negative)| term(id, negative)).collect();
                    timed.sum(terms)
                }
                _ => timed.node(node, &new),
            };
            timed.note(id, if varies[i] { ready } else { 0 });
            new.push(id);
        }
        let outputs = self.outputs.iter().map(|id| new[id.index()]).collect();
        timed.builder.finish(self.inputs, outputs)
    }

    /// Sums that one other sum uses and nothing else.
    fn inside_sums(&self, varies: &[bool]) -> Vec<bool> {
        let is_sum = |id: Id| matches!(self.node(id), Node::Add(..) | Node::Sub(..));
        let uses = self.uses();
        let mut inside = vec![false; self.nodes.len()];
        for (id, node) in self.nodes().filter(|&(id, _)| is_sum(id)) {
            for of in node.operands().filter(|&of| is_sum(of) && uses[of.index()] == 1) {
                inside[of.index()] = varies[of.index()] == varies[id.index()];
            }
        }
        inside
    }

    /// The terms of the sum at `root`, and whether each is taken away.
    fn terms(&self, root: usize, inside: &[bool]) -> Vec<(Id, bool)> {
        let mut open = vec![(Id(root as u32), false)];
        let mut terms = Vec::new();
        while let Some((id, negative)) = open.pop() {
            match self.node(id) {
                Node::Add(a, b) if id.index() == root || inside[id.index()] => {
                    open.extend([(b, negative), (a, negative)]);
                }
                Node::Sub(a, b) if id.index() == root || inside[id.index()] => {
                    open.extend([(b, !negative), (a, negative)]);
                }
                _ => terms.push((id, negative)),
            }
        }
        terms
    }
}

impl Timed {
    fn note(&mut self, id: Id, ready: u32) {
        if self.ready.len() <= id.index() {
            self.ready.resize(id.index() + 1, 0);
        }
        self.ready[id.index()] = self.ready[id.index()].max(ready);
    }

    /// Adds a node that is no sum; operands are found in `new`.
    fn node(&mut self, node: Node, new: &[Id]) -> (Id, u32) {
        let operands = node.operands().map(|id| self.ready[new[id.index()].index()]);
        let start = operands.max().unwrap_or(0);
        let of = |id: Id| new[id.index()];
        let builder = &mut self.builder;
        let (id, latency) = match node {
            Node::Mul(a, b) => (fold::mul(builder, of(a), of(b)), latency::PRODUCT),
            Node::Div(a, b) => (fold::div(builder, of(a), of(b)), latency::QUOTIENT),
            Node::Sqrt(a) => (fold::sqrt(builder, of(a)), latency::ROOT),
            Node::Sin(a) => (fold::sin_cos(builder, of(a)).0, latency::SINE),
            Node::Cos(a) => (fold::sin_cos(builder, of(a)).1, latency::SINE),
            Node::Neg(a) => (fold::neg(builder, of(a)), 0),
            Node::Add(a, b) => (fold::add(builder, of(a), of(b)), latency::SUM),
            Node::Sub(a, b) => (fold::sub(builder, of(a), of(b)), latency::SUM),
            Node::Input(_) | Node::Constant(_) => (builder.intern(node), 0),
        };
        (id, start + latency)
    }

    fn term(&self, id: Id, negative: bool, product: bool) -> Term {
        let ready = self.ready[id.index()];
        let ready = if product { ready.saturating_sub(latency::PRODUCT) } else { ready };
        Term { id, negative, ready, product }
    }

    fn sum(&mut self, mut terms: Vec<Term>) -> (Id, u32) {
        while terms.len() > 1 {
            terms.sort_by_key(|term| (Reverse(term.ready), term.product));
            let pair = [terms.pop(), terms.pop()].map(|term| term.expect("there are two"));
            terms.push(self.pair(pair));
        }
        let Term { id, negative, ready, .. } = terms[0];
        (if negative { fold::neg(&mut self.builder, id) } else { id }, ready)
    }

    fn pair(&mut self, [a, b]: [Term; 2]) -> Term {
        let ready = match (a.product, b.product) {
            (false, false) => a.ready.max(b.ready) + latency::SUM,
            (true, true) => (a.ready + latency::PRODUCT).max(b.ready) + latency::FUSED,
            _ => a.ready.max(b.ready) + latency::FUSED,
        };
        let builder = &mut self.builder;
        let (id, negative) = match (a.negative, b.negative) {
            (true, true) => (fold::add(builder, a.id, b.id), true),
            (false, false) => (fold::add(builder, a.id, b.id), false),
            (false, true) => (fold::sub(builder, a.id, b.id), false),
            (true, false) => (fold::sub(builder, b.id, a.id), false),
        };
        self.note(id, ready);
        Term { id, negative, ready, product: false }
    }
}
