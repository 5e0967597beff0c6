//! A routine whose sweeps are loops over links, and over equal appendages side by side.

use nboom_formulation::stages::{EXTERNAL, OMEGA};
use nboom_formulation::{Layout, RightSideLayout};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::driver::{Beside, Driver};
use crate::emit::hinges::omega_spread;
use crate::emit::item::{Item, Signature};
use crate::emit::places::{place, repeated};
use crate::emit::stage::Step;
use crate::emit::sweeps::Sweeps;
use crate::emit::sweeps::joints::{Tables, prepared};
use crate::request::{Level, Output, Request};
use crate::trace::{
    Chain, Equal, Joints, Kind, Paddle, Placed, Rolled, Steps, TrunkSteps, own_places,
};

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

/// Binds the parameters of the main body, and of a right side the external wrench.
fn main_parameters(request: &Request) -> TokenStream {
    if request.output != Output::RightSide {
        return quote!(let main: [R; 10] = R::gather_all(p, 0, 1););
    }
    let external = RightSideLayout::external(&request.topology);
    let places = (0..Layout::MAIN).chain(external).map(Literal::usize_unsuffixed);
    quote!(let main = [#(p[#places]),*];)
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
        let laws = steps.law().filter(|_| !matches!(steps, Steps::Trunk(_))).map(|law| {
            let hinges = group.shape.hinges();
            repeated("i", hinges, false, |i| {
                let at = place(
                    group.law,
                    &[(RightSideLayout::LAW * hinges, a), (RightSideLayout::LAW, i)],
                );
                let array = array("law", RightSideLayout::LAW, at);
                let of_law = store(law, "law", i);
                quote!(#array #of_law)
            })
        });
        let branch = || array("branch", Layout::BRANCH, place(group.parameter, &[(stride, a)]));
        let whole = |steps: [&Placed; 2]| {
            let whole = array("whole", stride, place(group.parameter, &[(stride, a)]));
            let of_whole = steps.map(|step| store(step, "whole", None));
            quote!(#whole #(#of_whole)*)
        };
        let rest = match steps {
            Steps::Chain(chain) => {
                let Chain { start, outward, inward, root, first, .. } = chain.as_ref();
                let of_branch = [start].into_iter().chain(root).chain([first]);
                let of_branch = of_branch.map(|step| store(step, "branch", None));
                let links = repeated("i", group.shape.hinges(), false, |i| {
                    let at = group.parameter + Layout::BRANCH;
                    let at = place(at, &[(stride, a), (Layout::LINK, i)]);
                    let link = array("link", Layout::LINK, at);
                    let of_link = [outward, inward].map(|step| store(step, "link", i));
                    quote!(#link #(#of_link)*)
                });
                let branch = branch();
                quote!(#branch #(#of_branch)* #links)
            }
            Steps::Paddle(paddle) => {
                let Paddle { inward, first, .. } = paddle.as_ref();
                let at = place(group.parameter, &[(stride, a)]);
                let whole = array("whole", stride, at);
                let of_whole = store(inward, "whole", None);
                let (branch, of_branch) = (branch(), store(first, "branch", None));
                quote!(#whole #of_whole #branch #of_branch)
            }
            Steps::Limb(of) => whole([&of.inward, &of.back]),
            Steps::Part(of) => whole([&of.inward, &of.back]),
            Steps::Trunk(of) => prepare_trunk(group, of, level),
            Steps::Joints(joints) => {
                let Joints { start, root, first, .. } = joints.as_ref();
                let of_branch = [start].into_iter().chain(root).chain([first]);
                let of_branch = of_branch.map(|step| store(step, "branch", None));
                let number = format_ident!("number");
                let of_link = |step| store(step, "of_link", Some(&number));
                let size = |kind: &Kind| kind.parameters();
                let of_mount = prepared(&joints.mounts, size, group, of_link);
                let of_joint = prepared(&joints.joints, size, group, of_link);
                let tables = Tables::new(group, joints);
                let (mounts, joints) = (tables.mounts(), tables.joints());
                let (branch, links) = (branch(), Literal::usize_unsuffixed(group.shape.hinges()));
                quote! {
                    #branch #(#of_branch)*
                    for i in 0..#links {
                        if i > 0 {
                            let [_, kind, number, at] = #mounts[i];
                            #of_mount
                        }
                        let [kind, number, at] = #joints[i];
                        #of_joint
                    }
                }
            }
        };
        quote!(#laws #rest)
    })
}

/// From `p` to `k` for a limb with equal parts.
fn prepare_trunk(group: &Equal, steps: &TrunkSteps, level: Level) -> TokenStream {
    let TrunkSteps { trunk, law, outward, inward, back, parts } = steps;
    let laws = law.iter().flat_map(|law| {
        trunk.numbers().iter().enumerate().map(|(n, &hinge)| {
            let at = Literal::usize_unsuffixed(group.law + RightSideLayout::LAW * hinge);
            let size = Literal::usize_unsuffixed(RightSideLayout::LAW);
            let from = format_ident!("law");
            let k = place(law.start + n * law.traced.constants(), &[]);
            let of_law = store_at(law, &from, (k, 1), level);
            quote!(let #from: [R; #size] = R::gather_all(p, #at, 1); #of_law)
        })
    });
    let from = format_ident!("trunk");
    let places: Vec<usize> = own_places(group, trunk).collect();
    let mut start = 0;
    let runs = places.chunk_by(|a, b| a + 1 == *b).map(|run| {
        let end = start + run.len();
        let [own, own_end, first, first_end] =
            [std::mem::replace(&mut start, end), end, run[0], run[0] + run.len()]
                .map(Literal::usize_unsuffixed);
        quote!(#from[#own..#own_end].copy_from_slice(&p[#first..#first_end]);)
    });
    let runs: TokenStream = runs.collect();
    let size = Literal::usize_unsuffixed(places.len());
    let of_trunk = [outward, inward, back].map(|step| store(step, &from, 1, &[], level));
    let parts = parts.iter().map(|(group, steps)| prepare(group, steps, level));
    quote! {
        #(#laws)*
        let mut #from = [R::zero(); #size];
        #runs
        #(#of_trunk)*
        #(#parts)*
    }
}

/// Writes the constants of a step, computed from the array `from`; they stand `count` apart.
fn store(
    step: &Placed,
    from: &Ident,
    count: usize,
    terms: &[(usize, Option<&Ident>)],
    level: Level,
) -> TokenStream {
    let at = place(step.start, terms);
    store_at(step, from, (at, count), level)
}

/// Writes the constants of a step from a place on, so far apart.
fn store_at(
    step: &Placed,
    from: &Ident,
    (at, apart): (TokenStream, usize),
    level: Level,
) -> TokenStream {
    if step.traced.constants() == 0 {
        return TokenStream::new();
    }
    let constants = Step::new(&step.traced, level).constants(from);
    let apart = Literal::usize_unsuffixed(apart);
    quote!(R::scatter_all(#constants, k, #at, #apart);)
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
