use nboom_loads::RESULT;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::expression::number;
use crate::request::{Request, StressRequest};

/// What a routine says of itself.
pub(crate) struct Signature {
    /// Name of the type.
    pub name: String,
    /// Path of the crate `nboom_scalar`.
    pub scalar: syn::Path,
    pub result: &'static str,
    pub topology: String,
    pub formulation: &'static str,
    pub external: bool,
    /// Values of parameters; `None` stays a runtime value.
    pub assumptions: Vec<Option<f64>>,
    pub coordinates: usize,
    pub outputs: usize,
}

impl Signature {
    pub fn of(request: &Request, scalar: syn::Path) -> Self {
        let Request { name, topology, formulation, output, assumptions, external, .. } = request;
        Self {
            name: name.clone(),
            scalar,
            result: output.name(),
            topology: topology.to_string(),
            formulation: formulation.name(),
            external: *external,
            assumptions: assumptions.clone(),
            coordinates: output.coordinates(topology),
            outputs: output.size(topology),
        }
    }

    pub fn of_stresses(request: &StressRequest, scalar: syn::Path) -> Self {
        let equations = &request.equations;
        Self {
            name: request.name.clone(),
            scalar,
            result: RESULT,
            topology: match equations.hinges() {
                1 => "1 hinge".to_owned(),
                hinges => format!("{hinges} hinges"),
            },
            formulation: "",
            external: true,
            assumptions: request.assumptions(),
            coordinates: equations.motion_size().count(),
            outputs: equations.load_set().count(),
        }
    }

    /// Makes arrays of known sizes of the slices that an evaluation on the numbers `of` is given.
    pub fn sized(&self, constants: usize, of: &TokenStream) -> TokenStream {
        let [constants, coordinates, outputs] =
            [constants, self.coordinates, self.outputs].map(Literal::usize_unsuffixed);
        quote! {
            let k: &[#of; #constants] = k.try_into().expect("one value for each constant");
            let x: &[#of; #coordinates] = x.try_into().expect("one value for each coordinate");
            let out: &mut [#of; #outputs] = out.try_into().expect("room for each output");
        }
    }

    /// Places and values of what is assumed.
    fn assumed(&self) -> TokenStream {
        let assumed = self.assumptions.iter().enumerate();
        let (places, values): (Vec<usize>, Vec<f64>) =
            assumed.filter_map(|(i, value)| Some((i, (*value)?))).unzip();
        let Some(first) = values.first() else { return quote!(&[]) };
        let (scalar, count) = (&self.scalar, Literal::usize_unsuffixed(places.len()));
        let places = places.into_iter().map(Literal::usize_unsuffixed);
        let values = if values.iter().all(|value| value.to_bits() == first.to_bits()) {
            let value = number(*first);
            quote!([#value; #count])
        } else {
            let values = values.into_iter().map(number);
            quote!([#(#values),*])
        };
        quote!(&#scalar::assumed([#(#places),*], #values))
    }
}

/// The type that a signature names and its implementation of `Routine`.
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
    /// Whether that has equal appendages to take side by side.
    pub in_packs: bool,
}

impl Item<'_> {
    pub fn tokens(&self) -> TokenStream {
        let Self { signature, prepare, evaluate, evaluate_packed, .. } = self;
        let Signature { name, result, topology, formulation, external, .. } = signature;
        let name = format_ident!("{name}");
        let assumed = signature.assumed();
        let in_packs = self.in_packs.then(|| {
            quote!(
                const IN_PACKS: bool = true;
            )
        });
        let [parameters, constants, coordinates, outputs] =
            [signature.assumptions.len(), self.constants, signature.coordinates, signature.outputs]
                .map(Literal::usize_unsuffixed);
        quote! {
            impl Routine for #name {
                const RESULT: &'static str = #result;
                const TOPOLOGY: &'static str = #topology;
                const FORMULATION: &'static str = #formulation;
                const ASSUMPTIONS: &'static [(usize, f64)] = #assumed;
                const EXTERNAL: bool = #external;
                const PARAMETERS: usize = #parameters;
                const CONSTANTS: usize = #constants;
                const COORDINATES: usize = #coordinates;
                const OUTPUTS: usize = #outputs;
                #in_packs
                fn prepare<R: Real>(p: &[R], k: &mut [R]) {
                    let p: &[R; #parameters] = p.try_into().expect("one value for each parameter");
                    let k: &mut [R; #constants] = k.try_into().expect("room for each constant");
                    #prepare
                }
                #[inline(always)]
                fn evaluate<R: Real>(k: &[R], x: &[R], out: &mut [R]) {
                    #evaluate
                }
                #[inline(always)]
                fn evaluate_packed<I: Isa>(k: &[f64], x: &[f64], out: &mut [f64]) {
                    #evaluate_packed
                }
            }
        }
    }
}
