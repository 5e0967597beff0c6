use nboom_dynamics::{Accelerations, Recursive};
use nboom_formulation::{Coordinates, Formulation, Layout, Recognised, symmetric};
use nboom_model::WeldedTree;
use nboom_scalar::{Twist, Vec3};
use nboom_sim::Fit;

use crate::dense::Dense;
use crate::random_state::RandomState;

/// Code that computes accelerations, with the states of a test case as it takes them.
///
/// The variants' fields are public for callers that time the code.
#[derive(Clone, Debug)]
pub enum ComparedCode<'a> {
    /// The recursion, hinge forces included.
    Recursion {
        /// The recursion in the test case's mode.
        dynamics: Box<Recursive<f64>>,
        /// The states.
        states: &'a [RandomState],
        /// Where accelerations go.
        found: Accelerations<f64>,
    },
    /// The whole mass matrix, factored; hinge forces included.
    Dense {
        /// The matrix in the test case's mode.
        dense: Box<Dense>,
        /// The states.
        states: &'a [RandomState],
    },
    /// A closed form that takes the topology.
    ClosedForm {
        /// Which one.
        formulation: Formulation,
        /// Topology and parameters.
        recognised: &'a Recognised,
        /// The states.
        states: Vec<Coordinates<f64>>,
    },
    /// `symmetric` for a tree that is not made of chains, paddles and limbs.
    Tree {
        /// The tree.
        tree: &'a WeldedTree<f64>,
        /// The states, hinges in the tree's order.
        states: Vec<Coordinates<f64>>,
    },
    /// A generated routine.
    Routine {
        /// The routine, and how the test case is embedded in its topology.
        fit: Box<Fit>,
        /// Topology and parameters.
        recognised: &'a Recognised,
        /// What it has prepared.
        constants: Vec<f64>,
        /// The states.
        states: Vec<Vec<f64>>,
        /// Where accelerations go.
        found: Vec<f64>,
    },
}

impl<'a> ComparedCode<'a> {
    pub(crate) fn recursion(dynamics: &Recursive<f64>, states: &'a [RandomState]) -> Self {
        let found = Accelerations::for_hinges(dynamics.free_hinges().len());
        Self::Recursion { dynamics: Box::new(dynamics.clone()), states, found }
    }

    pub(crate) fn routine(
        fit: Fit,
        recognised: &'a Recognised,
        states: &[Coordinates<f64>],
    ) -> Self {
        let constants = fit.constants();
        let states = states.iter().map(|state| embedded(state, &fit)).collect();
        let found = vec![0.0; fit.kernel.outputs];
        Self::Routine { fit: Box::new(fit), recognised, constants, states, found }
    }

    /// ω̇, a_O, then τ̇ in the order of the scene's hinges, in state `i`.
    ///
    /// # Panics
    /// When there is no state `i`.
    pub fn accelerations(&mut self, i: usize) -> Vec<f64> {
        match self {
            Self::Recursion { dynamics, states, found } => {
                dynamics.accelerations(&states[i].motion(), found);
                let Accelerations { omega_dot_body, origin_body, tau_dot } = found;
                let main = Twist { angular: *omega_dot_body, linear: *origin_body };
                flat(main, tau_dot, 0..tau_dot.len())
            }
            Self::Dense { dense, states } => {
                let found = dense.accelerations(&states[i].motion());
                [&found[3..6], &found[..3], &found[6..]].concat()
            }
            Self::ClosedForm { formulation, recognised, states } => {
                let Recognised { topology, parameters, links, .. } = recognised;
                let found = formulation.solve(topology, parameters, &states[i]);
                flat(found.main, &found.tau_dot, links.iter().copied())
            }
            Self::Tree { tree, states } => {
                let found = symmetric::solve_tree(tree, &states[i]);
                flat(found.main, &found.tau_dot, 0..found.tau_dot.len())
            }
            Self::Routine { fit, recognised, constants, states, found } => {
                fit.kernel.evaluate(constants, &states[i], found);
                let vector = |at: usize| Vec3::new(found[at], found[at + 1], found[at + 2]);
                let main = Twist { angular: vector(0), linear: vector(3) };
                let tau_dot: Vec<f64> = fit.hinges().map(|(_, output)| found[output]).collect();
                flat(main, &tau_dot, recognised.links.iter().copied())
            }
        }
    }
}

/// A state as a routine takes it; virtual links stand still.
fn embedded(state: &Coordinates<f64>, fit: &Fit) -> Vec<f64> {
    let mut numbers = state.omega.to_array().to_vec();
    numbers.extend(state.external.moment.to_array());
    numbers.extend(state.external.force.to_array());
    numbers.resize(Layout::coordinates(fit.embedding.outer()), 0.0);
    for (hinge, ([beta, tau, torque], _)) in state.hinges.iter().zip(fit.hinges()) {
        (numbers[beta], numbers[tau], numbers[torque]) = (hinge.beta, hinge.tau, hinge.torque);
    }
    numbers
}

/// Accelerations in one list, τ̇ of a hinge where its link says.
fn flat(main: Twist<f64>, tau_dot: &[f64], links: impl Iterator<Item = usize>) -> Vec<f64> {
    let mut all = [main.angular.to_array(), main.linear.to_array()].concat();
    all.resize(6 + tau_dot.len(), 0.0);
    for (tau_dot, link) in tau_dot.iter().zip(links) {
        all[6 + link] = *tau_dot;
    }
    all
}
