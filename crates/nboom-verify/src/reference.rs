//! What code is compared with: the recursion in `f64` and in double-double.

use nboom_dynamics::{Accelerations, Motion, Recursive, Singularity};
use nboom_formulation::{Equations, Formulation};
use nboom_scalar::{DoubleDouble, Real, Vec3, Wrench};

use crate::VerifyError;
use crate::condition::{Scaled, sizes};
use crate::equations::{expected, order};
use crate::floor::{Floor, Natural};
use crate::random_state::RandomState;
use crate::test_case::TestCase;

/// Deviations count in full where rounding is magnified less than this. Beyond it they are divided by how much more it is.
const HARMLESS_MAGNIFICATION: f64 = 1e4;

/// Beyond this condition f64 holds no accelerations to compare.
const LARGEST_CONDITION: f64 = 1e14;

/// Deviations of one code in one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Deviation {
    pub from_recursion: f64,
    pub from_double_double: f64,
    /// That of the recursion in `f64` from the one in double-double.
    pub of_recursion: f64,
}

impl Deviation {
    /// The larger one of both, or that from double-double alone where the recursion is farther from it: rounding
    /// of the recursion is no fault of the code.
    pub fn worst(self) -> f64 {
        let Self { from_recursion, from_double_double, of_recursion } = self;
        if of_recursion > from_double_double {
            from_double_double
        } else {
            from_double_double.max(from_recursion)
        }
    }
}

/// Both recursions of a test case.
pub(crate) struct Referee<'a> {
    test_case: &'a TestCase,
    /// The number of its first state.
    first: usize,
    recursion: Recursive<f64>,
    exact: Recursive<DoubleDouble>,
}

impl<'a> Referee<'a> {
    pub fn new(test_case: &'a TestCase, first: usize) -> Self {
        Self { test_case, first, recursion: test_case.recursive(), exact: test_case.recursive() }
    }

    /// Both recursions in state `i`.
    ///
    /// # Errors
    /// [`VerifyError::NoReference`] where they have no accelerations.
    pub fn reference(&mut self, i: usize) -> Result<Reference<'a>, VerifyError> {
        let state = &self.test_case.states()[i];
        let singularity = self.recursion.singularity(&state.beta);
        let recursion = OneState::of(&mut self.recursion, state);
        let exact = OneState::of(&mut self.exact, state);
        let tree = self.test_case.tree();
        let matrix = &recursion.equations.matrix;
        let sizes = sizes(matrix, self.recursion.moved_inertias());
        let scaled = Scaled::new(matrix, &sizes, tree.held.is_some());
        let natural = Natural::new(tree, state, matrix);
        let (floor, condition) = (Floor::of(&natural), scaled.condition());
        let reference = Reference {
            test_case: self.test_case,
            magnification: magnified(&recursion, &natural, &floor, &scaled),
            recursion,
            exact,
            sizes,
            floor,
            condition,
        };
        if singularity.is_some() || !reference.is_good() {
            let hinge = singularity
                .and_then(Singularity::hinge)
                .map(|hinge| self.test_case.scene().label(hinge));
            return Err(VerifyError::NoReference { state: self.first + i, hinge });
        }
        Ok(reference)
    }
}

/// How much rounding is magnified in the accelerations of a state.
fn magnified(state: &OneState<f64>, natural: &Natural, floor: &Floor, scaled: &Scaled<'_>) -> f64 {
    let found = &state.accelerations;
    let in_rows = [&found[3..6], &found[..3], &found[6..]].concat();
    let scale = scale_of(found, floor.accelerations);
    scaled.magnification(&in_rows, &natural.right_sides, scale)
}

/// What the recursion says about one state, hinges in the scene's order.
#[derive(Clone, Debug)]
struct OneState<R> {
    accelerations: Vec<R>,
    equations: Equations<R>,
    /// What acts, in the order of the equations: force, moment, hinge torques.
    acting: Vec<R>,
    /// Power of the parts of the hinge torques that depend on rates.
    rate_power: R,
}

impl<R: Real> OneState<R> {
    fn of(dynamics: &mut Recursive<R>, state: &RandomState) -> Self {
        let on_scalar = |numbers: &[f64]| numbers.iter().map(|&x| R::constant(x)).collect();
        let (beta, tau): (Vec<R>, Vec<R>) = (on_scalar(&state.beta), on_scalar(&state.tau));
        let omega_body = Vec3::constant(state.omega);
        let motion = Motion { omega_body, beta: &beta, tau: &tau };
        let size = 6 + beta.len();
        let mut equations =
            Equations { matrix: vec![R::zero(); size * size], forcing: vec![R::zero(); size] };
        dynamics.equations(&motion, &mut equations.matrix, &mut equations.forcing);
        let Wrench { moment, force } = dynamics.acting_on_main_body(omega_body);
        let mut acting = [force.to_array(), moment.to_array()].concat();
        acting.resize(size, R::zero());
        dynamics.hinge_forces(&motion, &mut acting[6..]);
        let elements = dynamics.elements();
        let rate_power = elements.rate_power(dynamics.free_hinges(), [&beta, &tau]);
        Self { accelerations: accelerations(dynamics, &motion), equations, acting, rate_power }
    }
}

/// ω̇, a_O, then τ̇ in the scene's order.
fn accelerations<R: Real>(dynamics: &mut Recursive<R>, motion: &Motion<'_, R>) -> Vec<R> {
    let mut found = Accelerations::for_hinges(motion.beta.len());
    dynamics.accelerations(motion, &mut found);
    let Accelerations { omega_dot_body, origin_body, tau_dot } = found;
    [&omega_dot_body.to_array()[..], &origin_body.to_array(), &tau_dot].concat()
}

/// What one state is compared with.
pub(crate) struct Reference<'a> {
    test_case: &'a TestCase,
    recursion: OneState<f64>,
    exact: OneState<DoubleDouble>,
    /// The root of the inertia that each row of the mass matrix moves.
    sizes: Vec<f64>,
    pub floor: Floor,
    /// Of the mass matrix of what moves freely, as [`Quantity`](crate::Quantity) scales it.
    pub condition: f64,
    /// How much rounding is magnified in the accelerations, as [`Quantity`](crate::Quantity) has it.
    pub magnification: f64,
}

impl Reference<'_> {
    /// Whether there is something to compare with.
    fn is_good(&self) -> bool {
        let mut numbers = self.recursion.accelerations.iter().copied().chain(self.truth());
        self.condition < LARGEST_CONDITION && numbers.all(f64::is_finite)
    }

    /// The accelerations in double-double, rounded once.
    pub fn truth(&self) -> Vec<f64> {
        rounded(&self.exact.accelerations)
    }

    /// Power of the parts of the hinge torques that depend on rates, in double-double, rounded once.
    pub fn rate_power(&self) -> f64 {
        self.exact.rate_power.to_f64()
    }

    /// What has to act for these accelerations, in double-double, rounded once: moment, force, hinge torques;
    /// accelerations are ω̇, a_O, then τ̇ in the scene's order.
    pub fn drive(&self, accelerations: &[f64]) -> Vec<f64> {
        let OneState { equations: Equations { matrix, forcing }, acting, .. } = &self.exact;
        let unknowns = [&accelerations[3..6], &accelerations[..3], &accelerations[6..]].concat();
        let row = |(i, row): (usize, &[DoubleDouble])| {
            let start = acting[i] - forcing[i];
            let terms = row.iter().zip(&unknowns).map(|(&m, &a)| m * DoubleDouble::from(a));
            terms.fold(start, |sum, term| sum + term)
        };
        let rows = matrix.chunks_exact(unknowns.len()).enumerate();
        let drive = rounded(&rows.map(row).collect::<Vec<_>>());
        [&drive[3..6], &drive[..3], &drive[6..]].concat()
    }

    /// Deviations of accelerations.
    pub fn off_accelerations(&self, found: &[f64]) -> Deviation {
        let (allowance, floor) = (allowance(self.magnification), self.floor.accelerations);
        let (recursion, truth) = (&self.recursion.accelerations, self.truth());
        Deviation {
            from_recursion: of_largest(found, recursion, floor) / allowance,
            from_double_double: of_largest(found, &truth, floor) / allowance,
            of_recursion: of_largest(recursion, &truth, floor) / allowance,
        }
    }

    /// Deviations of a formulation's matrix and right side.
    pub fn off_equations(
        &self,
        formulation: Formulation,
        found: &Equations<f64>,
    ) -> [Deviation; 2] {
        let recursion = expected(formulation, self.test_case, &self.recursion.equations);
        let exact = expected(formulation, self.test_case, &self.exact.equations);
        let (scale, matrix) = (self.scale(), &found.matrix);
        let truth = rounded(&exact.matrix);
        let of_matrix = Deviation {
            from_recursion: largest(matrix, &recursion.matrix, |at| scale[at]),
            from_double_double: largest(matrix, &truth, |at| scale[at]),
            of_recursion: largest(&recursion.matrix, &truth, |at| scale[at]),
        };
        let (forcing, floor) = (&found.forcing, self.floor.forcing);
        let truth = rounded(&exact.forcing);
        let of_forcing = Deviation {
            from_recursion: of_largest(forcing, &recursion.forcing, floor),
            from_double_double: of_largest(forcing, &truth, floor),
            of_recursion: of_largest(&recursion.forcing, &truth, floor),
        };
        [of_matrix, of_forcing]
    }

    /// Deviations of the recursion's own matrix and right side.
    pub fn off_recursion(&self) -> [Deviation; 2] {
        let own = expected(Formulation::Symmetric, self.test_case, &self.recursion.equations);
        self.off_equations(Formulation::Symmetric, &own)
    }

    /// What rounding in each entry of the matrix of kinetic energy is relative to, in the order of closed forms; above
    /// zero, also where a main body that is held has no mass.
    fn scale(&self) -> Vec<f64> {
        let size = |&i: &usize| self.sizes[i].max(f64::MIN_POSITIVE.sqrt());
        let sizes: Vec<f64> = order(self.test_case).iter().map(size).collect();
        sizes.iter().flat_map(|of_row| sizes.iter().map(move |size| of_row * size)).collect()
    }
}

/// How many times as large deviations of accelerations may be where rounding is magnified so much; at least 1, and no more
/// than at the largest condition.
pub fn allowance(magnification: f64) -> f64 {
    (magnification.min(LARGEST_CONDITION) / HARMLESS_MAGNIFICATION).max(1.0)
}

fn rounded(numbers: &[DoubleDouble]) -> Vec<f64> {
    numbers.iter().map(|number| number.to_f64()).collect()
}

/// The largest deviation, relative to the largest number expected, or to `floor` if that is larger; infinite where
/// something found is no number or where there are not as many as expected.
pub fn of_largest(found: &[f64], expected: &[f64], floor: f64) -> f64 {
    let scale = scale_of(expected, floor);
    largest(found, expected, |_| scale)
}

/// The largest number, or `floor` if that is larger; above zero.
fn scale_of(numbers: &[f64], floor: f64) -> f64 {
    numbers.iter().fold(floor.max(f64::MIN_POSITIVE), |most, number| most.max(number.abs()))
}

/// The largest deviation, each in terms of its scale; infinite where something found is no number
/// or where there are not as many as expected.
fn largest(found: &[f64], expected: &[f64], scale: impl Fn(usize) -> f64) -> f64 {
    if found.len() != expected.len() {
        return f64::INFINITY;
    }
    let pairs = found.iter().zip(expected).enumerate();
    let off = pairs.map(|(at, (found, expected))| (found - expected).abs() / scale(at));
    off.fold(0.0, |worst, off| if off.is_nan() { f64::INFINITY } else { worst.max(off) })
}

#[cfg(test)]
mod tests {
    use nboom_model::{Appendage, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment};
    use nboom_scalar::Sym3;

    use super::*;

    #[test]
    fn deviations_are_relative() {
        assert_eq!(of_largest(&[1.0, -4.0], &[1.0, -4.0], 0.0), 0.0);
        assert_eq!(of_largest(&[1.0, -3.0], &[1.0, -4.0], 0.0), 0.25);
        assert_eq!(largest(&[1.0, -3.0], &[0.5, -3.5], |at| [1.0, 2.0][at]), 0.5);
        assert_eq!(of_largest(&[0.0], &[0.0], 0.0), 0.0);
    }

    #[test]
    fn rounding_of_the_recursion_is_no_fault_of_the_code() {
        let off = |from_recursion, from_double_double, of_recursion| {
            Deviation { from_recursion, from_double_double, of_recursion }.worst()
        };
        assert_eq!(off(1.1e-11, 6e-16, 1.1e-11), 6e-16);
        assert_eq!(off(1e-9, 1e-9, 1e-16), 1e-9);
        assert_eq!(off(2e-9, 1e-9, 1e-10), 2e-9);
    }

    #[test]
    fn a_floor_matters_below_itself_alone() {
        assert_eq!(of_largest(&[1.0, -3.0], &[1.0, -4.0], 3.9), 0.25);
        assert_eq!(of_largest(&[0.5], &[0.0], 2.0), 0.25);
    }

    /// A free body without offset, and a boom of so many segments on it.
    fn free_body(inertia: [f64; 3], segments: usize) -> TestCase {
        let [x, y, z] = inertia;
        let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(x, y, z));
        let mut description = SceneDescription::at_rest("free body", body, 1.0);
        let rod = MassProperties::new(1.0, Vec3::unit_y(), Sym3::diagonal(1.4, 0.1, 1.4));
        let segment = Segment { length: 2.0, mass_properties: rod, hinge: Hinge::free() };
        if segments > 0 {
            let (mount, segments) = (Mount::at(Vec3::unit_y()), vec![segment; segments]);
            description.attach(&Appendage::Regular { mount, segments });
        }
        let scene = Scene::new(description).expect("the bodies are physical");
        TestCase::new(scene, 100, 1970).expect("finite")
    }

    #[test]
    fn a_wrong_forcing_of_a_sphere_is_found() {
        let test_case = free_body([0.1; 3], 0);
        let mut referee = Referee::new(&test_case, 1);
        for (i, RandomState { omega, .. }) in test_case.states().iter().enumerate() {
            let reference = referee.reference(i).expect("accelerations");
            let mut found = reference.recursion.equations.clone();
            let [_, right] = reference.off_equations(Formulation::Symmetric, &found);
            assert!(right.worst() < 1e-12, "{right:?}");
            found.forcing[4] += 1e-9 * 0.1 * omega.dot(*omega);
            let [_, wrong] = reference.off_equations(Formulation::Symmetric, &found);
            assert!(wrong.from_recursion.min(wrong.from_double_double) > 1e-9, "{wrong:?}");
        }
    }

    #[test]
    fn what_does_not_cancel_keeps_its_scale() {
        let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for segments in [0, 3, 40] {
            let test_case = free_body([40.0, 30.0, 20.0], segments);
            let mut referee = Referee::new(&test_case, 1);
            for i in 0..test_case.states().len() {
                let Reference { recursion, floor, .. } = referee.reference(i).expect("one");
                assert!(floor.accelerations < largest(&recursion.accelerations));
                assert!(floor.forcing < largest(&recursion.equations.forcing));
            }
        }
    }

    #[test]
    fn magnified_rounding_is_allowed() {
        assert_eq!([10.0, 1e5, 1e30].map(allowance), [1.0, 10.0, 1e10]);
    }

    #[test]
    fn what_cannot_be_compared_deviates_infinitely() {
        assert!(of_largest(&[f64::NAN, -4.0], &[1.0, -4.0], 0.0).is_infinite());
        assert!(of_largest(&[-4.0, f64::NAN], &[-5.0, 1.0], 0.0).is_infinite());
        assert!(of_largest(&[1.0], &[1.0, -4.0], 0.0).is_infinite());
    }
}
