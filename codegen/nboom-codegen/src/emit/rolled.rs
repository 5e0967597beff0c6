//! A routine whose sweeps are loops over links, and over equal appendages side by side.

use nboom_formulation::Layout;
use nboom_formulation::stages::EXTERNAL;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::driver::Driver;
use crate::emit::item::{Item, Signature};
use crate::emit::places::{place, repeated};
use crate::emit::stage::Step;
use crate::emit::sweeps::Sweeps;
use crate::request::Level;
use crate::trace::{Chain, Equal, Paddle, Placed, Rolled, Steps};

/// The routine's items.
pub(crate) fn items(rolled: &Rolled, level: Level, signature: &Signature) -> TokenStream {
    let at_origin = rolled.at_origin.iter().filter(|live| **live).count();
    let sweeps: Vec<Sweeps> = rolled
        .groups
        .iter()
        .map(|(group, steps)| Sweeps::new(group, steps, &rolled.at_origin))
        .collect();
    let driver = Driver { calls: sweeps.iter().map(Sweeps::call).collect(), at_origin };
    let of_groups = rolled.groups.iter().map(|(group, steps)| prepare(group, steps, level));
    let of_main = quote!(let main: [R; 10] = R::gather_all(p, 0, 1););
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
    };
    let item = item.tokens();
    let steps = rolled.steps().into_iter().map(|placed| {
        let step = Step::new(&placed.traced, level);
        let (constants, function) = (step.constants_function(), step.function());
        quote!(#constants #function)
    });
    let sweeps = sweeps.iter().map(Sweeps::functions);
    let main_body = main_body(rolled, at_origin, signature.external);
    quote!(#item #main_body #(#sweeps)* #(#steps)*)
}

/// From `p` to `k` for a group of appendages.
fn prepare(group: &Equal, steps: &Steps, level: Level) -> TokenStream {
    let stride = group.parameters();
    let array = |name: &str, size: usize, at: TokenStream| {
        let (name, size) = (format_ident!("{name}"), Literal::usize_unsuffixed(size));
        quote!(let #name: [R; #size] = R::gather_all(p, #at, 1);)
    };
    repeated("a", group.count, false, |a| {
        let store = |step: &Placed, from: &str, i: Option<&Ident>| {
            let size = step.traced.constants() * group.count;
            let terms = [(size, i), (1, a)];
            store(step, &format_ident!("{from}"), group.count, &terms, level)
        };
        let branch = array("branch", Layout::BRANCH, place(group.parameter, &[(stride, a)]));
        match steps {
            Steps::Chain(chain) => {
                let Chain { start, outward, inward, root, first, .. } = chain.as_ref();
                let of_branch = [start, root, first].map(|step| store(step, "branch", None));
                let links = repeated("i", group.shape.hinges(), false, |i| {
                    let at = group.parameter + Layout::BRANCH;
                    let at = place(at, &[(stride, a), (Layout::LINK, i)]);
                    let link = array("link", Layout::LINK, at);
                    let of_link = [outward, inward].map(|step| store(step, "link", i));
                    quote!(#link #(#of_link)*)
                });
                quote!(#branch #(#of_branch)* #links)
            }
            Steps::Paddle(paddle) => {
                let Paddle { inward, first, .. } = paddle.as_ref();
                let at = place(group.parameter, &[(stride, a)]);
                let whole = array("whole", stride, at);
                let of_whole = store(inward, "whole", None);
                let of_branch = store(first, "branch", None);
                quote!(#whole #of_whole #branch #of_branch)
            }
        }
    })
}

/// Writes the constants of a step, computed from the array `from`; they stand `count` apart.
fn store(
    step: &Placed,
    from: &Ident,
    count: usize,
    terms: &[(usize, Option<&Ident>)],
    level: Level,
) -> TokenStream {
    if step.traced.constants() == 0 {
        return TokenStream::new();
    }
    let constants = Step::new(&step.traced, level).constants(from);
    let (at, count) = (place(step.start, terms), Literal::usize_unsuffixed(count));
    quote!(R::scatter_all(#constants, k, #at, #count);)
}

/// The function for the main body.
fn main_body(rolled: &Rolled, at_origin: usize, external: bool) -> TokenStream {
    let step = format_ident!("{}", rolled.base.traced.name);
    let constants = (rolled.base.traced.constants() > 0).then(|| {
        let start = Literal::usize_unsuffixed(rolled.base.start);
        quote!(P::gather_all(k, #start, 1),)
    });
    let external = external.then(|| {
        let places = (3..3 + EXTERNAL.size()).map(Literal::usize_unsuffixed);
        quote!(P::spread_all([#(x[#places]),*]),)
    });
    let size = Literal::usize_unsuffixed(at_origin);
    quote! {
        /// The main body: its accelerations from what all appendages show at O.
        #[inline(always)]
        fn main_body<S: Real, P: Pack<S>>(k: &[S], x: &[S], seen: [S; #size], out: &mut [S]) {
            let omega = P::spread_all([x[0], x[1], x[2]]);
            let rates = #step(#constants omega, #external P::spread_all(seen));
            P::scatter_all(rates, out, 0, 1);
        }
    }
}
