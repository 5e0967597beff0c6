//! `CERTIFICATE.json`.

use nboom_codegen::{Request, hash};
use nboom_expr::Operations;
use nboom_model::Scene;
use serde::Serialize;

use crate::certified::{Certified, Found, SEED};

/// A routine of a crate.
pub(crate) struct Routine {
    /// What was asked for.
    pub request: Request,
    /// What its formulation is certified for.
    pub certified: Certified,
    /// Operations of an evaluation, and of a preparation.
    pub operations: [Operations; 2],
}

/// The text; `key` is a number for everything that the crate is made from.
pub(crate) fn text(scene: &Scene, key: u64, routines: &[Routine]) -> String {
    let document = Document {
        scene: &scene.name,
        generator: env!("CARGO_PKG_VERSION"),
        request: format!("{key:016x}"),
        routines: routines.iter().map(Row::new).collect(),
    };
    let text = serde_json::to_string_pretty(&document);
    text.expect("numbers and texts are JSON") + "\n"
}

#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    generator: &'static str,
    request: String,
    routines: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    name: String,
    topology: String,
    topology_hash: String,
    output: &'static str,
    level: &'static str,
    assumptions: Vec<String>,
    evaluation: Counts,
    preparation: Counts,
    formulation: OfFormulation,
    compiled_code: OfCode,
}

/// Figures of the closed form as it was recorded, not of code that was compiled.
#[derive(Default, Serialize)]
struct OfFormulation {
    name: &'static str,
    states: usize,
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    deviation_from_recursion: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    deviation_from_double_double: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    magnification: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
}

/// Where the compiled code is measured, and what is allowed there.
#[derive(Serialize)]
struct OfCode {
    measured_by: &'static str,
    tolerance: f64,
}

#[derive(Serialize)]
struct Counts {
    additions: usize,
    multiplications: usize,
    divisions: usize,
    square_roots: usize,
    angles: usize,
}

impl Row {
    fn new(routine: &Routine) -> Self {
        let Routine { request, certified, operations: [evaluation, preparation] } = routine;
        let topology = request.topology.to_string();
        Self {
            name: request.name.clone(),
            topology_hash: format!("{:016x}", hash(topology.as_bytes())),
            topology,
            output: request.output.name(),
            level: request.level.name(),
            assumptions: request.assumptions_in_words(),
            evaluation: (*evaluation).into(),
            preparation: (*preparation).into(),
            formulation: OfFormulation::new(request, certified),
            compiled_code: OfCode { measured_by: "cargo test", tolerance: certified.tolerance() },
        }
    }
}

impl OfFormulation {
    fn new(request: &Request, certified: &Certified) -> Self {
        let (name, states) = (request.formulation.name(), certified.states);
        let nothing = Self { name, states, seed: SEED, ..Self::default() };
        match &certified.found {
            Found::Accelerations(found) => Self {
                deviation_from_recursion: Some(found.from_recursion),
                deviation_from_double_double: Some(found.from_double_double),
                magnification: Some(found.magnification),
                ..nothing
            },
            Found::Equations { deviation, residual } => Self {
                deviation_from_double_double: Some(*deviation),
                residual: Some(*residual),
                ..nothing
            },
            Found::InverseDynamics(found) => {
                Self { deviation_from_double_double: Some(*found), ..nothing }
            }
            Found::RightSide { deviation, magnification } => Self {
                deviation_from_double_double: Some(*deviation),
                magnification: Some(*magnification),
                ..nothing
            },
        }
    }
}

impl From<Operations> for Counts {
    fn from(operations: Operations) -> Self {
        let Operations { additions, multiplications, divisions, square_roots, angles } = operations;
        Self { additions, multiplications, divisions, square_roots, angles }
    }
}
