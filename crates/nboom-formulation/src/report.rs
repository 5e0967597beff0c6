//! Formulation `report`: the equations of Section 5 with the report's own unknowns
//! (v̇, ω̇, σ̇), matrix A unsymmetric.
//!
//! v̇ is the rate of the components of v̄, which themselves are rates of the components of ρ̄;
//! σ is relative to the main body, while a hinge row is conjugate to τ. For comparison with
//! the report; the other formulations are quicker, and do not lose digits as |ρ̄| grows.

use nboom_model::Topology;
use nboom_scalar::{Real, Twist, Vec3};

use crate::formulation::ClosedForm;
use crate::parameters::{Coordinates, Parameters, Solution};
use crate::pose;

pub use crate::section5::{Equations, OriginMotion, equations_at};

/// The row of [`Formulation`](crate::Formulation)'s table.
pub(crate) struct Report;

impl ClosedForm for Report {
    const NAME: &'static str = "report";
    const ABOUT: &'static str = "the report's Section 5: unsymmetric matrix A over (v̇, ω̇, σ̇)";

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

/// Accelerations of a satellite whose O is at `place`.
pub fn solve_at<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    coordinates: &Coordinates<R>,
    place: &OriginMotion<R>,
) -> Solution<R> {
    let unknowns = equations_at(topology, parameters, coordinates, place).solve();
    let mut tau_dot = Vec::new();
    let mut first = 6;
    for shape in topology.shapes() {
        tau_dot.extend(pose::relative(shape, &unknowns[first..first + shape.hinges()]));
        first += shape.hinges();
    }
    Solution { main: main_rates(&unknowns, coordinates.omega, place), tau_dot }
}

/// ω̇ and a_O = v̇ + ω̇ × ρ̄ + 2 ω × v̄ + ω × (ω × ρ̄) from (v̇, ω̇).
pub(crate) fn main_rates<R: Real>(
    unknowns: &[R],
    omega: Vec3<R>,
    place: &OriginMotion<R>,
) -> Twist<R> {
    let v_dot = Vec3::new(unknowns[0], unknowns[1], unknowns[2]);
    let angular = Vec3::new(unknowns[3], unknowns[4], unknowns[5]);
    Twist { angular, linear: v_dot + angular.cross(place.rho) + place.carried(omega) }
}
