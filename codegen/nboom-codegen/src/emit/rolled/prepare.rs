//! The preparation of loops: from the parameters of a satellite to the constants of all steps.

use nboom_formulation::{Layout, RightSideLayout};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::places::{place, repeated};
use crate::emit::stage::Step;
use crate::emit::sweeps::joints::{Tables, prepared};
use crate::request::Level;
use crate::trace::{Chain, Equal, Joints, Kind, Placed, Steps, TrunkSteps, own_places};

/// From `p` to `k` for a group of appendages.
pub(super) fn prepare(group: &Equal, steps: &Steps, level: Level) -> TokenStream {
    repeated("a", group.count, false, |a| {
        let of = Appendage { group, a, level };
        let laws = steps.law().map(|law| of.laws(law));
        let rest = match steps {
            Steps::Chain(chain) => of.chain(chain),
            Steps::Paddle(paddle) => {
                let (whole, branch) = (of.whole(&[&paddle.inward]), of.branch(&[&paddle.first]));
                quote!(#whole #branch)
            }
            Steps::Limb(limb) => of.whole(&[&limb.inward, &limb.back]),
            Steps::Part(part) => of.whole(&[&part.inward, &part.back]),
            Steps::Trunk(trunk) => prepare_trunk(group, trunk, level),
            Steps::Joints(joints) => of.joints(joints),
        };
        quote!(#laws #rest)
    })
}

/// One appendage of a group, for whose steps code is written.
struct Appendage<'a> {
    group: &'a Equal,
    /// Its number, where there are several.
    a: Option<&'a Ident>,
    level: Level,
}

impl Appendage<'_> {
    /// Of the law of each hinge.
    fn laws(&self, law: &Placed) -> TokenStream {
        let hinges = self.group.shape.hinges();
        repeated("i", hinges, false, |i| {
            let size = RightSideLayout::LAW;
            let at = place(self.group.law, &[(size * hinges, self.a), (size, i)]);
            self.gathered("law", (size, at), i, &[law])
        })
    }

    fn chain(&self, chain: &Chain) -> TokenStream {
        let Chain { coupling, start, outward, inward, root, first, .. } = chain;
        let (group, hinges) = (self.group, self.group.shape.hinges());
        let couplings = coupling.as_ref().map(|coupling| {
            repeated("i", hinges - 1, false, |i| {
                let size = RightSideLayout::COUPLING;
                let at = place(group.coupling + size, &[(size * hinges, self.a), (size, i)]);
                self.gathered("coupling", (size, at), i, &[coupling])
            })
        });
        let of_branch = self.branch(&with_root(start, root, first));
        let links = repeated("i", hinges, false, |i| {
            let at = group.parameter + Layout::BRANCH;
            let at = place(at, &[(group.parameters(), self.a), (Layout::LINK, i)]);
            self.gathered("link", (Layout::LINK, at), i, &[outward, inward])
        });
        quote!(#couplings #of_branch #links)
    }

    fn joints(&self, of: &Joints) -> TokenStream {
        let Joints { start, root, first, mounts, joints, .. } = of;
        let of_branch = self.branch(&with_root(start, root, first));
        let number = format_ident!("number");
        let of_link = |step| self.store(step, "of_link", Some(&number));
        let size = |kind: &Kind| kind.parameters();
        let of_mount = prepared(mounts, size, self.group, of_link);
        let of_joint = prepared(joints, size, self.group, of_link);
        let tables = Tables::new(self.group, of);
        let (mounts, joints) = (tables.mounts(), tables.joints());
        let links = Literal::usize_unsuffixed(self.group.shape.hinges());
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

    /// Of steps that take the numbers of its mount.
    fn branch(&self, steps: &[&Placed]) -> TokenStream {
        self.gathered("branch", (Layout::BRANCH, self.start()), None, steps)
    }

    /// Of steps that take all its numbers.
    fn whole(&self, steps: &[&Placed]) -> TokenStream {
        self.gathered("whole", (self.group.parameters(), self.start()), None, steps)
    }

    /// Where its numbers begin.
    fn start(&self) -> TokenStream {
        place(self.group.parameter, &[(self.group.parameters(), self.a)])
    }

    /// Gathers so many numbers from a place on, under a name, and writes the constants of steps for hinge `i` that
    /// take them.
    fn gathered(
        &self,
        name: &str,
        (size, at): (usize, TokenStream),
        i: Option<&Ident>,
        steps: &[&Placed],
    ) -> TokenStream {
        let of_steps = steps.iter().map(|step| self.store(step, name, i));
        let (name, size) = (format_ident!("{name}"), Literal::usize_unsuffixed(size));
        quote!(let #name: [R; #size] = R::gather_all(p, #at, 1); #(#of_steps)*)
    }

    fn store(&self, step: &Placed, from: &str, i: Option<&Ident>) -> TokenStream {
        let count = self.group.count;
        let terms = [(step.traced.constants() * count, i), (1, self.a)];
        store(step, &format_ident!("{from}"), count, &terms, self.level)
    }
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
