//! Code that is right passes, and code that is wrong by a little does not.

mod support;

use nboom_formulation::{Coordinates, Equations, Formulation, Parameters};
use nboom_model::Topology;
use nboom_scalar::{Isa, Kernel, Real, Routine};
use nboom_verify::{
    Comparison, Hinges, Label, Quantity, TestCase, VerifyError, certify, compare, truth,
};

use support::{articulated_s3_p, fork, s2_p, wrong_s3_p};

const TOLERANCE: f64 = 1e-11;

/// Parameters, coordinates, hinges and unknowns of [`s2_p`].
const PARAMETERS: usize = 82;
const COORDINATES: usize = 21;
const UNKNOWNS: usize = 10;
const EQUATIONS: usize = UNKNOWNS * UNKNOWNS + UNKNOWNS;

fn topology() -> Topology {
    s2_p().recognised().expect("a chain and a paddle").topology.clone()
}

fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) {
    constants.copy_from_slice(parameters);
}

fn given<R: Real>(constants: &[R], coordinates: &[R]) -> (Parameters<R>, Coordinates<R>) {
    let parameters = Parameters::read(&topology(), constants.iter().copied());
    (parameters, Coordinates::read(&topology(), coordinates))
}

/// `articulated`, with one acceleration wrong by 1e-9 / `WRONG` of itself, or right where it is 0.
struct Accelerations<const WRONG: u32>;

impl<const WRONG: u32> Routine for Accelerations<WRONG> {
    const RESULT: &'static str = "accelerations";
    const TOPOLOGY: &'static str = "S2_P";
    const FORMULATION: &'static str = "articulated";
    const ASSUMPTIONS: &'static [(usize, f64)] = &[];
    const EXTERNAL: bool = true;
    const PARAMETERS: usize = PARAMETERS;
    const CONSTANTS: usize = PARAMETERS;
    const COORDINATES: usize = COORDINATES;
    const OUTPUTS: usize = UNKNOWNS;

    fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) {
        prepare(parameters, constants);
    }

    fn evaluate<R: Real>(constants: &[R], coordinates: &[R], outputs: &mut [R]) {
        let (parameters, coordinates) = given(constants, coordinates);
        let found = Formulation::Articulated.solve(&topology(), &parameters, &coordinates);
        outputs.copy_from_slice(&found.write(&topology()));
        let last = UNKNOWNS - 1;
        outputs[last] = outputs[last] * R::constant(1.0 + 1e-9 * f64::from(WRONG));
    }

    fn evaluate_packed<I: Isa>(constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
        Self::evaluate(constants, coordinates, outputs);
    }
}

/// The system of `report` (0) or `relative` (1), with number `WRONG` of it wrong by 1e-9 of
/// itself, or right where it has no such number.
struct System<const RELATIVE: u32, const WRONG: usize>;

impl<const RELATIVE: u32, const WRONG: usize> Routine for System<RELATIVE, WRONG> {
    const RESULT: &'static str = "equations";
    const TOPOLOGY: &'static str = "S2_P";
    const FORMULATION: &'static str = if RELATIVE == 1 { "relative" } else { "report" };
    const ASSUMPTIONS: &'static [(usize, f64)] = &[];
    const EXTERNAL: bool = true;
    const PARAMETERS: usize = PARAMETERS;
    const CONSTANTS: usize = PARAMETERS;
    const COORDINATES: usize = COORDINATES;
    const OUTPUTS: usize = EQUATIONS;

    fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) {
        prepare(parameters, constants);
    }

    fn evaluate<R: Real>(constants: &[R], coordinates: &[R], outputs: &mut [R]) {
        let (parameters, coordinates) = given(constants, coordinates);
        let formulation = Formulation::named(Self::FORMULATION).expect("a name");
        let found = formulation.equations(&topology(), &parameters, &coordinates);
        let Equations { matrix, forcing } = found.expect("it has them");
        outputs.copy_from_slice(&[matrix, forcing].concat());
        if let Some(wrong) = outputs.get_mut(WRONG) {
            *wrong = *wrong * R::constant(1.0 + 1e-9);
        }
    }

    fn evaluate_packed<I: Isa>(constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
        Self::evaluate(constants, coordinates, outputs);
    }
}

fn compared(kernels: &[Kernel], of_equations: &[Kernel]) -> Comparison {
    compare(&s2_p(), &[], kernels.to_vec().leak(), of_equations, TOLERANCE)
        .expect("all states have accelerations")
}

/// Generated code whose deviations are above the tolerance, with what it computes.
fn caught(comparison: &Comparison) -> Vec<(Quantity, &'static str)> {
    let wrong = comparison.rows.iter().filter(|row| row.worst() > TOLERANCE);
    wrong.map(|row| (row.quantity, row.label.path)).collect()
}

#[test]
fn right_code_passes() {
    let kernels = [Kernel::of::<Accelerations<0>>()];
    let of_equations = [Kernel::of::<System<0, EQUATIONS>>(), Kernel::of::<System<1, EQUATIONS>>()];
    let comparison = compared(&kernels, &of_equations);
    assert!(comparison.passed() && caught(&comparison).is_empty(), "{comparison:?}");
    assert_eq!(comparison.topology.as_deref(), Some("S2_P"));
    let count = |quantity| comparison.rows.iter().filter(|row| row.quantity == quantity).count();
    assert_eq!(count(Quantity::Accelerations), 8);
    assert_eq!(count(Quantity::MassMatrix), 6);
    assert_eq!(count(Quantity::Forcing), 6);
    assert!(comparison.rows.iter().all(|row| row.from_double_double > 0.0), "{comparison:?}");
    assert!(comparison.worst().worst() < 1e-12, "{comparison:?}");
    assert!(comparison.not_covered.is_empty());
}

#[test]
fn wrong_accelerations_are_caught() {
    let comparison = compared(&[Kernel::of::<Accelerations<1>>()], &[]);
    assert!(!comparison.passed());
    assert_eq!(caught(&comparison), [(Quantity::Accelerations, "generated")]);
    let worst = comparison.worst();
    assert_eq!(worst.label.to_string(), "generated articulated (general)");
    // Wrong by 1e-9 of one number, relative to the largest one.
    let from_recursion = worst.from_recursion.expect("not the recursion");
    assert!(from_recursion > 1e-10 && from_recursion < 1.01e-9, "{from_recursion:e}");
    assert!((worst.from_double_double - from_recursion).abs() < 1e-13);
}

#[test]
fn wrong_matrices_and_forcings_are_caught() {
    // The last diagonal entry, that of the paddle's hinge, and the last entry of the forcing.
    const DIAGONAL: usize = UNKNOWNS * UNKNOWNS - 1;
    const LAST: usize = EQUATIONS - 1;
    for (kernel, quantity) in [
        (Kernel::of::<System<0, DIAGONAL>>(), Quantity::MassMatrix),
        (Kernel::of::<System<1, DIAGONAL>>(), Quantity::MassMatrix),
        (Kernel::of::<System<0, LAST>>(), Quantity::Forcing),
        (Kernel::of::<System<1, LAST>>(), Quantity::Forcing),
    ] {
        let comparison = compared(&[], &[kernel]);
        assert_eq!(caught(&comparison), [(quantity, "generated")], "{}", kernel.formulation);
    }
}

#[test]
fn the_matrix_of_another_formulation_is_caught() {
    let mut mislabelled = Kernel::of::<System<1, EQUATIONS>>();
    mislabelled.formulation = "report";
    let comparison = compared(&[], &[mislabelled]);
    assert_eq!(caught(&comparison), [(Quantity::MassMatrix, "generated")]);
}

#[test]
fn routines_that_are_not_what_they_say_are_refused() {
    let test_case = s2_p();
    let of_equations = Kernel::of::<System<0, EQUATIONS>>();
    let refused = compare(&test_case, &[], vec![of_equations].leak(), &[], TOLERANCE);
    assert!(matches!(refused, Err(VerifyError::Sizes { outputs: EQUATIONS, .. })), "{refused:?}");
    let mut articulated = of_equations;
    articulated.formulation = "articulated";
    let refused = compare(&test_case, &[], &[], &[articulated], TOLERANCE);
    let message = refused.expect_err("articulated has no matrix").to_string();
    assert_eq!(message, "a routine gives a matrix of articulated, which has none");
}

#[test]
fn a_certificate_tells_right_code_from_wrong() {
    let test_case = s2_p();
    let mut recursion = test_case.recursion();
    let right = certify(&test_case, |i| recursion.accelerations(i)).expect("accelerations");
    assert_eq!((right.states, right.seed, right.from_recursion), (40, 1970, 0.0));
    assert!(right.from_double_double > 0.0 && right.from_double_double < 1e-13, "{right:?}");
    assert!(right.magnification > 1.0 && right.magnification < 1e4, "{right:?}");

    let wrong = certify(&test_case, |i| {
        let mut found = recursion.accelerations(i);
        let largest = found.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
        if i == 7 {
            found[4] += 1e-9 * largest;
        }
        found
    });
    let wrong = wrong.expect("accelerations");
    assert!((wrong.from_recursion - 1e-9).abs() < 1e-15, "{wrong:?}");
    assert!((wrong.from_double_double - 1e-9).abs() < 1e-13, "{wrong:?}");
    let nothing = certify(&test_case, |_| vec![f64::NAN; UNKNOWNS]).expect("accelerations");
    assert!(nothing.from_recursion.is_infinite() && nothing.from_double_double.is_infinite());
    let too_few = certify(&test_case, |_| Vec::new()).expect("accelerations");
    assert!(too_few.from_recursion.is_infinite());
}

#[test]
fn the_truth_is_that_of_double_double() {
    let test_case = s2_p();
    let truth = truth(&test_case).expect("accelerations");
    let certificate =
        certify(&test_case, |i| truth[i].accelerations.clone()).expect("accelerations");
    assert_eq!(certificate.from_double_double, 0.0);
    // The recursion in f64 has errors of its own.
    let rounding = certificate.from_recursion;
    assert!(rounding > 0.0 && rounding < 1e-13, "{rounding:e}");
}

#[test]
fn a_tree_is_compared_as_a_tree() {
    let test_case = TestCase::new(fork(), 10, 1).expect("finite");
    let comparison = compare(&test_case, &[], &[], &[], TOLERANCE).expect("accelerations");
    assert!(comparison.passed(), "{comparison:?}");
    assert_eq!(comparison.topology.as_deref(), Some("Tr(p)(r)"));
    let labels: Vec<_> = comparison.rows.iter().map(|row| (row.quantity, row.label)).collect();
    let symmetric = Label::generic("symmetric");
    let articulated = Label::generic("articulated");
    let of_accelerations = [Label::RECURSION, Label::DENSE, symmetric, articulated];
    let of_accelerations = of_accelerations.map(|label| (Quantity::Accelerations, label));
    let of_equations = [Quantity::MassMatrix, Quantity::Forcing]
        .map(|quantity| [(quantity, Label::RECURSION), (quantity, symmetric)]);
    assert_eq!(labels, [&of_accelerations[..], of_equations.as_flattened()].concat());
    let others: Vec<_> = comparison.not_covered.iter().map(|code| code.formulation).collect();
    assert_eq!(others, [Some("report"), Some("relative"), Some("momentum"), None]);
    assert!(comparison.not_covered.iter().all(|code| code.why.ends_with("topology Tr(p)(r)")));
}

#[test]
fn code_is_compared_while_hinges_are_held() {
    let free = s2_p();
    let held = TestCase::with_held_hinges(free.scene(), 60, 1970).expect("finite");
    let right = compare(&free, &held, articulated_s3_p(), &[], TOLERANCE).expect("accelerations");
    assert!(right.passed(), "{right:?}");
    assert_eq!((right.states, right.held), (100, 60));
    let with_held = || right.rows.iter().filter(|row| row.hinges == Hinges::Held);
    // Closed forms cover every mode; the routine those that are large enough for it.
    for row in with_held() {
        let most = if row.label.path == "generated" { 1..60 } else { 60..61 };
        assert!(most.contains(&row.states) && (41..=100).contains(&row.state), "{row:?}");
    }
    let generated = with_held().filter(|row| row.label.path == "generated").collect::<Vec<_>>();
    assert!(matches!(generated[..], [row] if row.label.virtual_links > 1), "{generated:?}");
    // Five formulations and the recursion, three of them with equations, the factored mass matrix,
    // and the routine.
    assert_eq!(with_held().count(), 8 + 2 * 4);

    // Compared with nothing but held hinges, so that these alone can tell.
    let free = TestCase::new(free.scene().clone(), 0, 1970).expect("finite");
    let wrong = compare(&free, &held, wrong_s3_p(), &[], TOLERANCE).expect("accelerations");
    assert_eq!(caught(&wrong), [(Quantity::Accelerations, "generated")]);
    assert_eq!(wrong.worst().hinges, Hinges::Held);
}
