//! Turns a topology and a formulation into specialised Rust.

mod request;
mod routine;
mod straight;

pub use request::{Level, Request};
pub use routine::{Generated, generate, trace};

/// The routine as formatted source.
pub fn source(request: &Request) -> String {
    let generated = generate(request);
    let file: syn::File = syn::parse2(generated.tokens).expect("generated code is Rust");
    prettyplease::unparse(&file)
}
