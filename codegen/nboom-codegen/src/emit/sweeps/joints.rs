//! Sweeps through limbs joint by joint: loops over links, whose tables say which steps each takes.

use nboom_formulation::Layout;
use nboom_formulation::stages::{
    BIAS, Group, HINGE_RATES, Mounting, REACHED, SHARE, STANCE, TURNING, W,
};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::comment::comment;
use crate::emit::hinges::omega_spread;
use crate::emit::places::place;
use crate::emit::sweeps::{Sweeps, name};
use crate::trace::{Equal, Joints, Kind, Placed};

/// Tables of the links of a group.
pub(crate) struct Tables<'a> {
    group: &'a Equal,
    joints: &'a Joints,
}

impl<'a> Tables<'a> {
    pub fn new(group: &'a Equal, joints: &'a Joints) -> Self {
        Self { group, joints }
    }

    /// Of the mount of each link: the inboard link, the kind of the mount, its number among those of this kind,
    /// and where its parameters begin; the first link is mounted on none.
    pub fn mounts(&self) -> Ident {
        format_ident!("{}_MOUNTS", self.group.prefix().to_uppercase())
    }

    /// Of the joint of each link: its kind, its number among those of this kind, and where the parameters of the
    /// link's body begin.
    pub fn joints(&self) -> Ident {
        format_ident!("{}_JOINTS", self.group.prefix().to_uppercase())
    }

    fn tokens(&self) -> TokenStream {
        let Joints { limb, mounts, joints, .. } = self.joints;
        let links = limb.links();
        let start = self.group.parameter;
        let mut of_mounts = vec![[0; 4]; links.len()];
        for (kind, i, n) in numbered(mounts) {
            let inboard = links[i].inboard.map_or(0, usize::from);
            of_mounts[i] = [inboard, kind, n, start + self.group.link(i)];
        }
        let mut of_joints = vec![[0; 3]; links.len()];
        for (kind, i, n) in numbered(joints) {
            of_joints[i] = [kind, n, start + self.group.link(i) + Layout::mount(limb, i)];
        }
        let (of_mounts, of_joints) = (rows(&of_mounts), rows(&of_joints));
        let (mounts, joints) = (self.mounts(), self.joints());
        let count = Literal::usize_unsuffixed(links.len());
        quote! {
            /// Of the mount of each link: inboard link, kind, number of its kind, place of its parameters.
            const #mounts: [[usize; 4]; #count] = [#of_mounts];
            /// Of the joint of each link: kind, number of its kind, place of its link's parameters.
            const #joints: [[usize; 3]; #count] = [#of_joints];
        }
    }
}

/// Kind, link, and number among those of this kind, of all links.
fn numbered(kinds: &[Kind]) -> impl Iterator<Item = (usize, usize, usize)> {
    kinds.iter().enumerate().flat_map(|(kind, of)| {
        of.links.iter().enumerate().map(move |(number, &link)| (kind, link, number))
    })
}

fn rows<const N: usize>(rows: &[[usize; N]]) -> TokenStream {
    let rows = rows.iter().map(|row| {
        let row = row.iter().copied().map(Literal::usize_unsuffixed);
        quote!([#(#row),*])
    });
    quote!(#(#rows),*)
}

/// What is done for each kind, where `kind` says which.
pub(crate) fn by_kind<'a>(
    kinds: &'a [Kind],
    done: impl Fn(&'a Kind) -> TokenStream,
) -> TokenStream {
    let [inner @ .., last] = kinds else { return TokenStream::new() };
    let last = done(last);
    if inner.is_empty() {
        return last;
    }
    let arms = inner.iter().enumerate().map(|(number, kind)| {
        let (number, done) = (Literal::usize_unsuffixed(number), done(kind));
        quote!(#number => #done,)
    });
    quote!(match kind { #(#arms)* _ => #last })
}

impl Sweeps<'_> {
    pub(super) fn tables(&self, joints: &Joints) -> TokenStream {
        Tables::new(self.group, joints).tokens()
    }

    /// A step of the `number`-th joint or mount of its kind, with its arguments.
    fn taken(&self, step: &Placed, arguments: &TokenStream) -> TokenStream {
        let (bind, link) = self.of_link(step, Some(&format_ident!("number")));
        let step = name(step);
        match bind.is_empty() {
            true => quote!(#step(#link #arguments)),
            false => quote!({ #bind #step(#link #arguments) }),
        }
    }

    pub(super) fn joints_in(&self, joints: &Joints) -> TokenStream {
        let Joints { law, start, root, .. } = joints;
        let (angles, outward, inward) =
            (self.joint_angles(joints), self.joints_outward(joints), self.joints_inward(joints));
        let laws = self.laws(law.as_ref(), None);
        let omega = omega_spread(self.request.output);
        let (start_, k_start) = (name(start), self.argument(start));
        let shown = self.shown(root.as_ref(), &quote!(share));
        quote! {
            let omega = #omega;
            let (mut w, mut motion) = #start_(#k_start omega);
            #angles
            #laws
            #outward
            #inward
            #shown
        }
    }

    fn joint_angles(&self, joints: &Joints) -> TokenStream {
        let what = comment("Absolute angles, their sines and cosines.");
        let mounts = Tables::new(self.group, joints).mounts();
        let (i, links) = (format_ident!("i"), self.links());
        let beta = self.hinges().beta((0, Some(&i)));
        let of_limb = joints.limb.links();
        let parallel: Vec<Literal> = joints
            .mounts
            .iter()
            .enumerate()
            .filter(|(_, kind)| Mounting::of(of_limb, kind.links[0]) == Some(Mounting::Parallel))
            .map(|(number, _)| Literal::usize_unsuffixed(number))
            .collect();
        let add = (!parallel.is_empty()).then(|| {
            quote! {
                let [inboard, kind, ..] = #mounts[i];
                if i > 0 && matches!(kind, #(#parallel)|*) { angles[i] += angles[inboard]; }
            }
        });
        quote! {
            #what
            let mut angles = [P::zero(); #links];
            for i in 0..#links { angles[i] = #beta; #add }
            let turns = P::sin_cos_all(angles);
        }
    }

    fn joints_outward(&self, joints: &Joints) -> TokenStream {
        let what = comment("Outward: how links stand and move, their biases.");
        let (links, tables) = (self.links(), Tables::new(self.group, joints));
        let (of_mounts, of_joints) = (tables.mounts(), tables.joints());
        let [stance, w, reached, bias] =
            [STANCE, W, REACHED, BIAS].map(|group| size(&joints.joints[0].outward, group));
        let mount = by_kind(&joints.mounts, |kind| {
            let inboard = quote!(stances[inboard], spins[inboard], motions[inboard]);
            self.taken(&kind.outward, &inboard)
        });
        let joint = by_kind(&joints.joints, |kind| {
            self.taken(&kind.outward, &quote!(w, motion, [sin, cos], [beta, tau]))
        });
        let i = format_ident!("i");
        let [beta, tau] = [self.hinges().beta((0, Some(&i))), self.hinges().tau((0, Some(&i)))];
        quote! {
            #what
            let mut stances = [[P::zero(); #stance]; #links];
            let mut spins = [[P::zero(); #w]; #links];
            let mut motions = [[P::zero(); #reached]; #links];
            let mut biases = [[P::zero(); #bias]; #links];
            for i in 0..#links {
                if i > 0 {
                    let [inboard, kind, number, _] = #of_mounts[i];
                    (w, motion) = #mount;
                }
                let [kind, number, _] = #of_joints[i];
                let (sin, cos) = turns[i];
                let (beta, tau) = (#beta, #tau);
                (stances[i], spins[i], motions[i], biases[i]) = #joint;
            }
        }
    }

    fn joints_inward(&self, joints: &Joints) -> TokenStream {
        let what = comment("Inward: joints eliminated.");
        let (links, tables) = (self.links(), Tables::new(self.group, joints));
        let (of_mounts, of_joints) = (tables.mounts(), tables.joints());
        let outboard = Literal::usize_unsuffixed(joints.shown());
        let share = size(&joints.joints[0].inward, SHARE);
        let joint = by_kind(&joints.joints, |kind| {
            self.taken(&kind.inward, &quote!(stances[i], biases[i], [torque], outboard[i]))
        });
        let mount = by_kind(&joints.mounts, |kind| {
            self.taken(&kind.inward, &quote!(stances[inboard], share))
        });
        let torque = match joints.law {
            Some(_) => quote!(torques[i]),
            None => self.hinges().torque((0, Some(&format_ident!("i")))),
        };
        quote! {
            #what
            let mut outboard = [[P::zero(); #outboard]; #links];
            let mut share = [P::zero(); #share];
            for i in (0..#links).rev() {
                let [kind, number, _] = #of_joints[i];
                let torque = #torque;
                (share, saved[i]) = #joint;
                if i > 0 {
                    let [inboard, kind, number, _] = #of_mounts[i];
                    let carried = #mount;
                    for n in 0..#outboard { outboard[inboard][n] += carried[n]; }
                }
            }
        }
    }

    pub(super) fn joints_out(&self, joints: &Joints) -> TokenStream {
        let (links, tables) = (self.links(), Tables::new(self.group, joints));
        let (of_mounts, of_joints) = (tables.mounts(), tables.joints());
        let (first_, k_first) = (name(&joints.first), self.argument(&joints.first));
        let [turning, hinge] =
            [TURNING, HINGE_RATES].map(|group| size(&joints.joints[0].back, group));
        let mount = by_kind(&joints.mounts, |kind| {
            self.taken(&kind.back, &quote!(saved[inboard], turnings[inboard], hinges[inboard]))
        });
        let joint = by_kind(&joints.joints, |kind| {
            self.taken(&kind.back, &quote!(saved[i], turning, hinge))
        });
        let write = self.hinges().write(&format_ident!("tau_dot"), (0, Some(&format_ident!("i"))));
        quote! {
            let (mut turning, mut hinge) = #first_(#k_first main);
            let mut turnings = [[P::zero(); #turning]; #links];
            let mut hinges = [[P::zero(); #hinge]; #links];
            for i in 0..#links {
                if i > 0 {
                    let [inboard, kind, number, _] = #of_mounts[i];
                    (turning, hinge) = #mount;
                }
                let [kind, number, _] = #of_joints[i];
                let tau_dot;
                ([tau_dot], turnings[i], hinges[i]) = #joint;
                #write
            }
        }
    }

    fn links(&self) -> Literal {
        Literal::usize_unsuffixed(self.group.shape.hinges())
    }
}

/// How many numbers of a group a step hands on.
fn size(step: &Placed, group: Group) -> Literal {
    Literal::usize_unsuffixed(step.traced.size(group))
}

/// Writes the constants of the joints or mounts of all kinds, computed from `size` parameters of each.
pub(crate) fn prepared<'a>(
    kinds: &'a [Kind],
    size: impl Fn(&'a Kind) -> usize,
    group: &Equal,
    store: impl Fn(&'a Placed) -> TokenStream,
) -> TokenStream {
    let (at, a) = (format_ident!("at"), format_ident!("a"));
    let appendage = (group.count > 1).then_some(&a);
    let at = place(0, &[(1, Some(&at)), (group.parameters(), appendage)]);
    by_kind(kinds, |kind| {
        let of_kind = [&kind.outward, &kind.inward, &kind.back].map(&store);
        let size = Literal::usize_unsuffixed(size(kind));
        quote!({
            let of_link: [R; #size] = R::gather_all(p, #at, 1);
            #(#of_kind)*
        })
    })
}
