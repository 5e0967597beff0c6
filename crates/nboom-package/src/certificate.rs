//! How far the code of a scene is from the truth: its graph, interpreted on random states.

use nboom_codegen::{Request, granted, trace};
use nboom_expr::{Graph, Operations};
use nboom_formulation::{Formulation, Layout, Recognised};
use nboom_model::{Scene, Shape};
use nboom_verify::{Certificate, Subject, certify, truth};
use serde::Serialize;

use crate::choices::Requests;
use crate::{Choices, PackageError};

/// The largest deviation allowed where the condition of the mass matrix is at most 1e4.
pub const TOLERANCE: f64 = 1e-11;

/// Beyond this condition of the mass matrix the compiled code may deviate in proportion.
const HARMLESS_CONDITION: f64 = 1e4;

/// Random states that are compared.
const STATES: usize = 100;

/// Those of them that the tests of a crate have.
const TESTED: usize = 20;

/// What the states are drawn from.
const SEED: u64 = 1970;

/// What a crate is certified for.
pub(crate) struct Certified {
    /// Deviations of accelerations.
    pub accelerations: Certificate,
    /// The largest residual of the equations, where there is a routine for them.
    pub equations: Option<f64>,
    /// States with what is to come out.
    pub tested: Vec<Tested>,
}

/// A state with its accelerations.
pub(crate) struct Tested {
    /// The state as routines take it.
    pub coordinates: Vec<f64>,
    /// ω̇, a_O and τ̇ as routines give them.
    pub accelerations: Vec<f64>,
    /// What solves the formulation's equations.
    pub unknowns: Vec<f64>,
}

impl Certified {
    /// Compares the graphs of a scene's routines with the recursion.
    ///
    /// # Errors
    /// [`PackageError::Deviation`] where they compute something else.
    pub fn new(
        scene: &Scene,
        choices: &Choices,
        requests: &Requests,
        recognised: &Recognised,
    ) -> Result<Self, PackageError> {
        let Recognised { topology, parameters, links } = recognised;
        let subject = Subject::new(scene.clone(), STATES, SEED)?;
        let parameters = parameters.write();
        let inputs: Vec<Vec<f64>> = subject
            .coordinates()
            .map(|state| [&parameters[..], &state.write(topology)].concat())
            .collect();
        let graph = trace(&requests.whole);
        let places = Layout::places(topology);
        let accelerations = certify(&subject, |i| {
            let found = graph.evaluate(&inputs[i]);
            let mut in_scene = found.clone();
            for (&link, place) in links.iter().zip(&places) {
                in_scene[Layout::OUTPUT + link] = found[Layout::OUTPUT + place];
            }
            in_scene
        })?;
        let worst = accelerations.from_recursion.max(accelerations.from_double_double);
        let check = |quantity, deviation: f64, tolerance| {
            if deviation <= tolerance {
                return Ok(());
            }
            let (topology, formulation) = (topology.to_string(), choices.formulation);
            Err(PackageError::Deviation { topology, formulation, quantity, deviation, tolerance })
        };
        check("accelerations", worst, TOLERANCE)?;
        let row = |(input, truth): (&Vec<f64>, Vec<f64>)| Tested {
            coordinates: input[parameters.len()..].to_vec(),
            unknowns: unknowns(choices.formulation, recognised, &truth),
            accelerations: in_routine(&truth, links, &places),
        };
        let mut tested: Vec<Tested> = inputs.iter().zip(truth(&subject)?).map(row).collect();
        let equations = requests.equations.as_ref().map(trace).map(|graph| {
            let states = inputs.iter().zip(&tested);
            let residuals = states.map(|(input, state)| residual(&graph, input, &state.unknowns));
            residuals.fold(0.0, f64::max)
        });
        if let Some(residual) = equations {
            check("equations", residual, TOLERANCE)?;
        }
        tested.truncate(TESTED);
        Ok(Self { accelerations, equations, tested })
    }

    /// The largest deviation of compiled code in any of the states.
    pub fn tolerance(&self) -> f64 {
        TOLERANCE * (self.accelerations.condition / HARMLESS_CONDITION).max(1.0)
    }

    /// The text of `CERTIFICATE.json`; `operations` are those of each request.
    pub fn json(
        &self,
        scene: &Scene,
        key: u64,
        requests: &[Request],
        operations: &[[Operations; 2]],
    ) -> String {
        let Certificate { states, seed, from_recursion, from_double_double, condition } =
            self.accelerations;
        let row = |(request, [evaluation, preparation]): (&Request, &[Operations; 2])| Routine {
            name: request.name.clone(),
            topology: request.topology.to_string(),
            formulation: request.formulation.name(),
            output: request.output.name(),
            level: request.level.name(),
            taken_for_granted: granted(&request.topology, &request.pinned, request.external),
            evaluation: (*evaluation).into(),
            preparation: (*preparation).into(),
        };
        let document = Document {
            scene: &scene.name,
            generator: env!("CARGO_PKG_VERSION"),
            request: format!("{key:016x}"),
            certified: &requests[0].name,
            states,
            seed,
            deviation_from_recursion: from_recursion,
            deviation_from_double_double: from_double_double,
            residual_of_equations: self.equations,
            condition,
            tolerance: self.tolerance(),
            routines: requests.iter().zip(operations).map(row).collect(),
        };
        let text = serde_json::to_string_pretty(&document);
        text.expect("numbers and texts are JSON") + "\n"
    }
}

/// Accelerations in the order of [`Layout`] from those in the scene's order.
fn in_routine(truth: &[f64], links: &[usize], places: &[usize]) -> Vec<f64> {
    let mut all = truth.to_vec();
    for (&link, place) in links.iter().zip(places) {
        all[Layout::OUTPUT + place] = truth[Layout::OUTPUT + link];
    }
    all
}

/// What the formulation's equations are solved by: v̇ or a_O, which are the same for O at the
/// inertial origin at rest, ω̇, then σ̇ or τ̇ appendage by appendage.
fn unknowns(formulation: Formulation, recognised: &Recognised, truth: &[f64]) -> Vec<f64> {
    let mut all = [&truth[3..6], &truth[..3]].concat();
    let mut links = recognised.links.iter();
    for &shape in recognised.topology.shapes() {
        let summed = formulation == Formulation::Report && matches!(shape, Shape::Chain(_));
        let mut inboard = 0.0;
        for link in links.by_ref().take(shape.hinges()) {
            let rate = truth[Layout::OUTPUT + link] + if summed { inboard } else { 0.0 };
            all.push(rate);
            inboard = rate;
        }
    }
    all
}

/// The largest residual of matrix · unknowns = right side, each in terms of the sum of the
/// magnitudes of what is added up.
fn residual(graph: &Graph, input: &[f64], unknowns: &[f64]) -> f64 {
    let found = graph.evaluate(input);
    let size = unknowns.len();
    let (matrix, forcing) = found.split_at(size * size);
    let rows = matrix.chunks_exact(size).zip(forcing).map(|(row, right)| {
        let terms = row.iter().zip(unknowns).map(|(entry, unknown)| entry * unknown);
        let (sum, scale) = terms.fold((-right, right.abs()), |(s, a), t| (s + t, a + t.abs()));
        let off = sum.abs() / scale.max(f64::MIN_POSITIVE);
        if off.is_nan() { f64::INFINITY } else { off }
    });
    rows.fold(0.0, f64::max)
}

#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    generator: &'static str,
    request: String,
    certified: &'a str,
    states: usize,
    seed: u64,
    deviation_from_recursion: f64,
    deviation_from_double_double: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual_of_equations: Option<f64>,
    condition: f64,
    tolerance: f64,
    routines: Vec<Routine>,
}

#[derive(Serialize)]
struct Routine {
    name: String,
    topology: String,
    formulation: &'static str,
    output: &'static str,
    level: &'static str,
    taken_for_granted: Vec<String>,
    evaluation: Counts,
    preparation: Counts,
}

#[derive(Serialize)]
struct Counts {
    additions: usize,
    multiplications: usize,
    divisions: usize,
    square_roots: usize,
    angles: usize,
}

impl From<Operations> for Counts {
    fn from(operations: Operations) -> Self {
        let Operations { additions, multiplications, divisions, square_roots, angles } = operations;
        Self { additions, multiplications, divisions, square_roots, angles }
    }
}
