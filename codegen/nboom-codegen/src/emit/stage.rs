//! One step of a sweep as a function.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::inputs::{Inputs, Reading, used};
use crate::emit::statements::{Statements, Task};
use crate::emit::straight::IN_FUNCTION;
use crate::request::Level;
use crate::trace::{Masked, Traced};

/// Emits the functions of a step, and calls of them.
pub(crate) struct Step<'a> {
    traced: &'a Traced,
    level: Level,
}

impl<'a> Step<'a> {
    pub fn new(traced: &'a Traced, level: Level) -> Self {
        Self { traced, level }
    }

    /// Name of the function that takes the step.
    pub fn name(&self) -> Ident {
        format_ident!("{}", self.traced.name)
    }

    /// The function that takes the step.
    pub fn function(&self) -> TokenStream {
        let Traced { about, split, inputs, outputs, .. } = self.traced;
        let statements = Statements::of(Task {
            graph: &split.graph,
            wanted: &split.varies,
            inputs: self.inputs(),
            results: split.graph.outputs().iter().map(|&id| (id, None)).collect(),
            level: self.level,
            remarks: false,
            indent: IN_FUNCTION,
        });
        let constants = Some(split.constants.len()).filter(|&count| count > 0);
        let constants = constants.map(Literal::usize_unsuffixed).into_iter();
        let arguments = inputs.iter().filter(|input| size(input) > 0).map(|input| {
            let (name, size) = (format_ident!("{}", input.0.name), literal(size(input)));
            quote!(#name: [R; #size])
        });
        let mut results = statements.results.iter();
        let groups = outputs.iter().map(|(group, mask)| {
            let of_group = results.by_ref().take(group.size()).zip(mask);
            let values = of_group.filter(|(_, live)| **live).map(|(value, _)| &value.tokens);
            quote!([#(#values),*])
        });
        let groups: Vec<TokenStream> = groups.collect();
        let types = outputs.iter().map(|output| literal(size(output))).map(|n| quote!([R; #n]));
        let (returned, values) = (one_or_all(types.collect()), one_or_all(groups));
        let (name, lines) = (self.name(), &statements.lines);
        let about = format!(" {about}");
        quote! {
            #[doc = #about]
            #[inline(always)]
            fn #name<R: Real>(#(k: [R; #constants],)* #(#arguments),*) -> #returned {
                #(#lines)*
                #values
            }
        }
    }

    /// Constants and what else the step reads.
    fn inputs(&self) -> Inputs {
        let Traced { split, inputs, .. } = self.traced;
        let names = self.names();
        let number: BTreeMap<usize, usize> = used(&split.graph).collect();
        let node: BTreeMap<usize, usize> = number.iter().map(|(&node, &i)| (i, node)).collect();
        let mut all = Inputs::default();
        let constants = split.constants.iter().enumerate().map(|(slot, id)| {
            let name = number.get(&id.index()).map(|&i| names[i].clone());
            (id.index(), slot, name.unwrap_or_else(|| format!("t{}", id.index())))
        });
        all.add("k", split.constants.len(), Reading::Direct, constants);
        let mut at = split.parameters;
        for input in inputs {
            let (group, mask) = input;
            let live = (0..group.size()).filter(|&i| mask[i]).enumerate();
            let names = group.names();
            let read =
                live.filter_map(|(slot, i)| Some((*node.get(&(at + i))?, slot, names[i].clone())));
            all.add(group.name, size(input), Reading::Direct, read.collect::<Vec<_>>());
            at += group.size();
        }
        all
    }

    /// What the parameters are called.
    fn names(&self) -> Vec<String> {
        let groups = self.traced.parameters.iter();
        groups.flat_map(|group| group.names()).collect()
    }

    /// The function that computes constants from parameters, where any is computed.
    pub fn constants_function(&self) -> Option<TokenStream> {
        let Traced { split, .. } = self.traced;
        if split.preparation() == nboom_expr::Operations::default() {
            return None;
        }
        let names = self.names();
        let mut inputs = Inputs::default();
        let read = used(&split.graph).filter(|&(_, i)| i < split.parameters);
        let read = read.map(|(node, i)| (node, i, names[i].clone()));
        inputs.add("p", split.parameters, Reading::Direct, read);
        let statements = Statements::of(Task {
            graph: &split.graph,
            wanted: &split.is_prepared(),
            inputs,
            results: split.constants.iter().map(|&id| (id, None)).collect(),
            level: self.level,
            remarks: false,
            indent: IN_FUNCTION,
        });
        let values = statements.results.iter().map(|value| &value.tokens);
        let (name, lines) = (self.constants_name(), &statements.lines);
        let [parameters, constants] = [split.parameters, split.constants.len()].map(literal);
        let about = format!(" Constants of `{}`.", self.traced.name);
        Some(quote! {
            #[doc = #about]
            fn #name<R: Real>(p: [R; #parameters]) -> [R; #constants] {
                #(#lines)*
                [#(#values),*]
            }
        })
    }

    fn constants_name(&self) -> Ident {
        format_ident!("{}_constants", self.traced.name)
    }

    /// The constants, from the array `p` of parameters.
    pub fn constants(&self, p: &Ident) -> TokenStream {
        let Traced { split, .. } = self.traced;
        if split.preparation() != nboom_expr::Operations::default() {
            let name = self.constants_name();
            return quote!(#name(#p));
        }
        let number: BTreeMap<usize, usize> = used(&split.graph).collect();
        let numbers: Vec<usize> = split.constants.iter().map(|id| number[&id.index()]).collect();
        if numbers.iter().copied().eq(0..split.parameters) {
            return quote!(#p);
        }
        let numbers = numbers.into_iter().map(literal);
        quote!([#(#p[#numbers]),*])
    }
}

/// How many numbers are handed over.
fn size((_, mask): &Masked) -> usize {
    mask.iter().filter(|live| **live).count()
}

fn literal(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

/// One part as it is, any other number of them as a tuple.
pub(crate) fn one_or_all(mut parts: Vec<TokenStream>) -> TokenStream {
    match parts.len() {
        1 => parts.remove(0),
        _ => quote!((#(#parts),*)),
    }
}
