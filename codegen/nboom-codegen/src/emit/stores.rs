//! Statements that write numbers into arrays.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::expression::Expression;
use crate::emit::text::LINE;

/// Writes values to slots of an array, those of neighbouring slots together as long as that fits in
/// a line.
pub(crate) fn stores(
    array: &str,
    slots: &[usize],
    values: &[Expression],
    indent: usize,
) -> Vec<TokenStream> {
    let around = "R::scatter_all([], , 1000, 1);".len() + array.len();
    let (array, mut statements) = (format_ident!("{array}"), Vec::new());
    let mut first = 0;
    while first < slots.len() {
        let mut columns = indent + around;
        let fits = |&i: &usize| {
            columns += values[i].width + 2;
            slots[i] == slots[first] + i - first && columns <= LINE + 2
        };
        let last = (first..slots.len()).take_while(fits).last().unwrap_or(first);
        let at = Literal::usize_unsuffixed(slots[first]);
        let written = values[first..=last].iter().map(|value| &value.tokens);
        statements.push(quote!(R::scatter_all([#(#written),*], #array, #at, 1);));
        first = last + 1;
    }
    statements
}

/// Copies numbers of `p` to `k`, neighbours that stay neighbours together: slots of `k` and places
/// in `p`.
pub(crate) fn copies(plain: &[(usize, usize)]) -> Vec<TokenStream> {
    let follows = |a: &(usize, usize), b: &(usize, usize)| (a.0 + 1, a.1 + 1) == *b;
    let copy = |run: &[(usize, usize)]| {
        let (to, from) = run[0];
        let [to_end, from_end] = [to + run.len(), from + run.len()].map(Literal::usize_unsuffixed);
        let [to, from] = [to, from].map(Literal::usize_unsuffixed);
        match run.len() {
            1 => quote!(k[#to] = p[#from];),
            _ => quote!(k[#to..#to_end].copy_from_slice(&p[#from..#from_end]);),
        }
    };
    plain.chunk_by(follows).map(copy).collect()
}
