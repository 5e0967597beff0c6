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
    /// Of a limb with equal parts, those.
    pub parts: Option<Parts>,
    /// Of equal parts, what names of their limb's functions begin with.
    pub limb: Option<String>,
}

/// Equal parts of a limb, to be called between the sweeps of its trunk.
pub(crate) struct Parts {
    pub calls: Vec<Call>,
    /// How many numbers they show the trunk.
    pub shown: usize,
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
        if self.calls.iter().all(|call| call.most() < 8) {
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
    /// The most equal appendages, or parts of one.
    fn most(&self) -> usize {
        let parts = self.parts.iter().flat_map(|parts| &parts.calls);
        parts.map(Self::most).fold(self.count, usize::max)
    }

    fn names(&self) -> (Ident, Ident) {
        (format_ident!("{}_in", self.prefix), format_ident!("{}_out", self.prefix))
    }

    /// An empty place for what the inward sweep of a pack leaves.
    fn empty(&self, pack: &TokenStream) -> TokenStream {
        saved(&self.saved, &quote!(#pack::zero()))
    }

    fn inward_singly(&self, power: Option<TokenStream>) -> TokenStream {
        let saved = format_ident!("{}_saved", self.prefix);
        let empty = self.empty(&quote!(R));
        let count = Literal::usize_unsuffixed(self.count);
        // Parts are added up in the closed form's order.
        let calls = self.one_by_one(self.limb.is_some(), |a| {
            self.inward([&quote!(R), &quote!(R)], &a, &quote!(#saved[#a]), power.as_ref())
        });
        let parts = self.parts_inward([&quote!(R), &quote!(R)], &quote!(R::zero()), |call| {
            call.inward_singly(power.clone())
        });
        quote!(#parts let mut #saved = [#empty; #count]; #calls)
    }

    /// Calls for one appendage after the other: two that are straight lines without a loop, which takes longer.
    fn one_by_one(&self, inward: bool, call: impl Fn(TokenStream) -> TokenStream) -> TokenStream {
        let are_lines = self.saved.iter().all(|(_, repeats)| repeats.is_none());
        if !(self.count == 2 && are_lines) {
            return repeated("a", self.count, inward, |a| call(slot(a)));
        }
        let [first, second] = if inward { [quote!(1), quote!(0)] } else { [quote!(0), quote!(1)] };
        let calls = [call(first), call(second)];
        quote!(#(#calls)*)
    }

    fn outward_singly(&self) -> TokenStream {
        let saved = format_ident!("{}_saved", self.prefix);
        let calls = self
            .one_by_one(false, |a| self.outward([&quote!(R), &quote!(R)], &a, &quote!(#saved[#a])));
        let parts = self.parts_outward(Self::outward_singly);
        quote!(#calls #parts)
    }

    fn inward_packed(&self, most: usize, power: Option<TokenStream>) -> TokenStream {
        let packs = self.packs(most).into_iter().map(|(a, width)| {
            let (pack, saved) = (pack(width), format_ident!("{}_saved_{a}", self.prefix));
            let (empty, a) = (self.empty(&pack), Literal::usize_unsuffixed(a));
            let scalars = [&quote!(f64), &pack];
            let call = self.inward(scalars, &quote!(#a), &quote!(#saved), power.as_ref());
            quote!(let mut #saved = #empty; #call)
        });
        let parts = self.parts_inward([&quote!(f64), &pack(1)], &quote!(0.0), |call| {
            call.inward_packed(most, power.clone())
        });
        quote!(#parts #(#packs)*)
    }

    fn outward_packed(&self, most: usize) -> TokenStream {
        let packs = self.packs(most).into_iter().map(|(a, width)| {
            let (pack, saved) = (pack(width), format_ident!("{}_saved_{a}", self.prefix));
            let a = Literal::usize_unsuffixed(a);
            self.outward([&quote!(f64), &pack], &quote!(#a), &quote!(#saved))
        });
        let parts = self.parts_outward(|call| call.outward_packed(most));
        quote!(#(#packs)* #parts)
    }

    /// A call of the inward sweep.
    fn inward(
        &self,
        scalars: [&TokenStream; 2],
        a: &TokenStream,
        saved: &TokenStream,
        power: Option<&TokenStream>,
    ) -> TokenStream {
        let (inward, [scalar, pack]) = (self.names().0, scalars);
        let of_parts = self.parts.as_ref().map(|_| {
            let [kept, shown] = between(&self.prefix, ["kept", "shown"]);
            quote!(#kept, &#shown,)
        });
        let of_limb = self.limb.as_ref().map(|limb| between(limb, ["carriers", "shown"]));
        let (carriers, sum) = match of_limb {
            Some([carriers, shown]) => (Some(quote!(&#carriers,)), shown),
            None => (None, format_ident!("seen")),
        };
        quote! {
            #inward::<#scalar, #pack>(
                k, x, #a, #carriers #of_parts &mut #saved, &mut #sum, #power
            );
        }
    }

    /// A call of the outward sweep.
    fn outward(
        &self,
        [scalar, pack]: [&TokenStream; 2],
        a: &TokenStream,
        saved: &TokenStream,
    ) -> TokenStream {
        let outward = self.names().1;
        let main = match &self.limb {
            Some(limb) => {
                let [carriers, carried_at] = between(limb, ["carriers", "carried_at"]);
                quote!(&#carriers, &#carried_at)
            }
            None => quote!(main),
        };
        let bound = self.parts.as_ref().map(|_| {
            let [carried_at] = between(&self.prefix, ["carried_at"]);
            quote!(let #carried_at =)
        });
        quote!(#bound #outward::<#scalar, #pack>(k, #a, &#saved, #main, out);)
    }

    /// Outward through the trunk of a limb, and inward through its parts.
    fn parts_inward(
        &self,
        [scalar, pack]: [&TokenStream; 2],
        zero: &TokenStream,
        inward: impl Fn(&Self) -> TokenStream,
    ) -> Option<TokenStream> {
        let Parts { calls, shown: size } = self.parts.as_ref()?;
        let [carry, kept, carriers, shown] =
            between(&self.prefix, ["carry", "kept", "carriers", "shown"]);
        // The last ones first, as in the closed form.
        let calls = calls.iter().rev().map(inward);
        let size = Literal::usize_unsuffixed(*size);
        Some(quote! {
            let (#kept, #carriers) = #carry::<#scalar, #pack>(k, x, 0);
            let mut #shown = [#zero; #size];
            #(#calls)*
        })
    }

    /// Outward through the parts of a limb.
    fn parts_outward(&self, outward: impl Fn(&Self) -> TokenStream) -> Option<TokenStream> {
        let calls = self.parts.as_ref()?.calls.iter().map(outward);
        Some(quote!(#(#calls)*))
    }

    /// Whether there are equal appendages, or equal parts of one, for packs.
    pub fn takes_side_by_side(&self) -> bool {
        let parts = self.parts.as_ref().map_or(&[][..], |parts| &parts.calls);
        self.count > 1 || parts.iter().any(Self::takes_side_by_side)
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

/// Names of what the trunk of a limb and its parts exchange.
fn between<const N: usize>(limb: &str, names: [&str; N]) -> [Ident; N] {
    names.map(|name| format_ident!("{limb}_{name}"))
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
