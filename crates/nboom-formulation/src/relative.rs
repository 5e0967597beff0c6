//! Formulation `relative`: matrix B = A a over (v̇, ω̇, τ̇), eq. (5.15).
//!
//! The hinge block of B is symmetric, the rest is not unless ρ̄ is zero.

use nboom_model::{Shape, Topology};
use nboom_scalar::Real;

use crate::formulation::ClosedForm;
use crate::parameters::{Coordinates, Parameters, Solution};
use crate::report;
use crate::section5::{self, Equations, OriginMotion};

/// The row of [`Formulation`](crate::Formulation)'s table.
pub(crate) struct Relative;

impl ClosedForm for Relative {
    const NAME: &'static str = "relative";
    const ABOUT: &'static str = "the report's matrix B = A a over (v̇, ω̇, τ̇)";

    const HAS_EQUATIONS: bool = true;

    fn equations<R: Real>(
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Option<Equations<R>> {
        Some(equations_at(topology, parameters, coordinates, &OriginMotion::origin()))
    }

    fn solve<R: Real>(
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Solution<R> {
        solve_at(topology, parameters, coordinates, &OriginMotion::origin())
    }
}

/// B and u over (v̇, ω̇, τ̇) where O is at `place`, hinges appendage by appendage, without gravity.
///
/// σ = a τ, eq. (5.14): a chain's σ are sums of τ, so columns are summed from the tip.
pub fn equations_at<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    coordinates: &Coordinates<R>,
    place: &OriginMotion<R>,
) -> Equations<R> {
    let mut equations = section5::equations_at(topology, parameters, coordinates, place);
    let size = equations.forcing.len();
    let mut first = 6;
    for shape in topology.shapes() {
        if matches!(shape, Shape::Chain(_)) {
            for row in equations.matrix.chunks_exact_mut(size) {
                for j in (first + 1..first + shape.hinges()).rev() {
                    let outer = row[j];
                    row[j - 1] += outer;
                }
            }
        }
        first += shape.hinges();
    }
    equations
}

/// Accelerations of a satellite whose O is at `place`.
pub fn solve_at<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    coordinates: &Coordinates<R>,
    place: &OriginMotion<R>,
) -> Solution<R> {
    let unknowns = equations_at(topology, parameters, coordinates, place).solve();
    let main = report::main_rates(&unknowns, coordinates.omega, place);
    Solution { main, tau_dot: unknowns[6..].to_vec() }
}
