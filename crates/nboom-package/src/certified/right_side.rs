//! Right sides against the truth.

use nboom_formulation::{Coordinates, Forces, Layout, Recognised, RightSideLayout};
use nboom_scalar::{Quaternion, Vec3};
use nboom_verify::{TestCase, Truth, allowance, of_largest};

use super::{Tested, above_zero, recognised};
use crate::PackageError;
use crate::right_side::forces;

/// All states of a test case, each at another attitude, with their rates of change.
///
/// # Errors
/// What a right side has no place for.
pub(super) fn tested(test_case: &TestCase, truth: &[Truth]) -> Result<Vec<Tested>, PackageError> {
    let (recognised, forces) = (recognised(test_case), forces(test_case)?);
    let parameters = [recognised.parameters.write(), forces.write()].concat();
    let states = test_case.coordinates().zip(truth).enumerate();
    let case = |(i, (state, truth)): (usize, (Coordinates<f64>, &Truth))| {
        let attitude = attitude(i);
        let of_hinges =
            |of: usize| state.hinges.iter().map(move |hinge| [hinge.beta, hinge.tau][of]);
        let omega = state.omega.to_array();
        let coordinates = numbers(attitude).into_iter().chain(omega);
        Tested {
            parameters: parameters.clone(),
            coordinates: coordinates.chain(of_hinges(0)).chain(of_hinges(1)).collect(),
            expected: expected(
                recognised,
                &forces,
                attitude.rate(state.omega),
                of_hinges(1),
                truth,
            ),
            least: above_zero(truth.floor.accelerations),
            magnification: truth.magnification,
        }
    };
    Ok(states.map(case).collect())
}

/// Some attitude; its norm does not matter.
fn attitude(state: usize) -> Quaternion<f64> {
    let number = |i: usize| (1.7 * i as f64 + 0.9 * state as f64 + 0.3).sin();
    Quaternion { scalar: number(0), vector: Vec3::new(number(1), number(2), number(3)) }
}

fn numbers(quaternion: Quaternion<f64>) -> [f64; 4] {
    let [x, y, z] = quaternion.vector.to_array();
    [quaternion.scalar, x, y, z]
}

/// Rates of change and power, and what the power is relative to: the magnitudes of what is added up.
fn expected(
    recognised: &Recognised,
    forces: &Forces<f64>,
    rate: Quaternion<f64>,
    tau: impl Iterator<Item = f64> + Clone,
    truth: &Truth,
) -> Vec<f64> {
    let Truth { accelerations, rate_power, .. } = truth;
    let mut all = [&numbers(rate), &accelerations[..3]].concat();
    all.extend(tau.clone());
    all.extend(recognised.links.iter().map(|link| accelerations[Layout::OUTPUT + link]));
    let powers = forces.laws.iter().zip(tau.clone()).map(|(law, tau)| {
        let [linear, quadratic] = [law.numbers()[1], law.numbers()[0] * tau];
        (linear.abs() + quadratic.abs()) * tau * tau
    });
    let tau: Vec<f64> = tau.collect();
    let couplings = forces.couplings.iter().zip(recognised.topology.inboard_hinges());
    let of_couplings = couplings.zip(&tau).filter_map(|((law, inboard), own)| {
        let [own_weight, inboard_weight, .., damping] = law.numbers();
        let rate = (own_weight * own).abs() + (inboard_weight * tau[inboard?]).abs();
        Some(damping.abs() * rate * rate)
    });
    all.extend([*rate_power, powers.sum::<f64>() + of_couplings.sum::<f64>()]);
    all
}

/// The largest deviation, each relative to the largest number of its kind: rates of the attitude, accelerations in terms of
/// magnified rounding, rates of the hinges, power.
pub(super) fn deviation(found: &[f64], tested: &Tested) -> f64 {
    let Tested { least, magnification, .. } = *tested;
    let (expected, scale) = tested.expected.split_at(tested.expected.len() - 1);
    let hinges = (found.len() - RightSideLayout::STATE) / 2;
    let [beta, tau] = [0, hinges].map(|at| RightSideLayout::STATE + at);
    let power = tau + hinges;
    let off = |places: Vec<usize>, least: f64| {
        let of = |numbers: &[f64]| -> Vec<f64> { places.iter().map(|&at| numbers[at]).collect() };
        of_largest(&of(found), &of(expected), least)
    };
    let tiny = f64::MIN_POSITIVE;
    let accelerations = off(RightSideLayout::OMEGA.chain(tau..power).collect(), least);
    off(RightSideLayout::ATTITUDE.collect(), tiny)
        .max(accelerations / allowance(magnification))
        .max(off((beta..tau).collect(), tiny))
        .max(off(vec![power], scale[0].max(tiny)))
}
