//! Sweeps through limbs whose equal parts are taken side by side: outward through the trunk, inward through all parts
//! and the trunk, and back.

use nboom_formulation::stages::{CARRIER, CARRIER_RATES, Group, KEPT, LIMB, OUTBOARD, of_limb};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::comment::comment;
use crate::emit::driver::Parts;
use crate::emit::hinges::omega_spread;
use crate::emit::places::place;
use crate::emit::sweeps::{Sweeps, added, name};
use crate::trace::{Among, PartSteps, Placed, TrunkSteps};

impl<'a> Sweeps<'a> {
    fn parts(&self, trunk: &'a TrunkSteps) -> impl Iterator<Item = Self> {
        trunk.parts.iter().map(|part| Sweeps::new(self.request, part, self.at_origin))
    }

    /// How the sweeps of the trunk call those of parts.
    pub(super) fn calls_of_parts(&self, trunk: &'a TrunkSteps) -> Parts {
        let shown = handed_in(&trunk.inward, trunk.trunk.of_carriers(OUTBOARD));
        Parts { calls: self.parts(trunk).map(|part| part.call()).collect(), shown }
    }

    pub(super) fn trunk_functions(&self, of: &'a TrunkSteps) -> TokenStream {
        let [carry, inward, outward] =
            [self.carry_through_trunk(of), self.in_through_trunk(of), self.out_through_trunk(of)];
        let parts = self.parts(of).map(|part| part.functions());
        quote!(#carry #inward #outward #(#parts)*)
    }

    fn carry_through_trunk(&self, of: &TrunkSteps) -> TokenStream {
        let TrunkSteps { trunk, outward, .. } = of;
        let function = format_ident!("{}_carry", self.group.prefix());
        let about = format!(
            " Outward through the trunk of {}: what is kept of its links, and how those move that carry parts.",
            self.group.shape_name()
        );
        let kept = literal(outward.traced.size(trunk.of_links(KEPT)));
        let carriers = outward.traced.size(trunk.of_carriers(CARRIER));
        let (of_carriers, carriers) = ((0..carriers).map(literal), literal(carriers));
        let omega = omega_spread(self.request.output);
        let rates = trunk.numbers().iter().map(|&i| {
            let [beta, tau] = [self.hinges().beta((i, None)), self.hinges().tau((i, None))];
            quote!(#beta, #tau)
        });
        let (outward_, k_outward) = (name(outward), self.argument(outward));
        quote! {
            #[doc = #about]
            #[inline(always)]
            fn #function<S: Real, P: Pack<S>>(k: &[S], x: &[S], a: usize) -> ([P; #kept], [S; #carriers]) {
                let omega = #omega;
                let rates = [#(#rates),*];
                let (kept, carriers) = #outward_(#k_outward omega, rates);
                (kept, [#(carriers[#of_carriers].sum()),*])
            }
        }
    }

    fn in_through_trunk(&self, of: &TrunkSteps) -> TokenStream {
        let TrunkSteps { trunk, outward, inward, .. } = of;
        let function = format_ident!("{}_in", self.group.prefix());
        let about =
            format!(" Inward through the trunk of {}; adds to `seen`.", self.group.shape_name());
        let kept = literal(outward.traced.size(trunk.of_links(KEPT)));
        let shown = literal(handed_in(inward, trunk.of_carriers(OUTBOARD)));
        let left = literal(inward.traced.size(trunk.of_links(LIMB)));
        let seen = literal(self.at_origin.iter().filter(|live| **live).count());
        let power = self.power();
        let (laws, torques) = self.torques_of_trunk(of);
        let (inward_, k_inward) = (name(inward), self.argument(inward));
        let taken = self.shown_with(
            &[quote!(*saved)],
            |written| quote!(#written = #inward_(#k_inward kept, torques, P::spread_all(*shown));),
        );
        quote! {
            #[doc = #about]
            #[inline(always)]
            fn #function<S: Real, P: Pack<S>>(
                k: &[S],
                x: &[S],
                a: usize,
                kept: [P; #kept],
                shown: &[S; #shown],
                saved: &mut [P; #left],
                seen: &mut [S; #seen],
                #power
            ) {
                #laws
                let torques = [#(#torques),*];
                #taken
            }
        }
    }

    fn out_through_trunk(&self, of: &TrunkSteps) -> TokenStream {
        let TrunkSteps { trunk, inward, back, .. } = of;
        let function = format_ident!("{}_out", self.group.prefix());
        let about = format!(
            " Outward through the trunk of {}: the accelerations of links that carry parts.",
            self.group.shape_name()
        );
        let left = literal(inward.traced.size(trunk.of_links(LIMB)));
        let carried_at = back.traced.size(trunk.of_carriers(CARRIER_RATES));
        let (of_rates, carried_at) = ((0..carried_at).map(literal), literal(carried_at));
        let numbers = trunk.numbers();
        let names: Vec<Ident> = (1..=numbers.len()).map(|i| format_ident!("tau_dot_{i}")).collect();
        let writes =
            numbers.iter().zip(&names).map(|(&i, name)| self.hinges().write(name, (i, None)));
        let (back_, k_back) = (name(back), self.argument(back));
        quote! {
            #[doc = #about]
            #[inline(always)]
            fn #function<S: Real, P: Pack<S>>(
                k: &[S],
                a: usize,
                saved: &[P; #left],
                main: [S; 6],
                out: &mut [S],
            ) -> [S; #carried_at] {
                let main = P::spread_all(main);
                let ([#(#names),*], carried_at) = #back_(#k_back *saved, main);
                #(#writes)*
                [#(carried_at[#of_rates].sum()),*]
            }
        }
    }

    /// What computes the torques about the joints of the trunk, and these.
    fn torques_of_trunk(&self, of: &TrunkSteps) -> (Option<TokenStream>, Vec<TokenStream>) {
        let numbers = of.trunk.numbers();
        let Some(law) = &of.law else {
            return (None, numbers.iter().map(|&i| self.hinges().torque((i, None))).collect());
        };
        let what = comment("Torques of springs and dashpots, and their power.");
        let names: Vec<Ident> = (1..=numbers.len()).map(|i| format_ident!("torque_{i}")).collect();
        let laws = numbers.iter().enumerate().map(|(n, &i)| {
            let (size, law_) = (law.traced.constants(), name(law));
            let constants = (size > 0).then(|| {
                let at = place(law.start + n * size, &[]);
                quote!(P::gather_all(k, #at, 1),)
            });
            let [beta, tau] = [self.hinges().beta((i, None)), self.hinges().tau((i, None))];
            let torque = &names[n];
            quote! {
                let ([#torque], [work]) = #law_(#constants [#beta], [#tau]);
                *power += work.sum();
            }
        });
        let laws = quote!(#what #(#laws)*);
        (Some(laws), names.iter().map(|name| quote!(#name)).collect())
    }

    pub(super) fn part_functions(&self, of: &PartSteps) -> TokenStream {
        let PartSteps { part, law, inward, back, carrier, shown, carried_at, .. } = of;
        let prefix = self.group.prefix();
        let [in_name, out_name] = ["in", "out"].map(|sweep| format_ident!("{prefix}_{sweep}"));
        let [carriers, all_shown, all_carried] =
            [carrier, shown, carried_at].map(|among| literal(among.all));
        let left = literal(inward.traced.size(of_limb(LIMB, part)));
        let laws = self.laws(law.as_ref(), None);
        let hinges = self.whole_hinges(law.is_some());
        let [inward_, back_] = [inward, back].map(name);
        let [k_inward, k_back] = [inward, back].map(|step| self.argument(step));
        let [of_carrier, of_rates] = [(carrier, "carriers"), (carried_at, "carried_at")]
            .map(|(among, all)| picked(among, &format_ident!("{all}")));
        let shows = added(&format_ident!("shown"), &shown.places);
        let names: Vec<Ident> =
            (1..=part.links().len()).map(|i| format_ident!("tau_dot_{i}")).collect();
        let writes = names.iter().enumerate().map(|(i, name)| self.hinges().write(name, (i, None)));
        let taken = format!(
            "part `a` of {} {} and those packed with it",
            self.group.count,
            self.group.shape_name()
        );
        let in_about = format!(" Inward through {taken}; adds to what is `shown` to the trunk.");
        let out_about = format!(" Outward through {taken}.");
        let power = self.power();
        quote! {
            #[doc = #in_about]
            #[inline(always)]
            fn #in_name<S: Real, P: Pack<S>>(
                k: &[S],
                x: &[S],
                a: usize,
                carriers: &[S; #carriers],
                saved: &mut [P; #left],
                shown: &mut [S; #all_shown],
                #power
            ) {
                #laws
                let hinges = [#(#hinges),*];
                let (shares, left) = #inward_(#k_inward P::spread_all(#of_carrier), hinges);
                *saved = left;
                #shows
            }
            #[doc = #out_about]
            #[inline(always)]
            fn #out_name<S: Real, P: Pack<S>>(
                k: &[S],
                a: usize,
                saved: &[P; #left],
                carriers: &[S; #carriers],
                carried_at: &[S; #all_carried],
                out: &mut [S],
            ) {
                let carrier = P::spread_all(#of_carrier);
                let [#(#names),*] = #back_(#k_back carrier, *saved, P::spread_all(#of_rates));
                #(#writes)*
            }
        }
    }
}

/// The numbers of one carrier.
fn picked(among: &Among, all: &Ident) -> TokenStream {
    let places = among.places.iter().copied().map(literal);
    quote!([#(#all[#places]),*])
}

/// How many numbers of a group are handed in to a step.
fn handed_in(step: &Placed, group: Group) -> usize {
    step.traced.mask(group).iter().filter(|live| **live).count()
}

fn literal(number: usize) -> Literal {
    Literal::usize_unsuffixed(number)
}
