//! Turns a topology and a formulation into specialised Rust.

mod driver;
mod item;
mod request;
mod rolled;
mod routine;
mod stage;
mod straight;
mod sweeps;

pub use request::{Level, Request};
pub use routine::{Generated, generate, trace};

/// The routine as formatted source.
pub fn source(request: &Request) -> String {
    format_items(routine::generate(request))
}

/// The routine with loops, as formatted source.
pub fn rolled_source(request: &Request) -> String {
    format_items(rolled::generate(request))
}

fn format_items(generated: Generated) -> String {
    let file: syn::File = syn::parse2(generated.tokens).expect("generated code is Rust");
    prettyplease::unparse(&file)
}
