use nboom_formulation::Layout;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::Request;

/// The implementation of `Routine` for the request's type.
pub(crate) struct Item<'a> {
    pub request: &'a Request,
    /// How many constants are prepared.
    pub constants: usize,
    /// Body of `prepare`: from `p` to `k`.
    pub prepare: TokenStream,
    /// Body of `evaluate` on `R`: from `k` and `x` to `out`.
    pub evaluate: TokenStream,
    /// Body of `evaluate_packed` on the packs of `I`.
    pub evaluate_packed: TokenStream,
    /// Functions of the type itself.
    pub functions: TokenStream,
}

impl Item<'_> {
    pub fn tokens(&self) -> TokenStream {
        let Self { request, prepare, evaluate, evaluate_packed, functions, .. } = self;
        let name = format_ident!("{}", request.name);
        let topology = request.topology.to_string();
        let formulation = request.formulation.name();
        let external = request.external;
        let pinned = request.pinned.iter().enumerate().filter_map(|(i, value)| {
            let (i, value) = (Literal::usize_unsuffixed(i), (*value)?);
            Some(quote!((#i, #value)))
        });
        let [parameters, constants, coordinates, outputs] = [
            Layout::parameters(&request.topology),
            self.constants,
            Layout::coordinates(&request.topology),
            request.output.size(&request.topology),
        ]
        .map(Literal::usize_unsuffixed);
        quote! {
            pub struct #name;
            impl Routine for #name {
                const TOPOLOGY: &'static str = #topology;
                const FORMULATION: &'static str = #formulation;
                const PINNED: &'static [(usize, f64)] = &[#(#pinned),*];
                const EXTERNAL: bool = #external;
                const PARAMETERS: usize = #parameters;
                const CONSTANTS: usize = #constants;
                const COORDINATES: usize = #coordinates;
                const OUTPUTS: usize = #outputs;
                fn prepare<R: Real>(p: &[R], k: &mut [R]) {
                    let p: &[R; #parameters] = p.try_into().expect("one value for each parameter");
                    let k: &mut [R; #constants] = k.try_into().expect("room for each constant");
                    #prepare
                }
                #[inline(always)]
                fn evaluate<R: Real>(k: &[R], x: &[R], out: &mut [R]) {
                    let k: &[R; #constants] = k.try_into().expect("one value for each constant");
                    let x: &[R; #coordinates] = x.try_into().expect("one value for each coordinate");
                    let out: &mut [R; #outputs] = out.try_into().expect("room for each output");
                    #evaluate
                }
                #[inline(always)]
                fn evaluate_packed<I: Isa>(k: &[f64], x: &[f64], out: &mut [f64]) {
                    let k: &[f64; #constants] = k.try_into().expect("one value for each constant");
                    let x: &[f64; #coordinates] = x.try_into().expect("one value for each coordinate");
                    let out: &mut [f64; #outputs] = out.try_into().expect("room for each output");
                    #evaluate_packed
                }
            }
            impl #name { #functions }
        }
    }
}
