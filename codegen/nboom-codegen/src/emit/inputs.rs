//! What code reads: numbers that stand in arrays, each bound once to a name.

use std::collections::{BTreeMap, BTreeSet};

use nboom_expr::{Graph, Node};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::text::LINE;

/// How an array is read.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// Its numbers are scalars of the code.
    Direct,
    /// Scalars of the code gather them.
    Gathered,
}

/// An array that code reads.
struct Source {
    name: Ident,
    size: usize,
    reading: Reading,
}

/// Where a node's value stands, and what it is called.
struct Input {
    source: usize,
    slot: usize,
    name: String,
}

/// All that code reads, and what of it is bound.
#[derive(Default)]
pub(crate) struct Inputs {
    sources: Vec<Source>,
    /// By the number of the node.
    inputs: BTreeMap<usize, Input>,
    bound: BTreeSet<usize>,
    names: BTreeSet<String>,
}

impl Inputs {
    /// Adds an array and the nodes whose values are in it, each with its slot and its name.
    pub fn add(
        &mut self,
        name: &str,
        size: usize,
        reading: Reading,
        nodes: impl IntoIterator<Item = (usize, usize, String)>,
    ) {
        let source = self.sources.len();
        for (node, slot, own) in nodes {
            let own = if self.names.contains(&own) { format!("{name}_{own}") } else { own };
            self.names.insert(own.clone());
            self.inputs.insert(node, Input { source, slot, name: own });
        }
        self.sources.push(Source { name: format_ident!("{name}"), size, reading });
    }

    /// What a node is called, if it is an input.
    pub fn name(&self, node: usize) -> Option<&str> {
        self.inputs.get(&node).map(|input| input.name.as_str())
    }

    /// Statements that bind those of the nodes that are inputs and not bound yet; they stand
    /// `indent` columns from the left.
    pub fn bind(
        &mut self,
        nodes: impl IntoIterator<Item = usize>,
        indent: usize,
    ) -> Vec<TokenStream> {
        let mut wanted: BTreeMap<(usize, usize), &str> = BTreeMap::new();
        for node in nodes {
            if let Some(input) = self.inputs.get(&node)
                && self.bound.insert(node)
            {
                wanted.insert((input.source, input.slot), &input.name);
            }
        }
        let mut statements = Vec::new();
        for (number, source) in self.sources.iter().enumerate() {
            let of_source = wanted.range((number, 0)..(number + 1, 0));
            let slots: Vec<(usize, &str)> =
                of_source.map(|(&(_, slot), &name)| (slot, name)).collect();
            statements.extend(source.bind(&slots, indent));
        }
        statements
    }
}

impl Source {
    fn bind(&self, slots: &[(usize, &str)], indent: usize) -> Vec<TokenStream> {
        if slots.is_empty() {
            return Vec::new();
        }
        if self.reading == Reading::Direct {
            let mut names = vec!["_"; self.size];
            slots.iter().for_each(|&(slot, name)| names[slot] = name);
            let source = &self.name;
            if indent + width(&names) + source.to_string().len() <= LINE {
                let names = names.into_iter().map(pattern);
                return vec![quote!(let [#(#names),*] = #source;)];
            }
        }
        let mut statements = Vec::new();
        let mut rest = slots;
        while !rest.is_empty() {
            let run = self.run(rest, indent);
            statements.push(self.bind_run(&rest[..run]));
            rest = &rest[run..];
        }
        statements
    }

    /// How many of the slots follow each other and are bound in one line.
    fn run(&self, slots: &[(usize, &str)], indent: usize) -> usize {
        let first = slots[0].0;
        let read = "R::gather_all(&, 1000, 1)".len() + self.name.to_string().len();
        let fits = |count: usize| {
            let names: Vec<&str> = slots[..count].iter().map(|&(_, name)| name).collect();
            slots[count - 1].0 == first + count - 1 && indent + width(&names) + read <= LINE
        };
        (2..=slots.len()).take_while(|&count| fits(count)).last().unwrap_or(1)
    }

    fn bind_run(&self, run: &[(usize, &str)]) -> TokenStream {
        let source = &self.name;
        let at = Literal::usize_unsuffixed(run[0].0);
        let names = run.iter().map(|&(_, name)| format_ident!("{name}"));
        match (run.len(), self.reading) {
            (1, Reading::Direct) => quote!(#(let #names = #source[#at];)*),
            (1, Reading::Gathered) => quote!(#(let #names = R::gather(#source, #at);)*),
            (_, Reading::Direct) => quote!(let [#(#names),*] = R::gather_all(&#source, #at, 1);),
            (_, Reading::Gathered) => quote!(let [#(#names),*] = R::gather_all(#source, #at, 1);),
        }
    }
}

/// Columns of `let [a, b] = ;`
fn width(names: &[&str]) -> usize {
    names.iter().map(|name| name.chars().count() + 2).sum::<usize>() + "let [] = ;".len() - 2
}

fn pattern(name: &str) -> TokenStream {
    match name {
        "_" => quote!(_),
        _ => {
            let name = format_ident!("{name}");
            quote!(#name)
        }
    }
}

/// For each input of a graph that it uses, its node and its number.
pub(crate) fn used(graph: &Graph) -> impl Iterator<Item = (usize, usize)> {
    graph.nodes().filter_map(|(id, node)| match node {
        Node::Input(i) => Some((id.index(), i as usize)),
        _ => None,
    })
}
