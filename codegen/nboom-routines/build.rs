//! Generates the stock routines.

use std::fmt::Write;
use std::path::PathBuf;

use nboom_codegen::{Level, Request, source};
use nboom_model::Shape::{Chain, Paddle};
use nboom_model::{Shape, Topology};

/// Topologies that scenes often have, or come through while their hinges are released and lock:
/// one line each.
fn stock() -> Vec<Vec<Shape>> {
    vec![
        vec![],
        vec![Chain(1)],
        vec![Chain(2)],
        vec![Chain(3)],
        vec![Chain(1); 2],
        vec![Chain(2), Chain(1)],
        vec![Chain(2); 2],
        vec![Chain(3); 2],
        vec![Chain(1); 4],
        vec![Chain(3); 4],
        vec![Chain(5); 4],
        vec![Chain(5); 20],
        vec![Chain(100)],
        vec![Paddle],
        vec![Chain(1), Paddle],
        vec![Chain(2), Paddle],
    ]
}

fn main() {
    let mut code = String::new();
    let mut rows = String::new();
    for shapes in stock() {
        let topology = Topology::new(shapes);
        for principal in [true, false] {
            let name = name(&topology, principal);
            let request = Request::new(&name, topology.clone(), Level::Fast).with_external_wrench();
            let request = if principal { request.with_principal_axes() } else { request };
            code += &source_of(&request);
            writeln!(rows, "        Kernel::of::<{name}>(),").expect("a string takes any text");
        }
    }
    write!(code, "fn stock() -> Vec<Kernel> {{\n    vec![\n{rows}    ]\n}}\n")
        .expect("a string takes any text");
    let directory = std::env::var_os("OUT_DIR").expect("cargo runs build scripts");
    let directory = PathBuf::from(directory);
    std::fs::write(directory.join("routines.rs"), code)
        .expect("the output directory can be written");
    let exact: Vec<String> = exact().iter().map(source_of).collect();
    std::fs::write(directory.join("exact.rs"), exact.concat())
        .expect("the output directory can be written");
    println!("cargo::rerun-if-changed=build.rs");
}

/// Routines that keep the closed form's every rounding, for the tests.
fn exact() -> Vec<Request> {
    let satellite =
        |name, shapes: Vec<Shape>| Request::new(name, Topology::new(shapes), Level::Exact);
    vec![
        satellite("StraightS2P", vec![Chain(2), Paddle]).with_external_wrench(),
        satellite("PrincipalS1P", vec![Chain(1), Paddle]).with_principal_axes(),
        satellite("RolledS3", vec![Chain(3); 4]).with_external_wrench(),
        satellite("RolledP", vec![Paddle; 3]).with_external_wrench(),
        satellite("RolledS30", vec![Chain(30)]),
        satellite("RolledMixed", vec![Chain(4), Chain(4), Chain(2), Paddle, Paddle]),
    ]
}

fn source_of(request: &Request) -> String {
    source(request).expect("stock topologies can be generated")
}

/// For example `PrincipalS2P` or `General4S3`.
fn name(topology: &Topology, principal: bool) -> String {
    let kind = if principal { "Principal" } else { "General" };
    format!("{kind}{}", topology.to_string().replace(['_', 'x'], ""))
}
