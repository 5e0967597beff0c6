//! The body of an evaluation by sweeps: all groups inward, the main body, all groups outward.

use std::ops::Range;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::places::{repeated, slot};

/// One group's sweeps, to be called for each of its equal appendages.
pub(crate) struct Call {
    /// What names of the group's functions begin with.
    pub prefix: String,
    pub count: usize,
    /// Sizes of what the inward sweep leaves for the outward one, each once or for so many links.
    pub saved: Vec<(usize, Option<usize>)>,
}

/// Evaluations from calls of the groups' sweeps.
pub(crate) struct Driver {
    pub calls: Vec<Call>,
    /// How many numbers an appendage adds at O.
    pub at_origin: usize,
    /// What a right side has besides.
    pub beside: Option<Beside>,
}

/// What a right side writes beside accelerations: β̇ and the power.
pub(crate) struct Beside {
    /// Where β of the hinges stand in y.
    pub beta: Range<usize>,
    /// Where τ of the hinges stand in y.
    pub tau: Range<usize>,
    /// Where the power is written.
    pub power: usize,
}

impl Driver {
    /// The evaluation on any scalar, one appendage after the other.
    pub fn on_any_scalar(&self) -> TokenStream {
        let inward = self.calls.iter().map(|call| call.inward_singly(self.power()));
        let outward = self.calls.iter().map(Call::outward_singly);
        let body = quote!(main_body::<R, R>(k, x, seen, out));
        self.evaluation(&quote!(R::zero()), &quote!(#(#inward)*), &body, &quote!(#(#outward)*))
    }

    /// The evaluation in packs of whatever width the processor has.
    pub fn in_packs(&self) -> TokenStream {
        let narrow = self.in_packs_of(4);
        if self.calls.iter().all(|call| call.count < 5) {
            return narrow;
        }
        let wide = self.in_packs_of(8);
        quote!(if I::WIDEST >= 8 { #wide } else { #narrow })
    }

    fn in_packs_of(&self, most: usize) -> TokenStream {
        let inward = self.calls.iter().map(|call| call.inward_packed(most, self.power()));
        let outward = self.calls.iter().map(|call| call.outward_packed(most));
        let body = quote!(main_body::<f64, I::One>(k, x, seen, out));
        self.evaluation(&quote!(0.0), &quote!(#(#inward)*), &body, &quote!(#(#outward)*))
    }

    /// The argument for the power, of a right side.
    fn power(&self) -> Option<TokenStream> {
        self.beside.as_ref().map(|_| quote!(&mut power))
    }

    /// All sweeps, sums beginning with `zero`.
    fn evaluation(
        &self,
        zero: &TokenStream,
        inward: &TokenStream,
        main_body: &TokenStream,
        outward: &TokenStream,
    ) -> TokenStream {
        let size = Literal::usize_unsuffixed(self.at_origin);
        let power = self.beside.as_ref().map(|_| quote!(let mut power = #zero;));
        let beside = self.beside.as_ref().map(Beside::tokens);
        quote! {
            let mut seen = [#zero; #size];
            #power
            #inward
            let main = #main_body;
            #outward
            #beside
        }
    }
}

impl Beside {
    fn tokens(&self) -> TokenStream {
        let ends = |range: &Range<usize>| [range.start, range.end].map(Literal::usize_unsuffixed);
        let ([beta, beta_end], [tau, tau_end]) = (ends(&self.beta), ends(&self.tau));
        let power = Literal::usize_unsuffixed(self.power);
        quote! {
            out[#beta..#beta_end].copy_from_slice(&x[#tau..#tau_end]);
            out[#power] = power;
        }
    }
}

impl Call {
    fn names(&self) -> (Ident, Ident) {
        (format_ident!("{}_in", self.prefix), format_ident!("{}_out", self.prefix))
    }

    /// An empty place for what the inward sweep of a pack leaves.
    fn empty(&self, pack: &TokenStream) -> TokenStream {
        saved(&self.saved, &quote!(#pack::zero()))
    }

    fn inward_singly(&self, power: Option<TokenStream>) -> TokenStream {
        let (inward, saved) = (self.names().0, format_ident!("{}_saved", self.prefix));
        let empty = self.empty(&quote!(R));
        let count = Literal::usize_unsuffixed(self.count);
        let calls = repeated("a", self.count, false, |a| {
            let a = slot(a);
            quote!(#inward::<R, R>(k, x, #a, &mut #saved[#a], &mut seen, #power);)
        });
        quote!(let mut #saved = [#empty; #count]; #calls)
    }

    fn outward_singly(&self) -> TokenStream {
        let (outward, saved) = (self.names().1, format_ident!("{}_saved", self.prefix));
        repeated("a", self.count, false, |a| {
            let a = slot(a);
            quote!(#outward::<R, R>(k, #a, &#saved[#a], main, out);)
        })
    }

    fn inward_packed(&self, most: usize, power: Option<TokenStream>) -> TokenStream {
        let inward = self.names().0;
        let packs = self.packs(most).into_iter().map(|(a, width)| {
            let (pack, saved) = (pack(width), format_ident!("{}_saved_{a}", self.prefix));
            let (empty, a) = (self.empty(&pack), Literal::usize_unsuffixed(a));
            quote! {
                let mut #saved = #empty;
                #inward::<f64, #pack>(k, x, #a, &mut #saved, &mut seen, #power);
            }
        });
        quote!(#(#packs)*)
    }

    fn outward_packed(&self, most: usize) -> TokenStream {
        let outward = self.names().1;
        let packs = self.packs(most).into_iter().map(|(a, width)| {
            let (pack, saved) = (pack(width), format_ident!("{}_saved_{a}", self.prefix));
            let a = Literal::usize_unsuffixed(a);
            quote!(#outward::<f64, #pack>(k, #a, &#saved, main, out);)
        });
        quote!(#(#packs)*)
    }

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
}

/// The type of packs of a width.
fn pack(width: usize) -> TokenStream {
    match width {
        8 => quote!(I::Eight),
        4 => quote!(I::Four),
        2 => quote!(I::Two),
        _ => quote!(I::One),
    }
}

/// What an inward sweep leaves: arrays of `of`, by their sizes.
pub(crate) fn saved(sizes: &[(usize, Option<usize>)], of: &TokenStream) -> TokenStream {
    let mut arrays = sizes.iter().map(|&(size, repeats)| {
        let size = Literal::usize_unsuffixed(size);
        match repeats.map(Literal::usize_unsuffixed) {
            Some(repeats) => quote!([[#of; #size]; #repeats]),
            None => quote!([#of; #size]),
        }
    });
    match sizes.len() {
        1 => arrays.next().unwrap_or_default(),
        _ => quote!((#(#arrays),*)),
    }
}
