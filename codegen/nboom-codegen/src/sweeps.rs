//! Emitted functions that take one appendage, or several side by side, through the sweeps.

use nboom_formulation::Layout;
use nboom_formulation::stages::{AT_ORIGIN, ELIMINATED, PADDLE, SHOWN, TURNED};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::rolled::{Equal, Placed};

/// Whose constants a step is handed.
pub(crate) enum Whose {
    /// The main body's.
    MainBody,
    /// Those of appendage `a`.
    Appendage,
    /// Those of link `i` of appendage `a`.
    Link,
}

/// The argument that hands a step its constants, if it has any.
pub(crate) fn gather_constants(placed: &Placed, count: usize, whose: &Whose) -> TokenStream {
    let size = placed.traced.constants();
    if size == 0 {
        return TokenStream::new();
    }
    let [start, size, count] = [placed.start, size, count].map(Literal::usize_unsuffixed);
    let at = match whose {
        Whose::MainBody => quote!(#start),
        Whose::Appendage => quote!(#start + a),
        Whose::Link => quote!(#start + i * #size * #count + a),
    };
    quote!(P::gather_all(k, #at, #count),)
}

pub(crate) fn names(group: &Equal) -> (Ident, Ident) {
    (format_ident!("{}_in", group.prefix()), format_ident!("{}_out", group.prefix()))
}

/// Where the group's hinge numbers begin in a state and in the accelerations.
fn places(group: &Equal) -> (Literal, Literal) {
    let state = Layout::STATE + Layout::HINGE * group.hinge;
    (Literal::usize_unsuffixed(state), Literal::usize_unsuffixed(Layout::OUTPUT + group.hinge))
}

pub(crate) fn chain_sweeps(group: &Equal, links: usize, placed: [&Placed; 6]) -> TokenStream {
    let [start, outward, inward, root, first, back] = placed;
    let names_of = |placed: &Placed| placed.traced.name.clone();
    let (start_, outward_, inward_, root_, first_, back_) = (
        names_of(start),
        names_of(outward),
        names_of(inward),
        names_of(root),
        names_of(first),
        names_of(back),
    );
    let count = group.count;
    let (k_start, k_root, k_first) = (
        gather_constants(start, count, &Whose::Appendage),
        gather_constants(root, count, &Whose::Appendage),
        gather_constants(first, count, &Whose::Appendage),
    );
    let (k_outward, k_inward) = (
        gather_constants(outward, count, &Whose::Link),
        gather_constants(inward, count, &Whose::Link),
    );
    let (in_name, out_name) = names(group);
    let (state, output) = places(group);
    let [turned, shown, eliminated, seen] = [
        outward.traced.size(TURNED),
        inward.traced.size(SHOWN),
        inward.traced.size(ELIMINATED),
        root.traced.size(AT_ORIGIN),
    ]
    .map(Literal::usize_unsuffixed);
    let (links, count) = (Literal::usize_unsuffixed(links), Literal::usize_unsuffixed(count));
    quote! {
        #[inline(always)]
        fn #in_name<S: Real, P: Pack<S>>(
            k: &[S],
            x: &[S],
            a: usize,
            saved: &mut ([[P; #eliminated]; #links],),
        ) -> [P; #seen] {
            let omega = [P::spread(x[0]), P::spread(x[1]), P::spread(x[2])];
            let (w, mut reached) = #start_(#k_start omega);
            let mut angles = [P::zero(); #links];
            let mut alpha = P::zero();
            for i in 0..#links {
                alpha += P::gather(x, #state + 3 * i * #count + a);
                angles[i] = alpha;
            }
            let turns = P::sin_cos_all(angles);
            let mut turned = [[P::zero(); #turned]; #links];
            for i in 0..#links {
                let turn = [turns[i].0, turns[i].1];
                let tau = [P::gather(x, #state + (3 * i + 1) * #count + a)];
                (turned[i], reached) = #outward_(#k_outward w, turn, tau, reached);
            }
            let mut outer = P::zero();
            let mut shown = [P::zero(); #shown];
            for i in (0..#links).rev() {
                let torque = P::gather(x, #state + (3 * i + 2) * #count + a);
                (shown, saved.0[i]) = #inward_(#k_inward turned[i], [torque - outer], shown);
                outer = torque;
            }
            let (seen,) = #root_(#k_root shown, [outer]);
            seen
        }
        #[inline(always)]
        fn #out_name<S: Real, P: Pack<S>>(
            k: &[S],
            main: [S; 6],
            a: usize,
            saved: &([[P; #eliminated]; #links],),
            out: &mut [S],
        ) {
            let (mut turning, mut hinge) = #first_(#k_first P::spread_all(main));
            for i in 0..#links {
                let tau_dot;
                (tau_dot, turning, hinge) = #back_(saved.0[i], turning, hinge);
                tau_dot[0].scatter(out, #output + i * #count + a);
            }
        }
    }
}

pub(crate) fn paddle_sweeps(
    group: &Equal,
    inward: &Placed,
    first: &Placed,
    back: &Placed,
) -> TokenStream {
    let (inward_, first_, back_) = (&inward.traced.name, &first.traced.name, &back.traced.name);
    let (k_inward, k_first) = (
        gather_constants(inward, group.count, &Whose::Appendage),
        gather_constants(first, group.count, &Whose::Appendage),
    );
    let (in_name, out_name) = names(group);
    let (state, output) = places(group);
    let [eliminated, paddle, seen] = [ELIMINATED, PADDLE, AT_ORIGIN]
        .map(|group| Literal::usize_unsuffixed(inward.traced.size(group)));
    let count = Literal::usize_unsuffixed(group.count);
    quote! {
        #[inline(always)]
        fn #in_name<S: Real, P: Pack<S>>(
            k: &[S],
            x: &[S],
            a: usize,
            saved: &mut ([P; #eliminated], [P; #paddle]),
        ) -> [P; #seen] {
            let omega = [P::spread(x[0]), P::spread(x[1]), P::spread(x[2])];
            let hinges = P::gather_all(x, #state + a, #count);
            let seen;
            (seen, saved.0, saved.1) = #inward_(#k_inward omega, hinges);
            seen
        }
        #[inline(always)]
        fn #out_name<S: Real, P: Pack<S>>(
            k: &[S],
            main: [S; 6],
            a: usize,
            saved: &([P; #eliminated], [P; #paddle]),
            out: &mut [S],
        ) {
            let (turning, hinge) = #first_(#k_first P::spread_all(main));
            let (tau_dot,) = #back_(saved.0, saved.1, turning, hinge);
            tau_dot[0].scatter(out, #output + a);
            tau_dot[1].scatter(out, #output + #count + a);
        }
    }
}
