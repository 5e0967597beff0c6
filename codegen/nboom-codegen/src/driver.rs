//! The body of an evaluation: all groups inward, the main body, all groups outward.

use proc_macro2::{Ident, Literal, TokenStream, TokenTree};
use quote::{format_ident, quote};

use nboom_formulation::stages::AT_ORIGIN;

/// One group's sweeps, to be called for each of its equal appendages.
pub(crate) struct Call {
    pub inward: Ident,
    pub outward: Ident,
    pub number: usize,
    pub count: usize,
    /// An empty place for what the inward sweep leaves for the outward one, on packs `P`.
    pub empty: TokenStream,
    /// Which numbers at O the inward sweep returns.
    pub seen: Vec<usize>,
}

/// How the appendages of a group are taken.
#[derive(Clone, Copy)]
enum Taking {
    /// One after the other, on any scalar `R`.
    Singly,
    /// Side by side in packs of at most this many, on `f64`.
    Packed(usize),
}

/// Emits evaluations from the groups and `main_body`, which goes from `seen` to `main` and
/// `out` on packs `P` of numbers `S`.
pub(crate) struct Driver {
    pub calls: Vec<Call>,
    pub main_body: TokenStream,
}

impl Driver {
    /// The evaluation on any scalar.
    pub fn on_any_scalar(&self) -> TokenStream {
        self.body(Taking::Singly)
    }

    /// The evaluation in packs of whatever width the processor has.
    pub fn in_packs(&self) -> TokenStream {
        let narrow = self.body(Taking::Packed(4));
        if self.calls.iter().all(|call| call.count < 5) {
            return narrow;
        }
        let wide = self.body(Taking::Packed(8));
        quote!(if I::WIDEST >= 8 { #wide } else { #narrow })
    }

    fn body(&self, taking: Taking) -> TokenStream {
        let inward = self.calls.iter().map(|call| call.inward(taking));
        let outward = self.calls.iter().map(|call| call.outward(taking));
        let (number, pack) = taking.types(1);
        let main_body = with_types(&self.main_body, &pack, &number);
        let size = Literal::usize_unsuffixed(AT_ORIGIN.size);
        let zero = with_types(&quote!(S::zero()), &pack, &number);
        let zero = if matches!(taking, Taking::Singly) { zero } else { quote!(0.0) };
        quote! {
            let mut seen = [#zero; #size];
            #(#inward)*
            #main_body
            #(#outward)*
        }
    }
}

impl Taking {
    /// The numbers and the packs of a width.
    fn types(self, width: usize) -> (TokenStream, TokenStream) {
        match self {
            Self::Singly => (quote!(R), quote!(R)),
            Self::Packed(_) => {
                let pack = match width {
                    8 => quote!(I::Eight),
                    4 => quote!(I::Four),
                    2 => quote!(I::Two),
                    _ => quote!(I::One),
                };
                (quote!(f64), pack)
            }
        }
    }
}

impl Call {
    /// First appendage and width of each pack.
    fn packs(&self, most: usize) -> Vec<(usize, usize)> {
        let mut packs = Vec::new();
        let mut a = 0;
        while a < self.count {
            let fits = |&width: &usize| width <= most && width <= self.count - a;
            let width = [8, 4, 2, 1].into_iter().find(fits).unwrap_or(1);
            packs.push((a, width));
            a += width;
        }
        packs
    }

    fn inward(&self, taking: Taking) -> TokenStream {
        let Self { inward, empty, .. } = self;
        let add = self.add(taking);
        match taking {
            Taking::Singly => {
                let (saved, count) = (self.saved(None), Literal::usize_unsuffixed(self.count));
                let empty = with_types(empty, &quote!(R), &quote!(R));
                quote! {
                    let mut #saved = [#empty; #count];
                    for a in 0..#count {
                        let part = #inward::<R, R>(k, x, a, &mut #saved[a]);
                        #add
                    }
                }
            }
            Taking::Packed(most) => {
                let packs = self.packs(most).into_iter().map(|(a, width)| {
                    let saved = self.saved(Some(a));
                    let (number, pack) = taking.types(width);
                    let empty = with_types(empty, &quote!(<#pack>), &number);
                    let a = Literal::usize_unsuffixed(a);
                    quote! {
                        let mut #saved = #empty;
                        let part = #inward::<f64, #pack>(k, x, #a, &mut #saved);
                        #add
                    }
                });
                quote!(#(#packs)*)
            }
        }
    }

    fn outward(&self, taking: Taking) -> TokenStream {
        let outward = &self.outward;
        match taking {
            Taking::Singly => {
                let (saved, count) = (self.saved(None), Literal::usize_unsuffixed(self.count));
                quote! {
                    for a in 0..#count {
                        #outward::<R, R>(k, main, a, &#saved[a], out);
                    }
                }
            }
            Taking::Packed(most) => {
                let packs = self.packs(most).into_iter().map(|(a, width)| {
                    let (saved, (_, pack)) = (self.saved(Some(a)), taking.types(width));
                    let a = Literal::usize_unsuffixed(a);
                    quote!(#outward::<f64, #pack>(k, main, #a, &#saved, out);)
                });
                quote!(#(#packs)*)
            }
        }
    }

    /// Adds what the inward sweep returns to what is seen at O.
    fn add(&self, taking: Taking) -> TokenStream {
        let number = taking.types(1).0;
        let slots = self.seen.iter().map(|&slot| Literal::usize_unsuffixed(slot));
        let places = (0..self.seen.len()).map(Literal::usize_unsuffixed);
        quote!(#(seen[#slots] += Pack::<#number>::sum(part[#places]);)*)
    }

    fn saved(&self, a: Option<usize>) -> Ident {
        match a {
            Some(a) => format_ident!("saved_{}_{a}", self.number),
            None => format_ident!("saved_{}", self.number),
        }
    }
}

/// Replaces the type parameters `P` and `S` by types.
fn with_types(tokens: &TokenStream, pack: &TokenStream, number: &TokenStream) -> TokenStream {
    let replace = |token: TokenTree| -> TokenStream {
        match token {
            TokenTree::Group(group) => {
                let inner = with_types(&group.stream(), pack, number);
                TokenTree::from(proc_macro2::Group::new(group.delimiter(), inner)).into()
            }
            TokenTree::Ident(name) if name == "P" => pack.clone(),
            TokenTree::Ident(name) if name == "S" => number.clone(),
            other => other.into(),
        }
    };
    tokens.clone().into_iter().map(replace).collect()
}
