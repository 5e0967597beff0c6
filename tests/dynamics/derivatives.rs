//! Derivatives by the chain rule through inverse dynamics, against closed forms on dual numbers, which differentiate
//! each operation of the articulated bodies.

use nboom::formulation::{Coordinates, Formulation, Layout, Parameters, Recognised};
use nboom::scalar::{Derivatives, Dual};

use crate::limbs;
use crate::satellites::{Satellite, extreme, random};

/// Accelerations and their derivatives by coordinate `along`.
fn by_dual_numbers(recognised: &Recognised, state: &[f64], along: usize) -> Vec<Dual<f64>> {
    let Recognised { topology, parameters, .. } = recognised;
    let constants = parameters.write().into_iter().map(Dual::constant);
    let main_is_held = parameters.main_is_held;
    let parameters = Parameters { main_is_held, ..Parameters::read(topology, constants) };
    let mut duals: Vec<Dual<f64>> = state.iter().map(|&value| Dual::constant(value)).collect();
    duals[along].derivative = 1.0;
    let coordinates = Coordinates::read(topology, &duals);
    Formulation::Articulated.solve(topology, &parameters, &coordinates).write(topology)
}

fn all_of(
    recognised: &Recognised,
    state: &[f64],
    accelerations: &[f64],
    by: std::ops::Range<usize>,
) -> Vec<f64> {
    let Recognised { topology, parameters, .. } = recognised;
    let mut derivatives = Derivatives::of(&Layout::tree(topology), &parameters.write());
    let mut found = vec![0.0; accelerations.len() * by.len()];
    derivatives.write(state, accelerations, by, &mut found);
    found
}

/// Columns in which all cancels are rounding of terms as large as those of other columns by numbers of the same kind, and as
/// the rates, which are about 1.
const CANCELLED: f64 = 1e-14;

/// Columns by numbers of one kind, and the size of derivatives by these which rates of 1 stand for: ω, moment, force, angles,
/// rates, torques.
fn kinds(recognised: &Recognised) -> Vec<(Vec<usize>, f64)> {
    let topology = &recognised.topology;
    let places = Layout::places(topology).into_iter();
    let hinges: Vec<_> = places.map(|place| Layout::hinge_in_state(topology, place)).collect();
    let of_hinges = |row: usize| hinges.iter().map(|at| at[row]).collect();
    vec![
        ((0..3).collect(), 1.0),
        ((3..6).collect(), 0.0),
        ((6..9).collect(), 0.0),
        (of_hinges(0), 1.0),
        (of_hinges(1), 1.0),
        (of_hinges(2), 0.0),
    ]
}

fn assert_derivatives(satellite: &Satellite, label: &str) {
    let recognised = satellite.recognised();
    let topology = &recognised.topology;
    let state = satellite.coordinates_of(&recognised).write(topology);
    let values = by_dual_numbers(&recognised, &state, 0);
    let accelerations: Vec<f64> = values.iter().map(|dual| dual.value).collect();
    let all = all_of(&recognised, &state, &accelerations, 0..state.len());
    for (kind, size) in kinds(&recognised) {
        let columns: Vec<Vec<f64>> = kind
            .iter()
            .map(|&column| {
                let duals = by_dual_numbers(&recognised, &state, column);
                duals.iter().map(|dual| dual.derivative).collect()
            })
            .collect();
        let largest = |column: &[f64]| column.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let of_kind = CANCELLED * largest(&columns.concat()).max(size);
        for (column, expected) in kind.into_iter().zip(columns) {
            let allowed = satellite.allowed() * largest(&expected) + of_kind;
            for (row, expected) in expected.iter().enumerate() {
                let off = (all[row * state.len() + column] - expected).abs();
                assert!(
                    off <= allowed,
                    "{label}, {topology}, row {row} by {column}: {off:e}, {allowed:e} allowed"
                );
            }
        }
    }
}

#[test]
fn derivatives_of_chains_and_paddles_are_those_of_dual_numbers() {
    for seed in 0..2000 {
        assert_derivatives(&Satellite::of_moment(&random(seed)), &format!("seed {seed}"));
    }
}

#[test]
fn derivatives_of_extreme_masses_are_those_of_dual_numbers() {
    for seed in 0..500 {
        assert_derivatives(&Satellite::of_moment(&extreme(seed)), &format!("seed {seed}"));
    }
}

#[test]
fn derivatives_of_trees_are_those_of_dual_numbers() {
    for seed in 0..2000 {
        assert_derivatives(&limbs::satellite(seed), &format!("seed {seed}"));
    }
}

#[test]
fn derivatives_of_trees_on_rigs_are_those_of_dual_numbers() {
    for seed in 0..1000 {
        assert_derivatives(&limbs::satellite_on_a_rig(seed), &format!("seed {seed}"));
    }
}

#[test]
fn any_coordinates_are_asked_for() {
    let satellite = limbs::satellite(5);
    let recognised = satellite.recognised();
    let state = satellite.coordinates_of(&recognised).write(&recognised.topology);
    let accelerations = vec![0.25; Layout::outputs(&recognised.topology)];
    let count = state.len();
    let all = all_of(&recognised, &state, &accelerations, 0..count);
    assert!(count > 20);
    for by in [0..0, 2..3, 0..9, 9..count, 7..18, count - 1..count] {
        let found = all_of(&recognised, &state, &accelerations, by.clone());
        let rows = all.chunks_exact(count).flat_map(|row| row[by.clone()].to_vec());
        assert_eq!(found, rows.collect::<Vec<_>>());
    }
}
