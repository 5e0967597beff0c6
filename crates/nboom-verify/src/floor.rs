//! The sizes that scales of deviations are not below, where true results cancel to nothing.

use nboom_model::{Joint, Link, WeldedTree};

use crate::random_state::RandomState;

/// A result below this share of its terms has cancelled. Rounding, some 1e-16 of the terms, is then
/// some 1e-13 of the scale, well below any sensible tolerance; results that have not cancelled, which
/// are larger, keep their own scale.
const CANCELLED: f64 = 1e-3;

/// The least scales of deviations in one state.
///
/// With a generalised speed of 0 for the velocity of O, right sides are made of products mass matrix
/// times speed times angular rate: the gyroscopic torque ω × J ω, the force m ω × (ω × c), and those of
/// hinges. The natural size of entry i is then √(Σⱼ (Mᵢⱼ uⱼ)²) Ω, where u are the speeds and Ω² is the
/// sum of the squares of ω and of the rates of hinges that turn. Divided by inertias that is Ω² for accelerations: a body that
/// spins at Ω has points with accelerations Ω² r even where ω̇ is 0.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    /// Of ω̇, a_O and τ̇.
    pub accelerations: f64,
    /// Of right sides, and of forces and torques.
    pub forcing: f64,
}

impl Floor {
    pub(crate) fn of(natural: &Natural) -> Self {
        let Natural { square, right_sides } = natural;
        let largest = right_sides.iter().copied().fold(0.0, f64::max);
        Self { accelerations: CANCELLED * square, forcing: CANCELLED * largest }
    }
}

/// Natural sizes in one state.
pub(crate) struct Natural {
    /// Ω².
    square: f64,
    /// Of the right side of each row of the matrix of kinetic energy.
    pub right_sides: Vec<f64>,
}

impl Natural {
    /// For a state, hinges in the order of the tree's links, and the matrix of kinetic energy over
    /// (a_O, ω̇, τ̇).
    pub fn new(tree: &WeldedTree<f64>, state: &RandomState, matrix: &[f64]) -> Self {
        let RandomState { omega, tau, .. } = state;
        let turns = |(link, rate): (&Link<f64>, &f64)| match link.joint {
            Joint::Revolute => rate * rate,
            Joint::Prismatic => 0.0,
        };
        let of_hinges: f64 = tree.links.iter().zip(tau).map(turns).sum();
        let square = omega.dot(*omega) + of_hinges;
        let speeds = [&[0.0; 3], &omega.to_array()[..], tau].concat();
        let size =
            |row: &[f64]| row.iter().zip(&speeds).map(|(m, u)| (m * u).powi(2)).sum::<f64>().sqrt();
        let rows = matrix.chunks_exact(speeds.len());
        Self { square, right_sides: rows.map(|row| size(row) * square.sqrt()).collect() }
    }
}
