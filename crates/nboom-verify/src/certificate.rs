use nboom_formulation::{Equations, Formulation};
use serde::Serialize;

use crate::VerifyError;
use crate::floor::Floor;
use crate::reference::Referee;
use crate::test_case::TestCase;

/// How far the accelerations of one code are from the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Certificate {
    /// How many states were compared.
    pub states: usize,
    /// What they were drawn from.
    pub seed: u64,
    /// Largest deviation from the recursion in `f64`, as of
    /// [`Quantity::Accelerations`](crate::Quantity::Accelerations).
    pub from_recursion: f64,
    /// Largest deviation from the recursion in double-double, rounded to `f64`.
    pub from_double_double: f64,
    /// The largest deviation that counts in any state: the larger one of both, or that from double-double alone
    /// where the recursion in `f64` is farther from it.
    #[serde(skip)]
    pub worst: f64,
    /// The most that rounding is magnified in accelerations, as [`Quantity`](crate::Quantity) has it.
    pub magnification: f64,
}

/// Compares code with both recursions. `accelerations` gives ω̇, a_O, then τ̇ in the order of the
/// scene's hinges, in state `i` of the test case, counted from 0.
///
/// Results that are too few or too many, or no numbers, deviate infinitely.
///
/// # Errors
/// [`VerifyError::NoReference`] where the recursion has no accelerations in a state.
pub fn certify(
    test_case: &TestCase,
    mut accelerations: impl FnMut(usize) -> Vec<f64>,
) -> Result<Certificate, VerifyError> {
    let (states, seed) = (test_case.states().len(), test_case.seed());
    let (from_recursion, from_double_double, worst) = (0.0, 0.0, 0.0);
    let nothing =
        Certificate { states, seed, from_recursion, from_double_double, worst, magnification: 1.0 };
    let mut referee = Referee::new(test_case, 1);
    (0..states).try_fold(nothing, |most, i| {
        let reference = referee.reference(i)?;
        let off = reference.off_accelerations(&accelerations(i));
        Ok(Certificate {
            from_recursion: most.from_recursion.max(off.from_recursion),
            from_double_double: most.from_double_double.max(off.from_double_double),
            worst: most.worst.max(off.worst()),
            magnification: most.magnification.max(reference.magnification),
            ..most
        })
    })
}

/// The largest deviation of matrix and right side by `formulation` from those that follow from the recursion's in
/// double-double, as of [`Quantity::MassMatrix`](crate::Quantity::MassMatrix) and
/// [`Quantity::Forcing`](crate::Quantity::Forcing). `equations` gives the matrix row by row and then the right side, in
/// state `i` of the test case, counted from 0.
///
/// Results that are too few or too many, or no numbers, deviate infinitely.
///
/// # Errors
/// As [`certify`].
pub fn certify_equations(
    test_case: &TestCase,
    formulation: Formulation,
    mut equations: impl FnMut(usize) -> Vec<f64>,
) -> Result<f64, VerifyError> {
    let size = 6 + test_case.tree().links.len();
    let mut referee = Referee::new(test_case, 1);
    (0..test_case.states().len()).try_fold(0.0_f64, |most, i| {
        let reference = referee.reference(i)?;
        let mut matrix = equations(i);
        if matrix.len() != size * size + size {
            return Ok(f64::INFINITY);
        }
        let forcing = matrix.split_off(size * size);
        let off = reference.off_equations(formulation, &Equations { matrix, forcing });
        Ok(off.iter().fold(most, |most, off| most.max(off.from_double_double)))
    })
}

/// What is true in a state.
#[derive(Clone, Debug)]
pub struct Truth {
    /// Accelerations, computed in double-double and rounded once: ω̇, a_O, then τ̇ in the order of the scene's
    /// hinges.
    pub accelerations: Vec<f64>,
    /// Power of the parts of the hinge torques that depend on rates.
    pub rate_power: f64,
    /// How much rounding is magnified in the accelerations, as [`Quantity`](crate::Quantity) has it.
    pub magnification: f64,
    /// What deviations are relative to where these, or forces, cancel to nothing.
    pub floor: Floor,
}

/// The truth in each state.
///
/// # Errors
/// [`VerifyError::NoReference`] where a state has no accelerations.
pub fn truth(test_case: &TestCase) -> Result<Vec<Truth>, VerifyError> {
    let mut referee = Referee::new(test_case, 1);
    let mut of_state = |i| {
        let reference = referee.reference(i)?;
        let (accelerations, rate_power) = (reference.truth(), reference.rate_power());
        let (magnification, floor) = (reference.magnification, reference.floor);
        Ok(Truth { accelerations, rate_power, magnification, floor })
    };
    (0..test_case.states().len()).map(&mut of_state).collect()
}

/// What has to act in each state for these accelerations, computed in double-double by the recursion's mass
/// matrix and rounded once: moment and force on the main body about O, then the torques of the scene's hinges.
/// Accelerations are in the order of [`truth`].
///
/// # Errors
/// As [`truth`].
pub fn drives(
    test_case: &TestCase,
    accelerations: &[Vec<f64>],
) -> Result<Vec<Vec<f64>>, VerifyError> {
    let mut referee = Referee::new(test_case, 1);
    let all = accelerations.iter().enumerate();
    all.map(|(i, accelerations)| Ok(referee.reference(i)?.drive(accelerations))).collect()
}
