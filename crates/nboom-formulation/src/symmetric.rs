//! Formulation `symmetric`: B₀ (a_O, ω̇, τ̇) = u₀ with B₀ the matrix of kinetic energy, an
//! arrow of blocks whose hinges are eliminated appendage by appendage.
//!
//! Chains are written with augmented bodies and absolute rates: everything outboard of a link
//! is lumped at its outboard hinge, so that a diagonal entry is a constant and any other one is
//! an inner product. Limbs are written with composite bodies along the axes of their joints, and
//! relative rates. [`solve_tree`] takes any tree whatsoever.

mod appendage;
mod tree;

use nboom_model::{Topology, WeldedTree};
use nboom_scalar::{Real, Twist};

use crate::arrow::Arrow;
use crate::base::AtOrigin;
use crate::formulation::ClosedForm;
use crate::parameters::{Branch, Coordinates, Parameters, Solution};
use crate::pose;
use crate::recognise::{Uncovered, rigid};
use crate::section5::Equations;

pub use tree::{forcing as tree_forcing, mass_matrix as tree_mass_matrix, solve as solve_tree};

/// The row of [`Formulation`](crate::Formulation)'s table.
pub(crate) struct Symmetric;

impl ClosedForm for Symmetric {
    const NAME: &'static str = "symmetric";
    const ABOUT: &'static str =
        "kinetic-energy matrix over (a_O, ω̇, τ̇), appendages eliminated first; any tree";

    const HAS_EQUATIONS: bool = true;
    const TAKES_LIMBS: bool = true;

    fn covers(tree: &WeldedTree<f64>) -> Result<(), Uncovered> {
        rigid(tree)
    }

    fn equations<R: Real>(
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Option<Equations<R>> {
        let whole = whole(topology, parameters, coordinates);
        Some(Equations { matrix: whole.dense(), forcing: whole.dense_right() })
    }

    fn solve<R: Real>(
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Solution<R> {
        let Coordinates { omega, external, .. } = coordinates;
        let mut total = AtOrigin::of_main_body(&parameters.main, *omega, external);
        let mut eliminated = Vec::new();
        for (branch, arrow) in appendages(topology, parameters, coordinates) {
            R::remark(|| format!("Appendage {}: its hinges eliminated.", eliminated.len() + 1));
            let (seen, left) = arrow.eliminate();
            total.add(&seen.rotated(&branch.rot_body_from_appendage));
            eliminated.push((branch.rot_body_from_appendage, left));
        }
        R::remark(|| "Main body: a_O eliminated, ω̇ solved for, then a_O.".to_owned());
        let main = total.accelerations();
        let mut tau_dot = Vec::new();
        for (i, (shape, (rot, left))) in topology.shapes().iter().zip(&eliminated).enumerate() {
            R::remark(|| format!("Appendage {}, back: τ̇ of its hinges.", i + 1));
            let seen = Twist {
                angular: rot.transpose_mul(main.angular),
                linear: rot.transpose_mul(main.linear),
            };
            tau_dot.extend(pose::relative(shape, &left.back(seen)));
        }
        Solution { main, tau_dot }
    }
}

/// Each appendage with its arrow along appendage axes, absolute rates.
fn appendages<'a, R: Real>(
    topology: &'a Topology,
    parameters: &'a Parameters<R>,
    coordinates: &'a Coordinates<R>,
) -> impl Iterator<Item = (&'a Branch<R>, Arrow<R>)> {
    let mut first = 0;
    let branches = topology.shapes().iter().zip(&parameters.branches).enumerate();
    branches.map(move |(i, (shape, branch))| {
        R::remark(|| format!("Appendage {}: its block of the matrix, its right side.", i + 1));
        let hinges = &coordinates.hinges[first..first + shape.hinges()];
        first += shape.hinges();
        (branch, appendage::arrow(shape, branch, coordinates.omega, hinges))
    })
}

/// The arrow of the whole satellite along main-body axes, relative rates.
fn whole<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    coordinates: &Coordinates<R>,
) -> Arrow<R> {
    let Coordinates { omega, external, .. } = coordinates;
    let mut whole = Arrow {
        inboard: Vec::new(),
        hinges: Vec::new(),
        columns: Vec::new(),
        right: Vec::new(),
        base: AtOrigin::of_main_body(&parameters.main, *omega, external),
    };
    let shapes = topology.shapes().iter();
    for (shape, (branch, arrow)) in shapes.zip(appendages(topology, parameters, coordinates)) {
        let rot = &branch.rot_body_from_appendage;
        let arrow = appendage::with_relative_rates(shape, arrow);
        let first = whole.right.len();
        for (inboard, row) in arrow.inboard.into_iter().zip(arrow.hinges) {
            whole.inboard.push(inboard.map(|inboard| first + inboard));
            whole.hinges.push([vec![R::zero(); first], row].concat());
        }
        whole.columns.extend(arrow.columns.into_iter().map(|column| pose::rotated(column, rot)));
        whole.right.extend(arrow.right);
        whole.base.add(&arrow.base.rotated(rot));
    }
    whole
}
