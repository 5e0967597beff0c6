//! The preparation of loops: from the parameters of a satellite to the constants of all steps.

use nboom_formulation::{Layout, RightSideLayout};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::places::{place, repeated};
use crate::emit::stage::Step;
use crate::emit::sweeps::joints::{Tables, prepared};
use crate::request::Level;
use crate::trace::{Chain, Equal, Joints, Kind, Paddle, Placed, Steps, TrunkSteps, own_places};

/// From `p` to `k` for a group of appendages.
pub(super) fn prepare(group: &Equal, steps: &Steps, level: Level) -> TokenStream {
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
        let laws = steps.law().map(|law| {
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
        let branch = |steps: &[&Placed]| {
            let at = place(group.parameter, &[(stride, a)]);
            let branch = array("branch", Layout::BRANCH, at);
            let of_branch = steps.iter().map(|step| store(step, "branch", None));
            quote!(#branch #(#of_branch)*)
        };
        let whole = |steps: &[&Placed]| {
            let whole = array("whole", stride, place(group.parameter, &[(stride, a)]));
            let of_whole = steps.iter().map(|step| store(step, "whole", None));
            quote!(#whole #(#of_whole)*)
        };
        let rest = match steps {
            Steps::Chain(chain) => {
                let Chain { coupling, start, outward, inward, root, first, .. } = chain.as_ref();
                let couplings = coupling.as_ref().map(|coupling| {
                    let hinges = group.shape.hinges();
                    repeated("i", hinges - 1, false, |i| {
                        let size = RightSideLayout::COUPLING;
                        let at = place(group.coupling + size, &[(size * hinges, a), (size, i)]);
                        let (array, of_coupling) =
                            (array("coupling", size, at), store(coupling, "coupling", i));
                        quote!(#array #of_coupling)
                    })
                });
                let of_branch = branch(&with_root(start, root, first));
                let links = repeated("i", group.shape.hinges(), false, |i| {
                    let at = group.parameter + Layout::BRANCH;
                    let at = place(at, &[(stride, a), (Layout::LINK, i)]);
                    let link = array("link", Layout::LINK, at);
                    let of_link = [outward, inward].map(|step| store(step, "link", i));
                    quote!(#link #(#of_link)*)
                });
                quote!(#couplings #of_branch #links)
            }
            Steps::Paddle(paddle) => {
                let Paddle { inward, first, .. } = paddle.as_ref();
                let (of_whole, of_branch) = (whole(&[inward]), branch(&[first]));
                quote!(#of_whole #of_branch)
            }
            Steps::Limb(of) => whole(&[&of.inward, &of.back]),
            Steps::Part(of) => whole(&[&of.inward, &of.back]),
            Steps::Trunk(of) => prepare_trunk(group, of, level),
            Steps::Joints(joints) => {
                let Joints { start, root, first, .. } = joints.as_ref();
                let of_branch = branch(&with_root(start, root, first));
                let number = format_ident!("number");
                let of_link = |step| store(step, "of_link", Some(&number));
                let size = |kind: &Kind| kind.parameters();
                let of_mount = prepared(&joints.mounts, size, group, of_link);
                let of_joint = prepared(&joints.joints, size, group, of_link);
                let tables = Tables::new(group, joints);
                let (mounts, joints) = (tables.mounts(), tables.joints());
                let links = Literal::usize_unsuffixed(group.shape.hinges());
                quote! {
                    #of_branch
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

/// The steps at the mount of an appendage; `root` where something asks what is seen at O.
fn with_root<'a>(
    start: &'a Placed,
    root: &'a Option<Placed>,
    first: &'a Placed,
) -> Vec<&'a Placed> {
    [start].into_iter().chain(root).chain([first]).collect()
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
pub(super) fn store(
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
