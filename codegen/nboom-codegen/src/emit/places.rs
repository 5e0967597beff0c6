//! Places in arrays, and loops over them.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

/// `start` and a stride for each variable: `start + stride * i + a`; a variable that is `None` is
/// zero.
pub(crate) fn place(start: usize, terms: &[(usize, Option<&Ident>)]) -> TokenStream {
    let mut sum = Vec::new();
    if start > 0 {
        let start = Literal::usize_unsuffixed(start);
        sum.push(quote!(#start));
    }
    for &(stride, variable) in terms {
        let Some(variable) = variable else { continue };
        let literal = Literal::usize_unsuffixed(stride);
        sum.push(if stride == 1 { quote!(#variable) } else { quote!(#literal * #variable) });
    }
    if sum.is_empty() { quote!(0) } else { quote!(#(#sum)+*) }
}

/// A place in an array that has one for each value of a variable.
pub(crate) fn slot(variable: Option<&Ident>) -> TokenStream {
    place(0, &[(1, variable)])
}

/// The body for each value of a variable, without a loop if there is one value alone.
pub(crate) fn repeated(
    variable: &str,
    count: usize,
    inward: bool,
    body: impl Fn(Option<&Ident>) -> TokenStream,
) -> TokenStream {
    if count == 1 {
        return body(None);
    }
    let (variable, count) = (format_ident!("{variable}"), Literal::usize_unsuffixed(count));
    let body = body(Some(&variable));
    match inward {
        true => quote!(for #variable in (0..#count).rev() { #body }),
        false => quote!(for #variable in 0..#count { #body }),
    }
}
