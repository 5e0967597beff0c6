//! Turns a topology and a formulation into specialised Rust.
//!
//! The formulation is run on recording scalars; what it did becomes code. A small satellite
//! becomes one straight line; beyond [`STRAIGHT_LIMIT`] operations the sweeps over links become
//! loops, and equal appendages go through them side by side. Constants that depend on
//! parameters alone are computed once. The same request gives the same bytes.
//!
//! ```
//! use nboom_codegen::{Level, Request, source};
//! use nboom_model::{Shape, Topology};
//!
//! let topology = Topology::new([Shape::Chain(2), Shape::Paddle]);
//! let code = source(&Request::new("S2P", topology, Level::Exact))?;
//! assert!(code.contains("impl Routine for S2P"));
//! # Ok::<(), nboom_codegen::CodegenError>(())
//! ```

mod blocks;
mod driver;
mod error;
mod file;
mod granted;
mod item;
mod module;
mod request;
mod rolled;
mod routine;
mod scene;
mod stage;
mod straight;
mod stresses;
mod sweeps;

use nboom_expr::Operations;
use nboom_formulation::{Formulation, Layout};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

pub use error::CodegenError;
pub use file::{Standing, hash};
pub use granted::granted;
pub use module::Module;
pub use request::{Level, Output, Request};
pub use routine::trace;
pub use scene::{Numbers, held};
pub use stresses::StressRequest;

/// Operations beyond which an evaluation is emitted as loops: more straight-line code than this
/// no longer fits the processor's instruction cache.
pub const STRAIGHT_LIMIT: usize = 2500;

/// The most hinges that `articulated` is generated for, as loops.
pub const HINGE_LIMIT: usize = 1000;

/// The most hinges that any other formulation is traced for: its code is one straight line.
pub const STRAIGHT_HINGE_LIMIT: usize = 100;

/// The most operations of an evaluation that cannot be emitted as loops: an optimising compiler
/// takes 17 seconds for that much code in all instruction sets, and 95 for twice as much.
pub const OPERATION_LIMIT: usize = 20_000;

/// Generated code and what it costs.
pub struct Generated {
    /// The items.
    pub tokens: TokenStream,
    /// Operations of one evaluation.
    pub evaluation: Operations,
    /// Operations done once for each set of parameters.
    pub preparation: Operations,
}

/// Code for the request: a module with the routine, and its type.
///
/// # Errors
/// When the request does not describe a routine that can be generated.
pub fn generate(request: &Request) -> Result<Generated, CodegenError> {
    check(request)?;
    let generated = match request.formulation {
        Formulation::Articulated => articulated(request),
        _ => straight(request)?,
    };
    let Request { name, scalar_path, .. } = request;
    let tokens = in_module(name, scalar_path, &heading(request), &generated)?;
    Ok(Generated { tokens, ..generated })
}

fn articulated(request: &Request) -> Generated {
    let side_by_side = request.topology.groups().iter().any(|&(_, count)| count >= PACK);
    let straight = (request.topology.hinges() <= STRAIGHT_HINGES && !side_by_side)
        .then(|| routine::generate(request))
        .filter(|straight| straight.evaluation.flops() <= STRAIGHT_LIMIT);
    straight.unwrap_or_else(|| rolled::generate(request))
}

fn straight(request: &Request) -> Result<Generated, CodegenError> {
    let generated = routine::generate(request);
    let (operations, limit) = (generated.evaluation.flops(), OPERATION_LIMIT);
    if operations > limit {
        let (topology, formulation) = (request.topology.to_string(), request.formulation);
        return Err(CodegenError::Budget { topology, formulation, operations, limit });
    }
    Ok(generated)
}

/// The code as formatted source with a header.
///
/// # Errors
/// As [`generate`].
pub fn source(request: &Request) -> Result<String, CodegenError> {
    Ok(formatted(generate(request)?.tokens))
}

fn formatted(tokens: TokenStream) -> String {
    let file: syn::File = syn::parse2(tokens).expect("generated code is Rust");
    prettyplease::unparse(&file)
}

/// So many equal appendages fill a register, and a loop over it beats a straight line.
const PACK: usize = 4;

/// Hinges beyond which no straight line is tried: none is shorter than the limit.
const STRAIGHT_HINGES: usize = 16;

fn check(request: &Request) -> Result<(), CodegenError> {
    let Request { name, topology, formulation, output, pinned, .. } = request;
    check_name(name)?;
    let of_topology = || topology.to_string();
    let (found, expected) = (pinned.len(), Layout::parameters(topology));
    if found != expected {
        return Err(CodegenError::Parameters { topology: of_topology(), found, expected });
    }
    let limit = match formulation {
        Formulation::Articulated => HINGE_LIMIT,
        _ => STRAIGHT_HINGE_LIMIT,
    };
    let (links, formulation) = (topology.hinges(), *formulation);
    if links > limit {
        return Err(CodegenError::TooLarge { topology: of_topology(), formulation, links, limit });
    }
    if *output == Output::Equations && !formulation.has_equations() {
        return Err(CodegenError::NoEquations { topology: of_topology(), formulation });
    }
    let bad = |(number, value): (usize, &Option<f64>)| {
        value.filter(|value| !value.is_finite()).map(|value| (number, value))
    };
    match pinned.iter().enumerate().find_map(bad) {
        Some((number, value)) => {
            Err(CodegenError::NotFinite { topology: of_topology(), number, value })
        }
        None => Ok(()),
    }
}

/// A raw identifier cannot be part of a module's name.
fn check_name(name: &str) -> Result<(), CodegenError> {
    if name.starts_with("r#") || syn::parse_str::<syn::Ident>(name).is_err() {
        return Err(CodegenError::Name(name.to_owned()));
    }
    Ok(())
}

/// The heading of a module by itself: what it is, then what is taken for granted.
fn heading(request: &Request) -> [String; 2] {
    let Request { topology, formulation, output, level, .. } = request;
    let (output, level) = (output.name(), level.name());
    [
        format!(" Topology {topology}, {output} by formulation {formulation}, level {level}."),
        format!(" Taken for granted: {}.", phrases(request)),
    ]
}

/// The module of a routine, and its type.
fn in_module(
    name: &str,
    scalar_path: &str,
    [what, granted]: &[String; 2],
    generated: &Generated,
) -> Result<TokenStream, CodegenError> {
    let scalar = scalar(name, scalar_path)?;
    let module = format_ident!("{}", snake_case(name));
    let ident = format_ident!("{name}");
    let lines = [
        &format!(" Generated by nboom-codegen {}.", env!("CARGO_PKG_VERSION")),
        what,
        &format!(" Evaluation: {}.", generated.evaluation),
        &format!(" Preparation: {}.", generated.preparation),
        granted,
    ];
    let items = &generated.tokens;
    let contract = Literal::u32_unsuffixed(nboom_scalar::CONTRACT);
    Ok(quote! {
        #(#[doc = #lines])*
        #[allow(clippy::all, clippy::pedantic, dead_code, missing_docs, unused_imports, unused_variables)]
        pub mod #module {
            use #scalar::{Isa, Pack, Real, Routine};
            const _: () = assert!(#scalar::CONTRACT == #contract, "generate this routine again");
            #items
        }
        pub use #module::#ident;
    })
}

/// The path of the crate `nboom_scalar` where the routine `name` will stand.
fn scalar(name: &str, path: &str) -> Result<syn::Path, CodegenError> {
    syn::parse_str(path)
        .map_err(|_| CodegenError::Path { name: name.to_owned(), path: path.to_owned() })
}

fn phrases(request: &Request) -> String {
    let phrases = granted(&request.topology, &request.pinned, request.external);
    if phrases.is_empty() { "nothing".to_owned() } else { phrases.join("; ") }
}

fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for (i, letter) in name.char_indices() {
        if letter.is_uppercase() && i > 0 {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    format!("routine_{snake}")
}
