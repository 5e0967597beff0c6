use std::fmt;

use nboom_model::{Topology, WeldedTree};
use nboom_scalar::Real;

use crate::parameters::{Coordinates, Parameters, Solution};
use crate::recognise::{recognise, rigid};
use crate::section5::{Equations, Place};
use crate::{articulated, momentum, relative, report, symmetric};

/// A closed form of the equations of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Formulation {
    /// Section 5 with the report's unknowns.
    Report,
    /// Section 5 with relative hinge rates.
    Relative,
    /// The matrix of kinetic energy.
    Symmetric,
    /// O(n) elimination.
    Articulated,
    /// O(n) elimination on momenta.
    Momentum,
}

impl Formulation {
    /// All, in the order of their development from the report's.
    pub const ALL: [Self; 5] =
        [Self::Report, Self::Relative, Self::Symmetric, Self::Articulated, Self::Momentum];

    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Report => "report",
            Self::Relative => "relative",
            Self::Symmetric => "symmetric",
            Self::Articulated => "articulated",
            Self::Momentum => "momentum",
        }
    }

    /// The formulation with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|formulation| formulation.name() == name)
    }

    /// What it is, in one line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Report => "the report's Section 5: unsymmetric matrix A over (v̇, ω̇, σ̇)",
            Self::Relative => "the report's matrix B = A a over (v̇, ω̇, τ̇)",
            Self::Symmetric => {
                "kinetic-energy matrix over (a_O, ω̇, τ̇), appendages eliminated first; any tree"
            }
            Self::Articulated => "O(n) elimination over (ω̇, a_O, τ̇), hinge by hinge from the tips",
            Self::Momentum => "O(n) elimination on momenta (Π, P, π): velocities, no accelerations",
        }
    }

    /// Whether it covers the tree.
    ///
    /// # Errors
    /// The first link (an index of the tree) that it cannot express: one that is not rigid; all but
    /// `symmetric` take chains with parallel axes and paddles alone.
    pub fn covers(self, tree: &WeldedTree<f64>) -> Result<(), usize> {
        match self {
            Self::Symmetric => rigid(tree),
            _ => recognise(tree).map(|_| ()),
        }
    }

    /// Whether it solves a system for the accelerations, whose matrix and right side can be had.
    pub fn has_equations(self) -> bool {
        matches!(self, Self::Report | Self::Relative | Self::Symmetric)
    }

    /// The system that it solves, hinges appendage by appendage, with O at the inertial origin;
    /// `None` where it never forms one.
    ///
    /// The unknowns are (v̇, ω̇, σ̇) for `report`, (v̇, ω̇, τ̇) for `relative` and (a_O, ω̇, τ̇) for
    /// `symmetric`; gravity is left out.
    pub fn equations<R: Real>(
        self,
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Option<Equations<R>> {
        let at = Place::origin();
        match self {
            Self::Report => Some(report::equations(topology, parameters, coordinates, &at)),
            Self::Relative => Some(relative::equations(topology, parameters, coordinates, &at)),
            Self::Symmetric => Some(Equations {
                matrix: symmetric::mass_matrix(topology, parameters, coordinates),
                forcing: symmetric::forcing(topology, parameters, coordinates),
            }),
            Self::Articulated | Self::Momentum => None,
        }
    }

    /// Accelerations of a satellite of chains and paddles, with O at the inertial origin where
    /// the formulation asks for its place.
    pub fn solve<R: Real>(
        self,
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Solution<R> {
        match self {
            Self::Report => report::solve(topology, parameters, coordinates, &Place::origin()),
            Self::Relative => relative::solve(topology, parameters, coordinates, &Place::origin()),
            Self::Symmetric => symmetric::solve(topology, parameters, coordinates),
            Self::Articulated => articulated::solve(topology, parameters, coordinates),
            Self::Momentum => momentum::solve(topology, parameters, coordinates),
        }
    }
}

impl fmt::Display for Formulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
