//! Eight states at once: every lane is the state alone, in every instruction set of this
//! processor, and nothing goes from one lane to another.

use nboom_model::Topology;
use nboom_routines::for_each_batched;
use nboom_scalar::{Batch, Eight, InstructionSet, Kernel, Routine};

use support::{Rng, parameters, state};

mod support;

/// Eight satellites of one topology, each in a state of its own.
struct Satellites {
    parameters: Vec<Vec<f64>>,
    states: Vec<Vec<f64>>,
}

impl Satellites {
    fn of(batch: &Batch) -> Self {
        let topology: Topology = batch.topology.parse().expect("a topology");
        let mut numbers = Rng::new(8);
        let mut eight =
            |make: &dyn Fn(&mut Rng) -> Vec<f64>| (0..8).map(|_| make(&mut numbers)).collect();
        Self {
            parameters: eight(&|numbers| parameters(&topology, batch.assumptions, numbers)),
            states: eight(&|numbers| state(&topology, batch.external, numbers)),
        }
    }

    /// Accelerations of all eight at once; for each, as they are for one.
    fn together(&self, batch: &Batch) -> Vec<Vec<f64>> {
        let parameters = side_by_side(&self.parameters);
        assert!(batch.accepts(&parameters));
        let mut constants = vec![Eight::default(); batch.constants];
        let mut out = vec![Eight::default(); batch.outputs];
        batch.prepare(&parameters, &mut constants);
        batch.evaluate(&constants, &side_by_side(&self.states), &mut out);
        (0..8).map(|lane| out.iter().map(|numbers| numbers.0[lane]).collect()).collect()
    }

    fn alone(&self, kernel: &Kernel, lane: usize) -> Vec<f64> {
        let (mut constants, mut out) = (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
        kernel.prepare(&self.parameters[lane], &mut constants);
        kernel.evaluate(&constants, &self.states[lane], &mut out);
        out
    }
}

fn side_by_side(all: &[Vec<f64>]) -> Vec<Eight> {
    (0..all[0].len()).map(|i| Eight(std::array::from_fn(|lane| all[lane][i]))).collect()
}

/// Largest difference in terms of the largest magnitude, at least 1.
fn apart(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(1.0_f64, |most, e| most.max(e.abs()));
    let all = found.iter().zip(expected).map(|(f, e)| (f - e).abs() / scale);
    all.fold(0.0, |most, off| if off > most || off.is_nan() { off } else { most })
}

fn lanes_are_states<T: Routine>() {
    let single = Kernel::of::<T>();
    for set in [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512] {
        let Some(batch) = Batch::with::<T>(set) else { continue };
        assert_eq!(batch.instructions, set.name());
        let satellites = Satellites::of(&batch);
        for (lane, found) in satellites.together(&batch).iter().enumerate() {
            // Sines, products and sums round in other ways, on mass matrices of condition up
            // to 1e3.
            let off = apart(found, &satellites.alone(&single, lane));
            assert!(off < 1e-12, "{}, {}, lane {lane}: {off:e}", T::TOPOLOGY, set.name());
        }
    }
}

#[test]
fn each_lane_is_its_state_alone() {
    for_each_batched!(lanes_are_states);
}

#[test]
fn one_state_in_code_of_every_instruction_set_is_the_same() {
    fn agree<T: Routine>() {
        let satellites = Satellites::of(&Batch::of::<T>());
        let portable = Kernel::with::<T>(InstructionSet::Portable).expect("runs anywhere");
        for set in [InstructionSet::Avx2, InstructionSet::Avx512] {
            let Some(kernel) = Kernel::with::<T>(set) else { continue };
            let off = apart(&satellites.alone(&kernel, 3), &satellites.alone(&portable, 3));
            assert!(off < 1e-12, "{}, {}: {off:e}", T::TOPOLOGY, set.name());
        }
    }
    for_each_batched!(agree);
}

#[test]
fn what_is_not_a_number_stays_in_its_lane() {
    for batch in nboom_routines::batches() {
        let mut satellites = Satellites::of(batch);
        let healthy = satellites.together(batch);
        satellites.states[5].fill(f64::NAN);
        satellites.states[2].fill(f64::INFINITY);
        let found = satellites.together(batch);
        for lane in 0..8 {
            if lane == 2 || lane == 5 {
                assert!(found[lane].iter().all(|number| !number.is_finite()));
            } else {
                assert_eq!(found[lane], healthy[lane], "{}, lane {lane}", batch.topology);
            }
        }
    }
}

#[test]
fn one_state_that_breaks_an_assumption_is_not_accepted() {
    for batch in nboom_routines::batches() {
        let mut parameters = side_by_side(&Satellites::of(batch).parameters);
        assert!(batch.accepts(&parameters));
        parameters[batch.assumptions[0].0].0[7] += 1e-12;
        assert!(!batch.accepts(&parameters));
        assert!(!batch.accepts(&parameters[1..]));
    }
}

#[test]
fn one_state_with_parameters_that_are_no_numbers_is_not_accepted() {
    for batch in nboom_routines::batches() {
        let good = side_by_side(&Satellites::of(batch).parameters);
        for at in 0..good.len() {
            for bad in [f64::NAN, f64::INFINITY] {
                let mut parameters = good.clone();
                parameters[at].0[6] = bad;
                assert!(!batch.accepts(&parameters), "{} {at}: {bad}", batch.topology);
            }
        }
    }
}
