//! A routine whose evaluation is one straight line.

use std::collections::BTreeMap;

use nboom_expr::Id;
use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::inputs::{Inputs, Reading, used};
use crate::emit::item::{Item, Signature};
use crate::emit::statements::{Statements, Task};
use crate::emit::stores::{copies, stores};
use crate::request::{Level, Names};
use crate::trace::Split;

/// Columns that statements of a function in a module stand from the left.
pub(crate) const IN_FUNCTION: usize = 8;

/// Columns that statements of a method in a module stand from the left.
const IN_METHOD: usize = 12;

/// The routine's items.
pub(crate) fn items(
    split: &Split,
    level: Level,
    signature: &Signature,
    names: &Names,
) -> TokenStream {
    let sized = signature.sized(split.constants.len(), &quote!(S));
    let statements = evaluate(split, level, names);
    let item = Item {
        signature,
        constants: split.constants.len(),
        prepare: prepare(split, level, names),
        evaluate: quote!(evaluate_on::<R, R>(k, x, out);),
        evaluate_packed: quote!(evaluate_on::<f64, I::One>(k, x, out);),
        in_packs: false,
    };
    let item = item.tokens();
    quote! {
        #item
        /// The evaluation on scalars or packs `R` of numbers `S`.
        #[inline(always)]
        fn evaluate_on<S: Copy, R: Pack<S>>(k: &[S], x: &[S], out: &mut [S]) {
            #sized
            #statements
        }
    }
}

/// From `p` to `k`: parameters are copied, all else is computed.
fn prepare(split: &Split, level: Level, names: &Names) -> TokenStream {
    let number: BTreeMap<usize, usize> = used(&split.graph).collect();
    let number = |id: &Id| number.get(&id.index()).copied();
    let plain: Vec<(usize, usize)> = split
        .constants
        .iter()
        .enumerate()
        .filter_map(|(slot, id)| Some((slot, number(id)?)))
        .collect();
    let computed: Vec<(usize, Id)> = split
        .constants
        .iter()
        .copied()
        .enumerate()
        .filter(|(_, id)| number(id).is_none())
        .collect();
    let mut inputs = Inputs::default();
    let given = used(&split.graph).filter(|&(_, i)| i < split.parameters);
    let given = given.map(|(node, i)| (node, i, name_of(&names.parameters, "p", i)));
    inputs.add("p", split.parameters, Reading::Gathered, given);
    let statements = Statements::of(Task {
        graph: &split.graph,
        wanted: &split.is_prepared(),
        inputs,
        results: computed.iter().map(|&(_, id)| (id, None)).collect(),
        level,
        remarks: false,
        indent: IN_METHOD,
    });
    let copies = copies(&plain);
    let slots: Vec<usize> = computed.iter().map(|&(slot, _)| slot).collect();
    let stores = stores("k", &slots, &statements.results, IN_METHOD);
    let lines = statements.lines;
    quote!(#(#copies)* #(#lines)* #(#stores)*)
}

/// From `k` and `x` to `out`.
fn evaluate(split: &Split, level: Level, names: &Names) -> TokenStream {
    let number: BTreeMap<usize, usize> = used(&split.graph).collect();
    let mut inputs = Inputs::default();
    let constants = split.constants.iter().enumerate().map(|(slot, id)| {
        let name = match number.get(&id.index()) {
            Some(&i) => name_of(&names.parameters, "p", i),
            None => format!("t{}", id.index()),
        };
        (id.index(), slot, name)
    });
    inputs.add("k", split.constants.len(), Reading::Gathered, constants);
    let of_state = used(&split.graph).filter(|&(_, i)| i >= split.parameters);
    let of_state = of_state.map(|(node, i)| {
        let slot = i - split.parameters;
        (node, slot, name_of(&names.coordinates, "x", slot))
    });
    inputs.add("x", names.coordinates.len(), Reading::Gathered, of_state);
    let results = split.graph.outputs().iter().enumerate();
    let statements = Statements::of(Task {
        graph: &split.graph,
        wanted: &split.varies,
        inputs,
        results: results.map(|(slot, &id)| (id, names.outputs.get(slot).cloned())).collect(),
        level,
        remarks: true,
        indent: IN_FUNCTION,
    });
    let slots: Vec<usize> = (0..statements.results.len()).collect();
    let stores = stores("out", &slots, &statements.results, IN_FUNCTION);
    let lines = statements.lines;
    quote!(#(#lines)* #(#stores)*)
}

/// A name from the list, or one by number.
fn name_of(names: &[String], array: &str, i: usize) -> String {
    names.get(i).cloned().unwrap_or_else(|| format!("{array}_{i}"))
}
