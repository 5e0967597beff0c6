//! Generated code against the closed form it was traced from: bit for bit at level `exact`, to
//! rounding at level `fast`, in this processor's instruction set; and what a routine assumes is
//! never read.

use nboom_formulation::{
    Coordinates, Equations, Formulation, Layout, Parameters, assumptions_in_a_word,
};
use nboom_model::Topology;
use nboom_scalar::{Batch, Eight, InstructionSet, Kernel, Routine};

use support::{Rng, parameters, state};

mod support;

#[allow(missing_docs)]
mod exact {
    include!(concat!(env!("OUT_DIR"), "/exact.rs"));
}

/// Calls a function for each routine of level `exact`.
macro_rules! for_each_exact_routine {
    ($check:ident) => {
        $check::<exact::RolledS3>();
        $check::<exact::RolledP>();
        $check::<exact::RolledS30>();
        $check::<exact::RolledMixed>();
        $check::<exact::ReportS2P>();
        $check::<exact::RelativeS2P>();
        $check::<exact::SymmetricS2P>();
        $check::<exact::ArticulatedS2P>();
        $check::<exact::MomentumS2P>();
        $check::<exact::ReportS1P>();
        $check::<exact::RelativeS1P>();
        $check::<exact::SymmetricS1P>();
        $check::<exact::ArticulatedS1P>();
        $check::<exact::MomentumS1P>();
        $check::<exact::ReportEquationsS2P>();
        $check::<exact::RelativeEquationsS2P>();
        $check::<exact::SymmetricEquationsS2P>();
    };
}

/// The formulation evaluated by the library: accelerations, or as many numbers as its equations.
struct ClosedForm {
    topology: Topology,
    formulation: Formulation,
    outputs: usize,
}

impl ClosedForm {
    fn of<T: Routine>() -> Self {
        Self::named(T::TOPOLOGY, T::FORMULATION, T::OUTPUTS)
    }

    fn of_kernel(kernel: &Kernel) -> Self {
        Self::named(kernel.topology, kernel.formulation, kernel.outputs)
    }

    fn named(topology: &str, formulation: &str, outputs: usize) -> Self {
        let formulation = Formulation::named(formulation).expect("a formulation's name");
        Self { topology: topology.parse().expect("a topology's name"), formulation, outputs }
    }

    fn evaluate(&self, parameters: &[f64], state: &[f64]) -> Vec<f64> {
        let Self { topology, formulation, outputs } = self;
        let satellite = Parameters::read(topology, parameters.iter().copied());
        let state = Coordinates::read(topology, state);
        if *outputs == Layout::outputs(topology) {
            return formulation.solve(topology, &satellite, &state).write(topology);
        }
        let Equations { matrix, forcing } =
            formulation.equations(topology, &satellite, &state).expect("it has equations");
        assert_eq!(*outputs, matrix.len() + forcing.len());
        [matrix, forcing].concat()
    }
}

fn generated<T: Routine>(parameters: &[f64], state: &[f64]) -> Vec<f64> {
    let (mut constants, mut out) = (vec![0.0; T::CONSTANTS], vec![0.0; T::OUTPUTS]);
    T::prepare(parameters, &mut constants);
    T::evaluate(&constants, state, &mut out);
    out
}

fn is_the_closed_form<T: Routine>() {
    let closed_form = ClosedForm::of::<T>();
    let topology = &closed_form.topology;
    let mut numbers = Rng::new(1970);
    for case in 0..100 {
        let parameters = parameters(topology, T::ASSUMPTIONS, &mut numbers);
        let state = state(topology, T::EXTERNAL, &mut numbers);
        let (found, expected) =
            (generated::<T>(&parameters, &state), closed_form.evaluate(&parameters, &state));
        assert_eq!(found, expected, "{} {} case {case}", T::FORMULATION, T::TOPOLOGY);
    }
}

#[test]
fn exact_code_is_the_closed_form_bit_for_bit() {
    for_each_exact_routine!(is_the_closed_form);
}

/// Appendages and links that go through loops together.
#[test]
fn what_is_assumed_of_one_appendage_or_link_is_not_of_the_others() {
    is_the_closed_form::<exact::RolledUnequal>();
    const { assert!(exact::RolledUnequal::ASSUMPTIONS.len() == 3 + 4 * 5) };
}

#[test]
fn lanes_hold_independent_states() {
    type T = exact::RolledMixed;
    let closed_form = ClosedForm::of::<T>();
    let topology = &closed_form.topology;
    let mut numbers = Rng::new(7);
    let mut eight = |draw: &dyn Fn(&mut Rng) -> Vec<f64>| [(); 8].map(|()| draw(&mut numbers));
    let satellites = eight(&|numbers| parameters(topology, T::ASSUMPTIONS, numbers));
    let states = eight(&|numbers| state(topology, false, numbers));
    let together = |all: &[Vec<f64>; 8]| -> Vec<Eight> {
        (0..all[0].len()).map(|i| Eight(std::array::from_fn(|lane| all[lane][i]))).collect()
    };
    let (p, x) = (together(&satellites), together(&states));
    let zero = Eight::default();
    for set in [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512] {
        let Some(batch) = Batch::with::<T>(set) else { continue };
        let (mut k, mut out) = (vec![zero; T::CONSTANTS], vec![zero; T::OUTPUTS]);
        batch.prepare(&p, &mut k);
        batch.evaluate(&k, &x, &mut out);
        for (lane, (satellite, state)) in satellites.iter().zip(&states).enumerate() {
            for (found, expected) in out.iter().zip(closed_form.evaluate(satellite, state)) {
                // Sines, products and sums round in other ways.
                assert!((found.0[lane] - expected).abs() < 1e-11 * (1.0 + expected.abs()));
            }
        }
    }
}

/// Other numbers in the place of what the routine assumes change nothing.
fn never_reads_assumptions<T: Routine>() {
    let topology = ClosedForm::of::<T>().topology;
    let mut numbers = Rng::new(3);
    let mut parameters = parameters(&topology, T::ASSUMPTIONS, &mut numbers);
    let mut state = state(&topology, T::EXTERNAL, &mut numbers);
    let expected = generated::<T>(&parameters, &state);
    assert!(expected.iter().all(|number| number.is_finite()));
    for &(i, _) in T::ASSUMPTIONS {
        parameters[i] = f64::NAN;
    }
    if !T::EXTERNAL {
        state[3..9].fill(f64::NAN);
    }
    assert_eq!(generated::<T>(&parameters, &state), expected, "{} {}", T::FORMULATION, T::TOPOLOGY);
}

#[test]
fn what_a_routine_never_reads_assumptions_is_never_read() {
    for_each_exact_routine!(never_reads_assumptions);
    const { assert!(!exact::MomentumS1P::ASSUMPTIONS.is_empty() && !exact::MomentumS1P::EXTERNAL) };
}

#[test]
fn stock_routines_agree_with_the_closed_form_in_this_processors_code() {
    let (stock, of_equations) = (nboom_routines::all(), nboom_routines::equations());
    assert!(stock.len() > 20 && of_equations.len() == 3);
    for kernel in stock.iter().chain(of_equations) {
        let closed_form = ClosedForm::of_kernel(kernel);
        let topology = &closed_form.topology;
        assert_eq!(topology.to_string(), kernel.topology);
        let mut numbers = Rng::new(11);
        for case in 0..50 {
            let parameters = parameters(topology, kernel.assumptions, &mut numbers);
            assert!(kernel.accepts(&parameters));
            let state = state(topology, kernel.external, &mut numbers);
            let (mut constants, mut found) =
                (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
            kernel.prepare(&parameters, &mut constants);
            kernel.evaluate(&constants, &state, &mut found);
            let expected = closed_form.evaluate(&parameters, &state);
            let scale = expected.iter().fold(1.0_f64, |m, e| m.max(e.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                // Fused and regrouped rounding, on mass matrices of condition up to 1e3.
                let same = (found - expected).abs() < 1e-12 * scale;
                assert!(same, "{} {} case {case}", kernel.formulation, kernel.topology);
            }
        }
    }
}

#[test]
fn the_stock_has_all_formulations_of_one_topology_and_articulated_before_them() {
    let stock = nboom_routines::all();
    let of = |formulation: Formulation| {
        let is = |kernel: &&Kernel| kernel.formulation == formulation.name();
        stock.iter().rev().find(is).map(|kernel| (kernel.topology, kernel.assumptions.len()))
    };
    for formulation in Formulation::ALL {
        assert_eq!(of(formulation), Some(("S2_P", 0)), "{formulation}");
    }
    let first_other = stock.iter().position(|kernel| kernel.formulation != "articulated");
    let articulated = |kernel: &&Kernel| kernel.formulation == "articulated";
    assert_eq!(first_other, Some(stock.iter().filter(articulated).count()));
}

#[test]
fn a_word_says_what_each_routine_of_the_stock_assumes() {
    let words = |topology: &str| -> Vec<&str> {
        let of_topology =
            nboom_routines::for_runs().iter().filter(|kernel| kernel.topology == topology);
        of_topology.map(assumptions_in_a_word).collect()
    };
    assert_eq!(words("4xS5"), ["principal", "mirrored", "general"].repeat(2));
    assert_eq!(words("6xS4"), ["principal", "mirrored", "general"]);
    // Right sides of wings come with couplings too, but for mirrored links.
    let of_wings = ["principal", "principal", "mirrored", "general", "general"];
    assert_eq!(words("2xS4"), [&["principal", "mirrored", "general"], &of_wings[..]].concat());
    assert_eq!(words("S1_P")[..2], ["principal", "general"]);
    assert_eq!(words("Trrr")[..2], ["principal", "general"]);
    assert_eq!(words("M")[..2], ["principal", "general"]);
}

#[test]
fn a_parameter_that_breaks_an_assumption_is_not_accepted() {
    for kernel in nboom_routines::all().iter().filter(|kernel| !kernel.assumptions.is_empty()) {
        let topology = ClosedForm::of_kernel(kernel).topology;
        let mut parameters = parameters(&topology, kernel.assumptions, &mut Rng::new(5));
        parameters[kernel.assumptions[0].0] += 1e-12;
        assert!(!kernel.accepts(&parameters));
        assert!(!kernel.accepts(&parameters[1..]));
    }
}

#[test]
fn parameters_that_are_no_numbers_are_not_accepted() {
    for kernel in nboom_routines::all().iter().chain(nboom_routines::equations()) {
        let topology = ClosedForm::of_kernel(kernel).topology;
        let good = parameters(&topology, kernel.assumptions, &mut Rng::new(5));
        assert!(kernel.accepts(&good));
        for at in 0..good.len() {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut parameters = good.clone();
                parameters[at] = bad;
                assert!(!kernel.accepts(&parameters), "{} {at}: {bad}", kernel.topology);
            }
        }
    }
}
