//! Functions that take one appendage, or several side by side, through the sweeps.

use nboom_formulation::Layout;
use nboom_formulation::stages::{AT_ORIGIN, ELIMINATED, PADDLE, SHOWN, TURNED};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::comment::comment;
use crate::emit::driver::{Call, saved};
use crate::emit::places::{place, repeated, slot};
use crate::trace::{Chain, Equal, Paddle, Placed, Steps};

/// The sweeps of a group of equal appendages.
pub(crate) struct Sweeps<'a> {
    group: &'a Equal,
    steps: &'a Steps,
    /// Which numbers at O any group shows.
    at_origin: &'a [bool],
}

impl<'a> Sweeps<'a> {
    pub fn new(group: &'a Equal, steps: &'a Steps, at_origin: &'a [bool]) -> Self {
        Self { group, steps, at_origin }
    }

    /// How an evaluation calls them.
    pub fn call(&self) -> Call {
        let saved = match self.steps {
            Steps::Chain(chain) => {
                vec![(chain.inward.traced.size(ELIMINATED), Some(self.group.shape.hinges()))]
            }
            Steps::Paddle(paddle) => {
                [ELIMINATED, PADDLE].map(|group| (paddle.inward.traced.size(group), None)).to_vec()
            }
        };
        Call { prefix: self.group.prefix(), count: self.group.count, saved }
    }

    /// Both functions.
    pub fn functions(&self) -> TokenStream {
        let (inward, outward) = match self.steps {
            Steps::Chain(chain) => (self.chain_in(chain), self.chain_out(chain)),
            Steps::Paddle(paddle) => (self.paddle_in(paddle), self.paddle_out(paddle)),
        };
        let (saved, prefix) = (saved(&self.call().saved, &quote!(P)), self.group.prefix());
        let (in_name, out_name) = (format_ident!("{prefix}_in"), format_ident!("{prefix}_out"));
        let seen = Literal::usize_unsuffixed(self.at_origin.iter().filter(|live| **live).count());
        let (count, shape) = (self.group.count, self.group.shape_name());
        let taken = match count {
            1 => format!("the appendage {shape}"),
            _ => format!("appendage `a` of {count} {shape} and those packed with it"),
        };
        let in_about = format!(" Inward through {taken}; adds to `seen`.");
        let out_about = format!(" Outward through {taken}.");
        quote! {
            #[doc = #in_about]
            #[inline(always)]
            fn #in_name<S: Real, P: Pack<S>>(
                k: &[S],
                x: &[S],
                a: usize,
                saved: &mut #saved,
                seen: &mut [S; #seen],
            ) {
                #inward
            }
            #[doc = #out_about]
            #[inline(always)]
            fn #out_name<S: Real, P: Pack<S>>(k: &[S], a: usize, saved: &#saved, out: &mut [S]) {
                let main = P::spread_all([out[0], out[1], out[2], out[3], out[4], out[5]]);
                #outward
            }
        }
    }

    /// The constants of a step, if it has any; those of link `i` if it is a link's step.
    fn constants(&self, step: &Placed, i: Option<&Ident>) -> Option<TokenStream> {
        let size = Some(step.traced.constants()).filter(|&size| size > 0)?;
        let (a, count) = (format_ident!("a"), self.group.count);
        let at = place(step.start, &[(size * count, i), (1, Some(&a))]);
        let count = Literal::usize_unsuffixed(count);
        Some(quote!(P::gather_all(k, #at, #count)))
    }

    /// The argument that hands a step taken once its constants, if it has any.
    fn argument(&self, step: &Placed) -> TokenStream {
        self.constants(step, None).map(|constants| quote!(#constants,)).unwrap_or_default()
    }

    /// What binds the constants of a link's step, and the argument that hands them on.
    fn of_link(&self, step: &Placed, i: Option<&Ident>) -> (TokenStream, TokenStream) {
        let constants = self.constants(step, i);
        constants.map(|k| (quote!(let link = #k;), quote!(link,))).unwrap_or_default()
    }

    /// A number of hinge `i` in the state: β, τ or torque by `row`.
    fn of_hinge(&self, row: usize, i: Option<&Ident>) -> TokenStream {
        let (a, count) = (format_ident!("a"), self.group.count);
        let start = Layout::STATE + Layout::HINGE * self.group.hinge + row * count;
        let at = place(start, &[(Layout::HINGE * count, i), (1, Some(&a))]);
        quote!(P::gather(x, #at))
    }

    fn chain_in(&self, chain: &Chain) -> TokenStream {
        let Chain { start, outward, inward, root, .. } = chain;
        let (angles, outward) = (self.angles(), self.links_outward(outward));
        let (inward, add) = (self.links_inward(inward), self.add(root));
        let (start_, root_) = (name(start), name(root));
        let [k_start, k_root] = [start, root].map(|step| self.argument(step));
        quote! {
            let omega = P::spread_all([x[0], x[1], x[2]]);
            let (w, mut reached) = #start_(#k_start omega);
            #angles
            #outward
            #inward
            let shares = #root_(#k_root shown, [outer]);
            #add
        }
    }

    fn angles(&self) -> TokenStream {
        let hinges = self.group.shape.hinges();
        let what = comment("Absolute angles, their sines and cosines.");
        let angles = repeated("i", hinges, false, |i| {
            let (beta, slot) = (self.of_hinge(0, i), slot(i));
            quote!(alpha += #beta; angles[#slot] = alpha;)
        });
        let hinges = Literal::usize_unsuffixed(hinges);
        quote! {
            #what
            let mut angles = [P::zero(); #hinges];
            let mut alpha = P::zero();
            #angles
            let turns = P::sin_cos_all(angles);
        }
    }

    fn links_outward(&self, step: &Placed) -> TokenStream {
        let (hinges, outward) = (self.group.shape.hinges(), name(step));
        let what = comment("Outward: links turned, their biases.");
        let links = repeated("i", hinges, false, |i| {
            let (bind, link) = self.of_link(step, i);
            let (tau, slot) = (self.of_hinge(1, i), slot(i));
            quote! {
                #bind
                let (sin, cos) = turns[#slot];
                let tau = #tau;
                (turned[#slot], reached) = #outward(#link w, [sin, cos], [tau], reached);
            }
        });
        let [size, hinges] = [step.traced.size(TURNED), hinges].map(Literal::usize_unsuffixed);
        quote! {
            #what
            let mut turned = [[P::zero(); #size]; #hinges];
            #links
        }
    }

    fn links_inward(&self, step: &Placed) -> TokenStream {
        let inward = name(step);
        let what = comment("Inward: hinges eliminated.");
        let links = repeated("i", self.group.shape.hinges(), true, |i| {
            let (bind, link) = self.of_link(step, i);
            let (torque, slot) = (self.of_hinge(2, i), slot(i));
            quote! {
                #bind
                let torque = #torque;
                (shown, saved[#slot]) = #inward(#link turned[#slot], [torque - outer], shown);
                outer = torque;
            }
        });
        let size = Literal::usize_unsuffixed(step.traced.size(SHOWN));
        quote! {
            #what
            let mut outer = P::zero();
            let mut shown = [P::zero(); #size];
            #links
        }
    }

    fn chain_out(&self, chain: &Chain) -> TokenStream {
        let Chain { first, back, .. } = chain;
        let (first_, back_, k_first) = (name(first), name(back), self.argument(first));
        let (a, count) = (format_ident!("a"), self.group.count);
        let output = Layout::OUTPUT + self.group.hinge;
        let links = repeated("i", self.group.shape.hinges(), false, |i| {
            let (at, slot) = (place(output, &[(count, i), (1, Some(&a))]), slot(i));
            quote! {
                let tau_dot;
                ([tau_dot], turning, hinge) = #back_(saved[#slot], turning, hinge);
                tau_dot.scatter(out, #at);
            }
        });
        quote! {
            let (mut turning, mut hinge) = #first_(#k_first main);
            #links
        }
    }

    fn paddle_in(&self, paddle: &Paddle) -> TokenStream {
        let Paddle { inward, .. } = paddle;
        let (inward_, k_inward) = (name(inward), self.argument(inward));
        let start = Layout::STATE + Layout::HINGE * self.group.hinge;
        let at = place(start, &[(1, Some(&format_ident!("a")))]);
        let (count, add) = (Literal::usize_unsuffixed(self.group.count), self.add(inward));
        quote! {
            let omega = P::spread_all([x[0], x[1], x[2]]);
            let hinges = P::gather_all(x, #at, #count);
            let shares;
            (shares, saved.0, saved.1) = #inward_(#k_inward omega, hinges);
            #add
        }
    }

    fn paddle_out(&self, paddle: &Paddle) -> TokenStream {
        let Paddle { first, back, .. } = paddle;
        let (first_, back_, k_first) = (name(first), name(back), self.argument(first));
        let output = Layout::OUTPUT + self.group.hinge;
        let at = place(output, &[(1, Some(&format_ident!("a")))]);
        let count = Literal::usize_unsuffixed(self.group.count);
        quote! {
            let (turning, hinge) = #first_(#k_first main);
            let tau_dot = #back_(saved.0, saved.1, turning, hinge);
            P::scatter_all(tau_dot, out, #at, #count);
        }
    }

    /// Adds the shares that a step returns to what is seen at O.
    fn add(&self, step: &Placed) -> TokenStream {
        let own = step.traced.live(AT_ORIGIN);
        let all = self.at_origin.iter().zip(own).filter(|(any, _)| **any).map(|(_, own)| *own);
        let places: Vec<usize> = all.enumerate().filter(|(_, own)| *own).map(|(i, _)| i).collect();
        let count = Literal::usize_unsuffixed(places.len());
        if places.iter().copied().eq(0..places.len()) {
            return quote!(for i in 0..#count { seen[i] += shares[i].sum(); });
        }
        let places = places.into_iter().map(Literal::usize_unsuffixed);
        quote! {
            let places = [#(#places),*];
            for i in 0..#count { seen[places[i]] += shares[i].sum(); }
        }
    }
}

/// Name of the function that takes a step.
fn name(step: &Placed) -> Ident {
    format_ident!("{}", step.traced.name)
}
