//! Torques about the hinges of an appendage by their laws, of a right side.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::emit::comment::comment;
use crate::emit::places::{place, repeated, slot};
use crate::emit::sweeps::{Sweeps, name};
use crate::trace::Placed;

impl Sweeps<'_> {
    /// Torques about all hinges of an appendage, and their power, of a right side.
    pub(super) fn laws(
        &self,
        law: Option<&Placed>,
        coupling: Option<&Placed>,
    ) -> Option<TokenStream> {
        let step = law?;
        let (hinges, law) = (self.group.shape.hinges(), name(step));
        let what = comment("Torques of springs and dashpots, and their power.");
        let laws = repeated("i", hinges, false, |i| {
            let (bind, constants) = self.of_link(step, i);
            let [beta, tau] = [self.hinges().beta((0, i)), self.hinges().tau((0, i))];
            let slot = slot(i);
            quote! {
                #bind
                let ([torque], [work]) = #law(#constants [#beta], [#tau]);
                torques[#slot] = torque;
                of_appendage += work;
            }
        });
        let couplings = coupling.map(|step| self.couplings(step));
        let hinges = Literal::usize_unsuffixed(hinges);
        Some(quote! {
            #what
            let mut torques = [P::zero(); #hinges];
            let mut of_appendage = P::zero();
            #laws
            #couplings
            *power += of_appendage.sum();
        })
    }

    /// Adds the torques of couplings of the hinges of a chain, and their power.
    fn couplings(&self, step: &Placed) -> TokenStream {
        let coupling = name(step);
        let what = comment("Couplings of each hinge with the one inboard of it.");
        let all = repeated("i", self.group.shape.hinges() - 1, false, |i| {
            let (bind, constants) = self.of_link(step, i);
            let [beta, inboard_beta] = [1, 0].map(|own| self.hinges().beta((own, i)));
            let [tau, inboard_tau] = [1, 0].map(|own| self.hinges().tau((own, i)));
            let [own, inboard] = [1, 0].map(|own| place(own, &[(1, i)]));
            quote! {
                #bind
                let ([torque], [inboard_torque], [work]) =
                    #coupling(#constants [#beta], [#inboard_beta], [#tau], [#inboard_tau]);
                torques[#own] += torque;
                torques[#inboard] += inboard_torque;
                of_appendage += work;
            }
        });
        quote!(#what #all)
    }
}
