//! A routine whose sweeps are loops over links, and over equal appendages side by side.

mod prepare;

use nboom_formulation::stages::{EXTERNAL, OMEGA};
use nboom_formulation::{Layout, RightSideLayout};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::driver::{Beside, Call, Driver};
use crate::emit::hinges::omega_spread;
use crate::emit::item::{Item, Signature};
use crate::emit::rolled::prepare::{prepare, store};
use crate::emit::stage::Step;
use crate::emit::sweeps::Sweeps;
use crate::request::{Output, Request};
use crate::trace::Rolled;

/// The routine's items.
pub(crate) fn items(rolled: &Rolled, request: &Request, signature: &Signature) -> TokenStream {
    let level = request.level;
    let at_origin = rolled.at_origin.iter().filter(|live| **live).count();
    let groups = rolled.groups.iter();
    let sweeps: Vec<Sweeps> =
        groups.map(|group| Sweeps::new(request, group, &rolled.at_origin)).collect();
    let calls = sweeps.iter().map(Sweeps::call).collect();
    let driver = Driver { calls, at_origin, beside: beside(request) };
    let of_groups = rolled.groups.iter().map(|(group, steps)| prepare(group, steps, level));
    let of_main = main_parameters(request);
    let base = store(&rolled.base, &format_ident!("main"), 1, &[], level);
    let (on_any, in_packs) = (driver.on_any_scalar(), driver.in_packs());
    let [sized, sized_for_packs] =
        [quote!(R), quote!(f64)].map(|of| signature.sized(rolled.constants, &of));
    let item = Item {
        signature,
        constants: rolled.constants,
        prepare: quote!(#(#of_groups)* #of_main #base),
        evaluate: quote!(#sized #on_any),
        evaluate_packed: quote!(#sized_for_packs #in_packs),
        in_packs: driver.calls.iter().any(Call::takes_side_by_side),
    };
    let item = item.tokens();
    let steps = rolled.steps().into_iter().map(|placed| {
        let step = Step::new(&placed.traced, level);
        let (constants, function) = (step.constants_function(), step.function());
        quote!(#constants #function)
    });
    let sweeps = sweeps.iter().map(Sweeps::functions);
    let main_body = main_body(rolled, at_origin, request);
    quote!(#item #main_body #(#sweeps)* #(#steps)*)
}

/// What a right side writes beside accelerations.
fn beside(request: &Request) -> Option<Beside> {
    let topology = &request.topology;
    (request.output == Output::RightSide).then(|| Beside {
        beta: RightSideLayout::beta(topology),
        tau: RightSideLayout::tau(topology),
        power: RightSideLayout::power(topology),
    })
}

/// Binds the parameters of the main body, and of a right side the external wrench and the momentum of rotors.
fn main_parameters(request: &Request) -> TokenStream {
    if request.output != Output::RightSide {
        return quote!(let main: [R; 10] = R::gather_all(p, 0, 1););
    }
    let external = RightSideLayout::external(&request.topology);
    let acting = external.start..RightSideLayout::spin(&request.topology).end;
    let places = (0..Layout::MAIN).chain(acting).map(Literal::usize_unsuffixed);
    quote!(let main = [#(p[#places]),*];)
}

/// The function for the main body.
fn main_body(rolled: &Rolled, at_origin: usize, request: &Request) -> TokenStream {
    let step = format_ident!("{}", rolled.base.traced.name);
    let constants = (rolled.base.traced.constants() > 0).then(|| {
        let start = Literal::usize_unsuffixed(rolled.base.start);
        quote!(P::gather_all(k, #start, 1),)
    });
    let omega = omega_spread(request.output);
    let read = rolled.base.traced.reads().map(|group| match group {
        OMEGA => quote!(omega),
        EXTERNAL => {
            let places = (3..3 + EXTERNAL.size()).map(Literal::usize_unsuffixed);
            quote!(P::spread_all([#(x[#places]),*]))
        }
        _ => quote!(P::spread_all(seen)),
    });
    let write = match &rolled.attitude {
        None => quote!(P::scatter_all(rates, out, 0, 1);),
        Some(attitude) => {
            let attitude = format_ident!("{}", attitude.traced.name);
            let at = Literal::usize_unsuffixed(RightSideLayout::OMEGA.start);
            quote! {
                let attitude = P::spread_all([x[0], x[1], x[2], x[3]]);
                P::scatter_all(#attitude(attitude, omega), out, 0, 1);
                P::scatter_all([rates[0], rates[1], rates[2]], out, #at, 1);
            }
        }
    };
    let main = (0..6).map(Literal::usize_unsuffixed);
    let size = Literal::usize_unsuffixed(at_origin);
    quote! {
        /// The main body: its accelerations from what all appendages show at O.
        #[inline(always)]
        fn main_body<S: Real, P: Pack<S>>(
            k: &[S],
            x: &[S],
            seen: [S; #size],
            out: &mut [S],
        ) -> [S; 6] {
            let omega = #omega;
            let rates = #step(#constants #(#read),*);
            #write
            [#(rates[#main].sum()),*]
        }
    }
}
