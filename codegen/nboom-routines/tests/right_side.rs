//! Generated right sides against the equations they were traced from: bit for bit at level `exact`, to
//! rounding at level `fast`, in code of every instruction set and on eight states at once; and what a
//! routine assumes is never read.

use nboom_formulation::{Forces, Formulation, Layout, Parameters, RightSideLayout, right_side};
use nboom_model::Topology;
use nboom_scalar::{Batch, Eight, InstructionSet, Kernel, Routine};

use support::Rng;

mod support;

#[allow(missing_docs)]
mod exact {
    include!(concat!(env!("OUT_DIR"), "/exact_right_sides.rs"));
}

/// Calls a function for each routine of level `exact`.
macro_rules! for_each_exact_routine {
    ($check:ident) => {
        $check::<exact::RolledS3>();
        $check::<exact::RolledP>();
        $check::<exact::RolledS30>();
        $check::<exact::RolledMixed>();
        $check::<exact::StraightM>();
        $check::<exact::StraightS1P>();
        $check::<exact::PushedStraightS1P>();
        $check::<exact::PushedS2P>();
        $check::<exact::PushedLimb>();
        $check::<exact::PushedS3>();
        $check::<exact::CoupledS3>();
        $check::<exact::CoupledRolled>();
    };
}

/// A satellite, what acts on it, and its variables.
struct Case {
    topology: Topology,
    parameters: Vec<f64>,
    y: Vec<f64>,
}

impl Case {
    /// One that has what is assumed; lines push some of its links, and hinges are coupled, where nothing is assumed of them.
    fn random(topology: &str, assumptions: &[(usize, f64)], numbers: &mut Rng) -> Self {
        let topology: Topology = topology.parse().expect("a topology's name");
        let mut parameters = support::parameters(&topology, &[], numbers);
        let mut forces = Forces::none(topology.hinges());
        for line in forces.lines.iter_mut().step_by(2) {
            line.law = nboom_elements::KickOffLaw::of_numbers([0.5, -0.2, 0.1, 0.02]);
            line.point = nboom_scalar::Vec3::new(0.3, 0.5, -0.2);
            line.main_body_point = nboom_scalar::Vec3::new(numbers.between(-1.0, 1.0), 0.2, 0.1);
        }
        let of_lines = RightSideLayout::line(&topology, 0).start;
        parameters.resize_with(of_lines, || numbers.between(-1.0, 1.0));
        for coupling in &mut forces.couplings {
            let law = [(); RightSideLayout::COUPLING].map(|()| numbers.between(-1.0, 1.0));
            *coupling = nboom_elements::CouplingLaw::of_numbers(law);
        }
        let all = forces.write();
        let count = RightSideLayout::parameters(&topology) - of_lines;
        parameters.extend(&all[all.len() - count..]);
        assumptions.iter().for_each(|&(i, value)| parameters[i] = value);
        let count = RightSideLayout::coordinates(&topology);
        let y = (0..count).map(|_| numbers.between(-2.0, 2.0)).collect();
        Self { topology, parameters, y }
    }

    fn expected(&self, formulation: &str) -> Vec<f64> {
        let Self { topology, parameters, y } = self;
        let formulation = Formulation::named(formulation).expect("a formulation's name");
        let (of_satellite, of_forces) = parameters.split_at(Layout::parameters(topology));
        let satellite = Parameters::read(topology, of_satellite.iter().copied());
        let forces = Forces::read(topology.hinges(), of_forces.iter().copied());
        right_side(formulation, topology, &satellite, &forces, y)
    }

    fn found(&self, kernel: &Kernel) -> Vec<f64> {
        let (mut constants, mut out) = (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
        assert!(kernel.accepts(&self.parameters), "{}", kernel.topology);
        kernel.prepare(&self.parameters, &mut constants);
        kernel.evaluate(&constants, &self.y, &mut out);
        out
    }
}

fn evaluated<T: Routine>(parameters: &[f64], y: &[f64]) -> Vec<f64> {
    let (mut constants, mut out) = (vec![0.0; T::CONSTANTS], vec![0.0; T::OUTPUTS]);
    T::prepare(parameters, &mut constants);
    T::evaluate(&constants, y, &mut out);
    out
}

/// Fused and regrouped rounding and other sines, on mass matrices of condition up to 1e3.
fn assert_near(found: &[f64], expected: &[f64], told: &str) {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(1.0_f64, |most, e| most.max(e.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12 * scale, "{told}: {found} {expected}");
    }
}

fn is_the_right_side<T: Routine>() {
    let mut numbers = Rng::new(1970);
    assert_eq!(T::RESULT, "right_side");
    for number in 0..100 {
        let case = Case::random(T::TOPOLOGY, T::ASSUMPTIONS, &mut numbers);
        let expected = case.expected(T::FORMULATION);
        let found = evaluated::<T>(&case.parameters, &case.y);
        assert_eq!(found, expected, "{} {} case {number}", T::FORMULATION, T::TOPOLOGY);
        for set in [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512] {
            let Some(kernel) = Kernel::with::<T>(set) else { continue };
            assert_near(
                &case.found(&kernel),
                &expected,
                &format!("{} {}", T::TOPOLOGY, set.name()),
            );
        }
    }
}

#[test]
fn exact_code_is_the_right_side_bit_for_bit() {
    for_each_exact_routine!(is_the_right_side);
}

/// Appendages and links that go through loops together.
#[test]
fn what_is_assumed_of_one_hinge_is_not_of_the_others() {
    is_the_right_side::<exact::RolledUnequal>();
    is_the_right_side::<exact::CoupledUnequal>();
}

fn never_reads_assumptions<T: Routine>() {
    let case = Case::random(T::TOPOLOGY, T::ASSUMPTIONS, &mut Rng::new(3));
    let expected = evaluated::<T>(&case.parameters, &case.y);
    assert!(expected.iter().all(|number| number.is_finite()));
    let mut parameters = case.parameters;
    T::ASSUMPTIONS.iter().for_each(|&(i, _)| parameters[i] = f64::NAN);
    assert_eq!(evaluated::<T>(&parameters, &case.y), expected, "{}", T::TOPOLOGY);
}

#[test]
fn what_a_routine_assumes_is_never_read() {
    for_each_exact_routine!(never_reads_assumptions);
    const { assert!(!exact::RolledMixed::EXTERNAL && exact::PushedS2P::EXTERNAL) };
}

fn each_lane_is_a_state<T: Routine>() {
    for set in [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512] {
        if let Some(batch) = Batch::with::<T>(set) {
            each_lane_of_a_batch_is_a_state(&batch);
        }
    }
}

fn each_lane_of_a_batch_is_a_state(batch: &Batch) {
    let mut numbers = Rng::new(8);
    let cases: [Case; 8] =
        std::array::from_fn(|_| Case::random(batch.topology, batch.assumptions, &mut numbers));
    let side_by_side = |of: fn(&Case) -> &[f64]| -> Vec<Eight> {
        let count = of(&cases[0]).len();
        (0..count).map(|i| Eight(std::array::from_fn(|lane| of(&cases[lane])[i]))).collect()
    };
    let (parameters, y) = (side_by_side(|case| &case.parameters), side_by_side(|case| &case.y));
    let mut constants = vec![Eight::default(); batch.constants];
    let mut out = vec![Eight::default(); batch.outputs];
    batch.prepare(&parameters, &mut constants);
    batch.evaluate(&constants, &y, &mut out);
    for (lane, case) in cases.iter().enumerate() {
        let found: Vec<f64> = out.iter().map(|numbers| numbers.0[lane]).collect();
        let told = format!("{}, {}, lane {lane}", batch.topology, batch.instructions);
        assert_near(&found, &case.expected(batch.formulation), &told);
    }
}

#[test]
fn each_of_eight_states_is_its_state_alone() {
    each_lane_is_a_state::<exact::PushedS2P>();
    each_lane_is_a_state::<exact::RolledMixed>();
    each_lane_is_a_state::<exact::CoupledRolled>();
}

#[test]
fn stock_right_sides_of_eight_states_are_those_of_one() {
    assert!(!nboom_routines::right_sides_of_eight().is_empty());
    for batch in nboom_routines::right_sides_of_eight() {
        let of_one = |kernel: &&Kernel| kernel.is_of_same_routine(batch);
        assert_eq!(nboom_routines::right_sides().iter().filter(of_one).count(), 1);
        each_lane_of_a_batch_is_a_state(batch);
    }
}

#[test]
fn stock_right_sides_agree_with_the_equations_in_this_processors_code() {
    let stock = nboom_routines::right_sides();
    let topologies: std::collections::BTreeSet<&str> = stock.iter().map(|k| k.topology).collect();
    let has_few_equal = |name: &&str| {
        let topology: Topology = name.parse().expect("a topology's name");
        topology.groups().all(|(_, count)| count <= 4)
    };
    let of_accelerations = nboom_routines::all().iter().map(|kernel| kernel.topology);
    let of_accelerations = of_accelerations.filter(has_few_equal).collect();
    assert_eq!(topologies, of_accelerations);
    for kernel in stock {
        let mut numbers = Rng::new(11);
        for _ in 0..20 {
            let case = Case::random(kernel.topology, kernel.assumptions, &mut numbers);
            let expected = case.expected(kernel.formulation);
            assert_near(&case.found(kernel), &expected, kernel.topology);
        }
    }
}

#[test]
fn a_link_that_no_line_pushes_is_not_divided_by() {
    for kernel in nboom_routines::right_sides() {
        let mut case = Case::random(kernel.topology, kernel.assumptions, &mut Rng::new(5));
        let hinges = case.topology.hinges();
        // Hinges at O: an end there would have no distance from the other one.
        for branch in 0..case.topology.shapes().len() {
            let before: usize = case.topology.shapes()[..branch].iter().map(|s| s.hinges()).sum();
            let start = Layout::MAIN + Layout::BRANCH * branch + Layout::LINK * before;
            case.parameters[start + 9..start + 12].fill(0.0);
        }
        let of_lines = RightSideLayout::external(&case.topology).end;
        let absent = Forces::none(hinges).write();
        case.parameters.truncate(of_lines);
        let count = RightSideLayout::parameters(&case.topology) - of_lines;
        case.parameters.extend(&absent[absent.len() - count..]);
        let expected = case.expected(kernel.formulation);
        assert!(expected.iter().all(|number| number.is_finite()));
        assert_near(&case.found(kernel), &expected, kernel.topology);
    }
}
