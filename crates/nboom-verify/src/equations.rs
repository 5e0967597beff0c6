//! Matrix and right side: code that computes them, and what they should be by recursion.

use nboom_formulation::{Coordinates, Equations, Formulation, Recognised, symmetric};
use nboom_model::{Shape, Topology, WeldedTree};
use nboom_scalar::{Kernel, Real};

use crate::VerifyError;
use crate::label::Label;
use crate::test_case::TestCase;

/// Code that computes the matrix and the right side of one formulation, hinges in the order of
/// [`TestCase::links`].
pub(crate) struct EquationsCode<'a> {
    pub label: Label,
    pub formulation: Formulation,
    way: Way<'a>,
}

enum Way<'a> {
    ClosedForm(&'a Recognised),
    /// The tree, and for each hinge of a state where it is in the tree.
    Tree(&'a WeldedTree<f64>, Vec<usize>),
    Routine {
        kernel: Kernel,
        recognised: &'a Recognised,
        constants: Vec<f64>,
    },
}

impl<'a> EquationsCode<'a> {
    /// All that covers the test case: closed forms, then those of `kernels` that take the scene. Of a main body that
    /// is held there are no equations to compare.
    pub fn all(test_case: &'a TestCase, kernels: &[Kernel]) -> Result<Vec<Self>, VerifyError> {
        if test_case.tree().held.is_some() {
            return Ok(Vec::new());
        }
        let generic = |formulation: Formulation, way| {
            let label = Label::generic(formulation.name());
            Self { label, formulation, way }
        };
        let Some(recognised) = test_case.recognised() else {
            let way = Way::Tree(test_case.tree(), test_case.links());
            return Ok(vec![generic(Formulation::Symmetric, way)]);
        };
        let size = 6 + recognised.topology.hinges();
        let mut routines = Vec::new();
        for fit in test_case.fitting(kernels, size * size + size)? {
            let kernel = fit.kernel;
            let named = Formulation::named(kernel.formulation);
            let formulation = named.filter(|formulation| formulation.has_equations());
            let Some(formulation) = formulation else {
                return Err(VerifyError::NoEquations { formulation: kernel.formulation });
            };
            let way = Way::Routine { kernel, recognised, constants: fit.constants() };
            routines.push(Self { label: Label::generated(&fit), formulation, way });
        }
        let has_equations = |formulation: &Formulation| {
            formulation.has_equations() && formulation.takes(&recognised.topology)
        };
        let closed = Formulation::ALL.into_iter().filter(has_equations);
        let closed = closed.map(|formulation| generic(formulation, Way::ClosedForm(recognised)));
        Ok(closed.chain(routines).collect())
    }

    /// Matrix and right side in a state.
    pub fn equations(&self, state: &Coordinates<f64>) -> Equations<f64> {
        match &self.way {
            Way::ClosedForm(Recognised { topology, parameters, .. }) => {
                let found = self.formulation.equations(topology, parameters, state);
                found.expect("the formulation has equations")
            }
            Way::Tree(tree, links) => of_tree(tree, links, state),
            Way::Routine { kernel, recognised, constants } => {
                let topology = &recognised.topology;
                let mut found = vec![0.0; kernel.outputs];
                kernel.evaluate(constants, &state.write(topology), &mut found);
                let forcing = found.split_off(found.len() - 6 - topology.hinges());
                Equations { matrix: found, forcing }
            }
        }
    }
}

/// Those of a tree, for a state whose hinges are these links of it.
fn of_tree(tree: &WeldedTree<f64>, links: &[usize], state: &Coordinates<f64>) -> Equations<f64> {
    let mut in_tree = state.clone();
    for (&link, hinge) in links.iter().zip(&state.hinges) {
        in_tree.hinges[link] = *hinge;
    }
    let matrix = symmetric::tree_mass_matrix(tree, &in_tree);
    let forcing = symmetric::tree_forcing(tree, &in_tree);
    let rows: Vec<usize> = (0..6).chain(links.iter().map(|link| 6 + link)).collect();
    let entry = |(&i, &j): (&usize, &usize)| matrix[i * rows.len() + j];
    Equations {
        matrix: rows.iter().flat_map(|i| rows.iter().map(move |j| (i, j))).map(entry).collect(),
        forcing: rows.iter().map(|&i| forcing[i]).collect(),
    }
}

/// What the recursion's matrix and right side, over (a_O, ω̇, τ̇) and hinges in the scene's order,
/// are for the formulation's unknowns when O is at the inertial origin.
pub(crate) fn expected<R: Real>(
    formulation: Formulation,
    test_case: &TestCase,
    of_recursion: &Equations<R>,
) -> Equations<R> {
    let order = order(test_case);
    let size = order.len();
    let entry = |(&i, &j): (&usize, &usize)| of_recursion.matrix[i * size + j];
    let pairs = order.iter().flat_map(|i| order.iter().map(move |j| (i, j)));
    let mut matrix: Vec<R> = pairs.map(entry).collect();
    if let (Formulation::Report, Some(recognised)) = (formulation, test_case.recognised()) {
        to_absolute_rates(&recognised.topology, &mut matrix);
    }
    Equations { matrix, forcing: order.iter().map(|&i| of_recursion.forcing[i]).collect() }
}

/// The rows of the recursion's matrix in the order of closed forms.
pub(crate) fn order(test_case: &TestCase) -> Vec<usize> {
    (0..6).chain(test_case.links().iter().map(|link| 6 + link)).collect()
}

/// The matrix over σ from that over τ = a⁻¹ σ, eq. (5.14): in a chain τᵢ is σᵢ less the σ
/// inboard of it.
fn to_absolute_rates<R: Real>(topology: &Topology, matrix: &mut [R]) {
    let size = 6 + topology.hinges();
    let mut first = 6;
    for shape in topology.shapes() {
        if matches!(shape, Shape::Chain(_)) {
            for row in matrix.chunks_exact_mut(size) {
                for j in first..first + shape.hinges() - 1 {
                    let outer = row[j + 1];
                    row[j] -= outer;
                }
            }
        }
        first += shape.hinges();
    }
}
