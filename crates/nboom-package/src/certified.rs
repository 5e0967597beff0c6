//! How far the formulation of a routine is from the truth: its graph, interpreted on random
//! states, and which of them the compiled code is tested on.

use nboom_codegen::{Output, Request, held_at, trace};
use nboom_expr::Graph;
use nboom_formulation::{Formulation, Layout, Recognised};
use nboom_model::{External, Scene, SceneDescription, Shape};
use nboom_scalar::Vec3;
use nboom_verify::{
    Certificate, TestCase, Truth, allowance, certify, certify_equations, drives, of_largest, truth,
};

use crate::PackageError;

mod right_side;

/// The largest deviation of a formulation, relative and in terms of magnified rounding.
pub const TOLERANCE: f64 = 1e-11;

/// Compiled code may always deviate as much.
const ROUNDING: f64 = 1e-12;

/// What the states are drawn from.
pub(crate) const SEED: u64 = 1970;

/// Random states of the scene with all hinges free, and those of them that the compiled code is
/// tested on.
const FREE: [usize; 2] = [100, 20];

/// Random states with held hinges, each at other angles, and those of them that the compiled code
/// is tested on.
const HELD: [usize; 2] = [20, 4];

/// So many sets of angles are tried for these states: a routine takes only those at which what it assumes holds.
const TRIES: usize = 10 * HELD[0];

/// A routine's formulation against the truth.
pub(crate) struct Certified {
    /// How many states were compared.
    pub states: usize,
    /// What was found.
    pub found: Found,
    /// States with what is to come out.
    pub tested: Vec<Tested>,
}

/// Deviations of a formulation.
pub(crate) enum Found {
    /// Of accelerations.
    Accelerations(Certificate),
    /// Of matrix and right side.
    Equations {
        /// The largest deviation.
        deviation: f64,
        /// The largest residual of the equations for the true accelerations, each in terms of the sum of the
        /// magnitudes of what is added up, or of the natural size of right sides where that is larger.
        residual: f64,
    },
    /// The largest deviation of forces, relative to the largest of them or to their natural size.
    InverseDynamics(f64),
    /// Of rates of change, relative to the largest of their kind or to its natural size.
    RightSide {
        /// The largest deviation; those of accelerations in terms of magnified rounding.
        deviation: f64,
        /// The most that rounding is magnified in them, as [`Quantity`](nboom_verify::Quantity) has it.
        magnification: f64,
    },
}

/// A state with what a routine gives there.
pub(crate) struct Tested {
    /// The satellite's numbers.
    pub parameters: Vec<f64>,
    /// The state as routines take it.
    pub coordinates: Vec<f64>,
    /// ω̇, a_O and τ̇ as routines give them, or what causes them, or what solves the formulation's equations; or rates
    /// of change, and after them what the power is relative to.
    pub expected: Vec<f64>,
    /// What deviations are relative to where all of this cancels to nothing.
    pub least: f64,
    /// How much rounding is magnified in accelerations, as [`Quantity`](nboom_verify::Quantity) has it.
    pub magnification: f64,
}

impl Certified {
    /// Compares a routine's graph with the recursion, the hinges of the scene free or those that
    /// are not `free` held.
    ///
    /// # Errors
    /// [`PackageError::Deviation`] where they compute something else.
    pub fn new(
        scene: &Scene,
        request: &Request,
        free: Option<&[bool]>,
    ) -> Result<Self, PackageError> {
        let scene = if request.external { pushed(scene) } else { scene.clone() };
        let (mut test_cases, tested) = match free {
            None => (vec![TestCase::new(scene, FREE[0], SEED)?], FREE[1]),
            Some(free) => (held(&scene, request, free)?, HELD[1]),
        };
        if request.output == Output::RightSide {
            test_cases = test_cases.into_iter().map(TestCase::with_lines_pushing).collect();
        }
        let graph = trace(request);
        let found = match request.output {
            Output::Accelerations => {
                Found::Accelerations(accelerations(&graph, request, &test_cases)?)
            }
            Output::Equations => {
                let residual = deviation(&graph, request, &test_cases, |found, tested| {
                    residual(found, &tested.expected, tested.least)
                })?;
                // Rows that are wrong by a factor leave no residual.
                let deviation = equations(&graph, request, &test_cases)?;
                Found::Equations { deviation, residual }
            }
            Output::InverseDynamics => {
                Found::InverseDynamics(deviation(&graph, request, &test_cases, |found, tested| {
                    of_largest(found, &tested.expected, tested.least)
                })?)
            }
            Output::RightSide => {
                let mut magnification = 1.0_f64;
                let deviation = deviation(&graph, request, &test_cases, |found, tested| {
                    magnification = magnification.max(tested.magnification);
                    right_side::deviation(found, tested)
                })?;
                Found::RightSide { deviation, magnification }
            }
        };
        let states = test_cases.iter().map(|test_case| test_case.states().len()).sum();
        let mut cases = Vec::new();
        for test_case in test_cases {
            let missing = tested - cases.len();
            cases.extend(self::tested(&test_case.with_first_states(missing), request)?);
        }
        let certified = Self { states, found, tested: cases };
        certified.require_close(request)?;
        Ok(certified)
    }

    fn require_close(&self, request: &Request) -> Result<(), PackageError> {
        let (quantity, deviation) = match &self.found {
            Found::Accelerations(found) => ("accelerations", found.worst),
            Found::Equations { deviation, residual } => ("equations", deviation.max(*residual)),
            Found::InverseDynamics(deviation) => ("inverse dynamics", *deviation),
            Found::RightSide { deviation, .. } => ("rates of change", *deviation),
        };
        if deviation <= TOLERANCE {
            return Ok(());
        }
        let (topology, formulation) = (request.topology.to_string(), request.formulation);
        let tolerance = TOLERANCE;
        Err(PackageError::Deviation { topology, formulation, quantity, deviation, tolerance })
    }

    /// The largest deviation of compiled code from the truth: four times that of the formulation,
    /// which rounds in another order, and never less than `ROUNDING`.
    pub fn tolerance(&self) -> f64 {
        match &self.found {
            Found::Accelerations(found) => {
                allowance(found.magnification) * ROUNDING.max(4.0 * found.from_double_double)
            }
            Found::RightSide { deviation, magnification } => {
                allowance(*magnification) * ROUNDING.max(4.0 * deviation)
            }
            Found::Equations { residual: found, .. } | Found::InverseDynamics(found) => {
                ROUNDING.max(4.0 * found)
            }
        }
    }
}

/// The scene with something that acts on its main body, so that a wrench is compared.
fn pushed(scene: &Scene) -> Scene {
    if !scene.externals.is_empty() || scene.base.is_held() {
        return scene.clone();
    }
    let force = Vec3::new(1.0, -0.7, 0.4) * scene.main_body.mass;
    let point = Vec3::new(0.3, 0.2, -0.5);
    let thrust = External::thrust(force, point, [0.0, f64::INFINITY]);
    let description = SceneDescription { externals: vec![thrust], ..(**scene).clone() };
    Scene::new(description).expect("a force leaves a scene valid")
}

/// The scene in states with held hinges that the routine accepts, one random state of each.
///
/// # Errors
/// [`PackageError::NotAccepted`] where there is none.
fn held(scene: &Scene, request: &Request, free: &[bool]) -> Result<Vec<TestCase>, PackageError> {
    let mut accepted = Vec::new();
    for i in 0..TRIES {
        let held = held_at(free, 0.4 + 0.7 * i as f64);
        let test_case = TestCase::held_at(scene.clone(), held, SEED + i as u64)?;
        if accepts(request, recognised(&test_case)) {
            accepted.push(test_case);
        }
        if accepted.len() == HELD[0] {
            break;
        }
    }
    if accepted.is_empty() {
        let topology = request.topology.to_string();
        return Err(PackageError::NotAccepted { topology, tries: TRIES });
    }
    Ok(accepted)
}

/// Whether a satellite has the numbers that a routine assumes; as [`Kernel::accepts`](nboom_scalar::Kernel::accepts).
fn accepts(request: &Request, recognised: &Recognised) -> bool {
    let parameters = recognised.parameters.write();
    let mut pairs = request.assumptions.iter().zip(parameters);
    recognised.topology == request.topology
        && pairs.all(|(assumed, found)| assumed.is_none_or(|assumed| assumed == found))
}

/// The largest deviations in any of the test cases' states.
fn accelerations(
    graph: &Graph,
    request: &Request,
    test_cases: &[TestCase],
) -> Result<Certificate, PackageError> {
    let mut most: Option<Certificate> = None;
    for test_case in test_cases {
        let recognised = recognised(test_case);
        let inputs = inputs(test_case, request);
        let places = Layout::places(&request.topology);
        let found = certify(test_case, |i| {
            let found = graph.evaluate(&inputs[i].concat());
            let mut in_scene = found.clone();
            for (&link, place) in recognised.links.iter().zip(&places) {
                in_scene[Layout::OUTPUT + link] = found[Layout::OUTPUT + place];
            }
            in_scene
        })?;
        most = Some(most.map_or(found, |most| Certificate {
            states: most.states + found.states,
            from_recursion: most.from_recursion.max(found.from_recursion),
            from_double_double: most.from_double_double.max(found.from_double_double),
            worst: most.worst.max(found.worst),
            magnification: most.magnification.max(found.magnification),
            ..most
        }));
    }
    Ok(most.expect("there is a test case"))
}

/// The largest deviation of matrix and right side in any of the test cases' states.
fn equations(
    graph: &Graph,
    request: &Request,
    test_cases: &[TestCase],
) -> Result<f64, PackageError> {
    test_cases.iter().try_fold(0.0_f64, |most, test_case| {
        let inputs = inputs(test_case, request);
        let of_state = |i: usize| graph.evaluate(&inputs[i].concat());
        Ok(most.max(certify_equations(test_case, request.formulation, of_state)?))
    })
}

/// The largest deviation in any of the test cases' states, `off` of what is found there.
fn deviation(
    graph: &Graph,
    request: &Request,
    test_cases: &[TestCase],
    mut off: impl FnMut(&[f64], &Tested) -> f64,
) -> Result<f64, PackageError> {
    let mut most = 0.0_f64;
    for test_case in test_cases {
        for tested in tested(test_case, request)? {
            let inputs = [&tested.parameters[..], &tested.coordinates].concat();
            most = most.max(off(&graph.evaluate(&inputs), &tested));
        }
    }
    Ok(most)
}

/// All states of a test case with what is to come out.
fn tested(test_case: &TestCase, request: &Request) -> Result<Vec<Tested>, PackageError> {
    let (recognised, truth) = (recognised(test_case), truth(test_case)?);
    let inputs = inputs(test_case, request);
    match request.output {
        Output::InverseDynamics => return motions(recognised, test_case, inputs, truth),
        Output::RightSide => return right_side::tested(test_case, &truth),
        Output::Accelerations | Output::Equations => {}
    }
    let case = |([parameters, coordinates], truth): ([Vec<f64>; 2], Truth)| {
        let Truth { accelerations, floor, magnification, .. } = truth;
        let (expected, least) = match request.output {
            Output::Equations => {
                (unknowns(request.formulation, recognised, &accelerations), floor.forcing)
            }
            _ => (in_routine(recognised, &accelerations), floor.accelerations),
        };
        Tested { parameters, coordinates, expected, least: above_zero(least), magnification }
    };
    Ok(inputs.into_iter().zip(truth).map(case).collect())
}

/// The states with accelerations opposite to the true ones, for the forces that these take do not cancel
/// where nothing acts.
fn motions(
    recognised: &Recognised,
    test_case: &TestCase,
    inputs: Vec<[Vec<f64>; 2]>,
    truth: Vec<Truth>,
) -> Result<Vec<Tested>, PackageError> {
    let opposite = |of_state: &Truth| -> Vec<f64> {
        of_state.accelerations.iter().map(|number| -number).collect()
    };
    let accelerations: Vec<Vec<f64>> = truth.iter().map(opposite).collect();
    let drives = drives(test_case, &accelerations)?;
    let mut cases = Vec::new();
    for (i, [parameters, mut coordinates]) in inputs.into_iter().enumerate() {
        let accelerations = in_routine(recognised, &accelerations[i]);
        coordinates[3..Layout::STATE].copy_from_slice(&accelerations[..Layout::OUTPUT]);
        for place in Layout::places(&recognised.topology) {
            let [_, _, torque] = Layout::hinge_in_state(&recognised.topology, place);
            coordinates[torque] = accelerations[Layout::OUTPUT + place];
        }
        let expected = in_routine(recognised, &drives[i]);
        let least = above_zero(truth[i].floor.forcing);
        let magnification = truth[i].magnification;
        cases.push(Tested { parameters, coordinates, expected, least, magnification });
    }
    Ok(cases)
}

/// What numbers may be divided by.
fn above_zero(least: f64) -> f64 {
    least.max(f64::MIN_POSITIVE)
}

/// Parameters and coordinates of each state.
fn inputs(test_case: &TestCase, request: &Request) -> Vec<[Vec<f64>; 2]> {
    let parameters = recognised(test_case).parameters.write();
    let states = test_case.coordinates();
    states.map(|state| [parameters.clone(), state.write(&request.topology)]).collect()
}

fn recognised(test_case: &TestCase) -> &Recognised {
    test_case.recognised().expect("requests are refused before when there are no chains")
}

/// Accelerations, or what causes them, in the order of [`Layout`] from those in the scene's order.
fn in_routine(recognised: &Recognised, truth: &[f64]) -> Vec<f64> {
    let mut all = truth.to_vec();
    for (&link, place) in recognised.links.iter().zip(Layout::places(&recognised.topology)) {
        all[Layout::OUTPUT + place] = truth[Layout::OUTPUT + link];
    }
    all
}

/// What the formulation's equations are solved by: v̇ or a_O, which are the same for O at the
/// inertial origin at rest, ω̇, then σ̇ or τ̇ appendage by appendage.
fn unknowns(formulation: Formulation, recognised: &Recognised, truth: &[f64]) -> Vec<f64> {
    let mut all = [&truth[3..6], &truth[..3]].concat();
    let mut links = recognised.links.iter();
    for shape in recognised.topology.shapes() {
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

/// The largest residual of matrix · unknowns = right side. A row in which all cancels is rounding alone, so none
/// is relative to less than `least`.
fn residual(found: &[f64], unknowns: &[f64], least: f64) -> f64 {
    let size = unknowns.len();
    let (matrix, forcing) = found.split_at(size * size);
    let rows = matrix.chunks_exact(size).zip(forcing).map(|(row, right)| {
        let terms = row.iter().zip(unknowns).map(|(entry, unknown)| entry * unknown);
        let (sum, scale) = terms.fold((-right, right.abs()), |(s, a), t| (s + t, a + t.abs()));
        let off = sum.abs() / scale.max(least);
        if off.is_nan() { f64::INFINITY } else { off }
    });
    rows.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests;
