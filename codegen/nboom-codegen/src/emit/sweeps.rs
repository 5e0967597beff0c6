//! Functions that take one appendage, or several side by side, through the sweeps.

pub(crate) mod joints;
mod laws;
mod trunk;

use nboom_formulation::stages::{
    AT_ORIGIN, ELIMINATED, JOINT, LIMB, OUTBOARD_SHARE, PADDLE, TURNED, of_limb,
};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::comment::comment;
use crate::emit::driver::{Call, saved};
use crate::emit::hinges::{Hinges, omega_spread};
use crate::emit::places::{place, repeated, slot};
use crate::emit::stage::one_or_all;
use crate::request::{Output, Request};
use crate::trace::{Chain, Equal, LimbSteps, Paddle, Placed, Steps};

/// The sweeps of a group of equal appendages.
pub(crate) struct Sweeps<'a> {
    request: &'a Request,
    group: &'a Equal,
    steps: &'a Steps,
    /// Which numbers at O any group shows.
    at_origin: &'a [bool],
}

impl<'a> Sweeps<'a> {
    pub fn new(
        request: &'a Request,
        (group, steps): &'a (Equal, Steps),
        at_origin: &'a [bool],
    ) -> Self {
        Self { request, group, steps, at_origin }
    }

    fn hinges(&self) -> Hinges<'a> {
        let Request { topology, output, .. } = self.request;
        Hinges { group: self.group, topology, output: *output }
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
            Steps::Limb(limb) => {
                vec![(limb.inward.traced.size(of_limb(LIMB, &limb.limb)), None)]
            }
            Steps::Joints(joints) => {
                let left = joints.joints[0].inward.traced.size(JOINT);
                vec![(left, Some(self.group.shape.hinges()))]
            }
            Steps::Trunk(of) => vec![(of.inward.traced.size(of.trunk.of_links(LIMB)), None)],
            Steps::Part(of) => vec![(of.inward.traced.size(of_limb(LIMB, &of.part)), None)],
        };
        let (parts, limb) = match self.steps {
            Steps::Trunk(trunk) => (Some(self.calls_of_parts(trunk)), None),
            Steps::Part(part) => (None, Some(part.limb.clone())),
            _ => (None, None),
        };
        Call { prefix: self.group.prefix(), count: self.group.count, saved, parts, limb }
    }

    /// Both functions, and those of parts.
    pub fn functions(&self) -> TokenStream {
        let (inward, outward) = match self.steps {
            Steps::Trunk(trunk) => return self.trunk_functions(trunk),
            Steps::Part(part) => return self.part_functions(part),
            Steps::Chain(chain) => (self.chain_in(chain), self.chain_out(chain)),
            Steps::Paddle(paddle) => (self.paddle_in(paddle), self.paddle_out(paddle)),
            Steps::Limb(limb) => (self.limb_in(limb), self.limb_out(limb)),
            Steps::Joints(joints) => (self.joints_in(joints), self.joints_out(joints)),
        };
        let tables = match self.steps {
            Steps::Joints(joints) => Some(self.tables(joints)),
            _ => None,
        };
        let (saved, prefix) = (saved(&self.call().saved, &quote!(P)), self.group.prefix());
        let (in_name, out_name) = (format_ident!("{prefix}_in"), format_ident!("{prefix}_out"));
        let seen = Literal::usize_unsuffixed(self.at_origin.iter().filter(|live| **live).count());
        let (count, shape) = (self.group.count, self.group.shape_name());
        let taken = match count {
            1 => format!("the appendage {shape}"),
            _ => format!("appendage `a` of {count} {shape} and those packed with it"),
        };
        let power = self.power();
        let in_about = format!(" Inward through {taken}; adds to `seen`.");
        let out_about = format!(" Outward through {taken}.");
        quote! {
            #tables
            #[doc = #in_about]
            #[inline(always)]
            fn #in_name<S: Real, P: Pack<S>>(
                k: &[S],
                x: &[S],
                a: usize,
                saved: &mut #saved,
                seen: &mut [S; #seen],
                #power
            ) {
                #inward
            }
            #[doc = #out_about]
            #[inline(always)]
            fn #out_name<S: Real, P: Pack<S>>(
                k: &[S],
                a: usize,
                saved: &#saved,
                main: [S; 6],
                out: &mut [S],
            ) {
                let main = P::spread_all(main);
                #outward
            }
        }
    }

    /// The argument for the power, of a right side.
    fn power(&self) -> Option<TokenStream> {
        (self.request.output == Output::RightSide).then(|| quote!(power: &mut S,))
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

    fn chain_in(&self, chain: &Chain) -> TokenStream {
        let Chain { start, outward, inward, root, .. } = chain;
        let (angles, laws) =
            (self.angles(), self.laws(chain.law.as_ref(), chain.coupling.as_ref()));
        let outward = self.links_outward(outward);
        let inward = self.links_inward(inward, chain.law.is_some());
        let omega = omega_spread(self.request.output);
        let (start_, k_start) = (name(start), self.argument(start));
        let shown = self.shown(root.as_ref(), &quote!(share, [outer]));
        quote! {
            let omega = #omega;
            let (w, mut reached) = #start_(#k_start omega);
            #angles
            #laws
            #outward
            #inward
            #shown
        }
    }

    fn angles(&self) -> TokenStream {
        let hinges = self.group.shape.hinges();
        let what = comment("Absolute angles, their sines and cosines.");
        let angles = repeated("i", hinges, false, |i| {
            let (beta, slot) = (self.hinges().beta((0, i)), slot(i));
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
            let (tau, slot) = (self.hinges().tau((0, i)), slot(i));
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

    fn links_inward(&self, step: &Placed, has_laws: bool) -> TokenStream {
        let inward = name(step);
        let what = comment("Inward: hinges eliminated.");
        let links = repeated("i", self.group.shape.hinges(), true, |i| {
            let (bind, link) = self.of_link(step, i);
            let slot = slot(i);
            let torque =
                if has_laws { quote!(torques[#slot]) } else { self.hinges().torque((0, i)) };
            quote! {
                #bind
                let torque = #torque;
                (share, saved[#slot]) = #inward(#link turned[#slot], [torque - outer], share);
                outer = torque;
            }
        });
        let size = Literal::usize_unsuffixed(step.traced.size(OUTBOARD_SHARE));
        quote! {
            #what
            let mut outer = P::zero();
            let mut share = [P::zero(); #size];
            #links
        }
    }

    fn chain_out(&self, chain: &Chain) -> TokenStream {
        let Chain { first, back, .. } = chain;
        let (first_, back_, k_first) = (name(first), name(back), self.argument(first));
        let links = repeated("i", self.group.shape.hinges(), false, |i| {
            let (write, slot) = (self.hinges().write(&format_ident!("tau_dot"), (0, i)), slot(i));
            quote! {
                let tau_dot;
                ([tau_dot], turning, hinge) = #back_(saved[#slot], turning, hinge);
                #write
            }
        });
        quote! {
            let (mut turning, mut hinge) = #first_(#k_first main);
            #links
        }
    }

    fn paddle_in(&self, Paddle { law, inward, .. }: &Paddle) -> TokenStream {
        self.whole_in(law.as_ref(), inward, &[quote!(saved.0), quote!(saved.1)])
    }

    fn limb_in(&self, LimbSteps { law, inward, .. }: &LimbSteps) -> TokenStream {
        self.whole_in(law.as_ref(), inward, &[quote!(*saved)])
    }

    /// Inward through a whole appendage in one step, which writes what it is `kept` for the way back.
    fn whole_in(&self, law: Option<&Placed>, inward: &Placed, kept: &[TokenStream]) -> TokenStream {
        let (inward_, k_inward) = (name(inward), self.argument(inward));
        let (laws, hinges) = (self.laws(law, None), self.whole_hinges(law.is_some()));
        let omega = omega_spread(self.request.output);
        let taken =
            self.shown_with(kept, |written| quote!(#written = #inward_(#k_inward omega, hinges);));
        quote! {
            let omega = #omega;
            #laws
            let hinges = [#(#hinges),*];
            #taken
        }
    }

    /// β, τ and torque of each hinge.
    fn whole_hinges(&self, has_laws: bool) -> Vec<TokenStream> {
        let of_hinge = |number: usize| {
            let (hinge, slot) = ((number, None), Literal::usize_unsuffixed(number));
            let [beta, tau] = [self.hinges().beta(hinge), self.hinges().tau(hinge)];
            let torque =
                if has_laws { quote!(torques[#slot]) } else { self.hinges().torque(hinge) };
            quote!(#beta, #tau, #torque)
        };
        (0..self.group.shape.hinges()).map(of_hinge).collect()
    }

    fn limb_out(&self, limb: &LimbSteps) -> TokenStream {
        let LimbSteps { back, .. } = limb;
        let (back_, k_back) = (name(back), self.argument(back));
        let names: Vec<Ident> =
            (1..=self.group.shape.hinges()).map(|i| format_ident!("tau_dot_{i}")).collect();
        let writes = names.iter().enumerate().map(|(i, name)| self.hinges().write(name, (i, None)));
        quote! {
            let [#(#names),*] = #back_(#k_back *saved, main);
            #(#writes)*
        }
    }

    fn paddle_out(&self, paddle: &Paddle) -> TokenStream {
        let Paddle { first, back, .. } = paddle;
        let (first_, back_, k_first) = (name(first), name(back), self.argument(first));
        let names = [format_ident!("of_arm"), format_ident!("of_paddle")];
        let [arm, outer] = [0, 1].map(|i| self.hinges().write(&names[i], (i, None)));
        quote! {
            let (turning, hinge) = #first_(#k_first main);
            let [#(#names),*] = #back_(saved.0, saved.1, turning, hinge);
            #arm
            #outer
        }
    }

    /// The step that tells what an appendage shows at O, with its arguments, if that is asked.
    fn shown(&self, root: Option<&Placed>, arguments: &TokenStream) -> Option<TokenStream> {
        root.map(|root| {
            let (root_, k_root, add) = (name(root), self.argument(root), self.add());
            quote!(let shares = #root_(#k_root #arguments); #add)
        })
    }

    /// The inward step of a whole appendage, which writes what it is `kept` for the way back after what it shows
    /// at O, if that is asked.
    fn shown_with(
        &self,
        kept: &[TokenStream],
        take: impl Fn(TokenStream) -> TokenStream,
    ) -> TokenStream {
        if self.steps.shows().is_none() {
            return take(one_or_all(kept.to_vec()));
        }
        let (taken, add) = (take(quote!((shares, #(#kept),*))), self.add());
        quote!(let shares; #taken #add)
    }

    /// Adds the shares of an appendage to what is seen at O.
    fn add(&self) -> TokenStream {
        let Some(shows) = self.steps.shows() else { return TokenStream::new() };
        let own = shows.traced.live(AT_ORIGIN);
        let all = self.at_origin.iter().zip(own).filter(|(any, _)| **any).map(|(_, own)| *own);
        let places: Vec<usize> = all.enumerate().filter(|(_, own)| *own).map(|(i, _)| i).collect();
        added(&format_ident!("seen"), &places)
    }
}

/// Adds what is shown to the numbers of `sums` at these places.
fn added(sums: &Ident, places: &[usize]) -> TokenStream {
    let count = Literal::usize_unsuffixed(places.len());
    let start = places.first().copied().unwrap_or_default();
    if places.iter().copied().eq(start..start + places.len()) {
        let i = format_ident!("i");
        let at = place(start, &[(1, Some(&i))]);
        return quote!(for i in 0..#count { #sums[#at] += shares[i].sum(); });
    }
    let places = places.iter().copied().map(Literal::usize_unsuffixed);
    quote! {
        let places = [#(#places),*];
        for i in 0..#count { #sums[places[i]] += shares[i].sum(); }
    }
}

/// Name of the function that takes a step.
fn name(step: &Placed) -> Ident {
    format_ident!("{}", step.traced.name)
}
