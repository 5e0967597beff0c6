use nboom_formulation::Layout;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::Request;

/// What a routine says of itself.
pub(crate) struct Signature {
    /// Name of the type.
    pub name: String,
    pub result: &'static str,
    pub topology: String,
    pub formulation: &'static str,
    pub external: bool,
    /// Parameters taken for granted; `None` stays a runtime value.
    pub pinned: Vec<Option<f64>>,
    pub coordinates: usize,
    pub outputs: usize,
}

impl Signature {
    pub fn of(request: &Request) -> Self {
        let Request { name, topology, formulation, output, pinned, external, .. } = request;
        Self {
            name: name.clone(),
            result: output.name(),
            topology: topology.to_string(),
            formulation: formulation.name(),
            external: *external,
            pinned: pinned.clone(),
            coordinates: Layout::coordinates(topology),
            outputs: output.size(topology),
        }
    }
}

/// The implementation of `Routine` for the type that the signature names.
pub(crate) struct Item<'a> {
    pub signature: &'a Signature,
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
        let Self { signature, prepare, evaluate, evaluate_packed, functions, .. } = self;
        let Signature { name, result, topology, formulation, external, pinned, .. } = signature;
        let name = format_ident!("{name}");
        let granted = pinned.iter().enumerate().filter_map(|(i, value)| {
            let (i, value) = (Literal::usize_unsuffixed(i), (*value)?);
            Some(quote!((#i, #value)))
        });
        let [parameters, constants, coordinates, outputs] =
            [pinned.len(), self.constants, signature.coordinates, signature.outputs]
                .map(Literal::usize_unsuffixed);
        quote! {
            pub struct #name;
            impl Routine for #name {
                const RESULT: &'static str = #result;
                const TOPOLOGY: &'static str = #topology;
                const FORMULATION: &'static str = #formulation;
                const PINNED: &'static [(usize, f64)] = &[#(#granted),*];
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
