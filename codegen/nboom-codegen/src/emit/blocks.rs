//! Long straight lines cut into blocks.
//!
//! Every `let` opens a scope that ends with its block. A compiler that writes debug information
//! goes down one scope inside the other, and some thousands of them overflow its stack.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote};

/// A statement.
pub(crate) enum Line {
    /// `let name = value;`
    Value { name: Ident, value: TokenStream },
    /// Any other, which stays outside of blocks.
    Other(TokenStream),
}

/// Up to this many statements stand in one block.
const ONE_BLOCK: usize = 1000;

/// Statements of each block of a longer line.
const BLOCK: usize = 250;

/// The statements, in blocks that hand out what later ones or `results` read.
pub(crate) fn in_blocks(lines: &[Line], results: &[TokenStream]) -> Vec<TokenStream> {
    if lines.len() <= ONE_BLOCK {
        return lines.iter().map(Line::statement).collect();
    }
    let mut later: HashSet<String> = HashSet::new();
    results.iter().for_each(|result| note_names(result, &mut later));
    let mut blocks = Vec::new();
    for chunk in lines.rchunks(BLOCK) {
        for part in chunk.chunk_by(|a, b| a.is_value() && b.is_value()).rev() {
            blocks.push(block(part, &later));
            part.iter().for_each(|line| line.note_names(&mut later));
        }
    }
    blocks.reverse();
    blocks
}

/// A block that hands out its values whose names are read `later`.
fn block(part: &[Line], later: &HashSet<String>) -> TokenStream {
    if let [line] = part {
        return line.statement();
    }
    let names = part.iter().filter_map(|line| match line {
        Line::Value { name, .. } => Some(name),
        Line::Other(_) => None,
    });
    let read: Vec<&Ident> = names.filter(|name| later.contains(&name.to_string())).collect();
    let statements = part.iter().map(Line::statement);
    quote! {
        let [#(#read),*] = {
            #(#statements)*
            [#(#read),*]
        };
    }
}

impl Line {
    fn is_value(&self) -> bool {
        matches!(self, Self::Value { .. })
    }

    fn statement(&self) -> TokenStream {
        match self {
            Self::Value { name, value } => quote!(let #name = #value;),
            Self::Other(line) => line.to_token_stream(),
        }
    }

    fn note_names(&self, names: &mut HashSet<String>) {
        let (Self::Value { value: tokens, .. } | Self::Other(tokens)) = self;
        note_names(tokens, names);
    }
}

fn note_names(tokens: &TokenStream, names: &mut HashSet<String>) {
    for token in tokens.clone() {
        match token {
            TokenTree::Ident(name) => {
                names.insert(name.to_string());
            }
            TokenTree::Group(group) => note_names(&group.stream(), names),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::format_ident;

    /// t0 = x and every tᵢ = tᵢ₋₁ + t₀.
    fn lines(count: usize) -> Vec<Line> {
        let line = |i: usize| {
            let name = format_ident!("t{i}");
            let value = match i.checked_sub(1) {
                Some(before) => {
                    let before = format_ident!("t{before}");
                    quote!(#before + t0)
                }
                None => quote!(x),
            };
            Line::Value { name, value }
        };
        (0..count).map(line).collect()
    }

    #[test]
    fn long_lines_hand_out_what_is_read_later() {
        let blocks = in_blocks(&lines(1001), &[quote!(t1000), quote!(t1)]);
        let ends = |text: String| text.split(" = {").next().map(str::to_owned);
        let starts: Vec<_> = blocks.iter().map(|block| ends(block.to_string())).collect();
        let expected =
            ["let t0 = x ;", "let [t1 , t250]", "let [t500]", "let [t750]", "let [t1000]"];
        assert_eq!(starts, expected.map(|text| Some(text.to_owned())));
    }

    #[test]
    fn short_lines_stay_as_they_are() {
        assert_eq!(in_blocks(&lines(1000), &[quote!(t999)]).len(), 1000);
    }
}
