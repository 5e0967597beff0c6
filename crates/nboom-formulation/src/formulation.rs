use std::fmt;

use nboom_model::{Topology, WeldedTree};
use nboom_scalar::Real;

use crate::parameters::{Coordinates, Parameters, Solution};
use crate::recognise::{Uncovered, chains_and_paddles};
use crate::section5::Equations;
use crate::{articulated, momentum, relative, report, symmetric};

/// What a closed form is and can do, with O at the inertial origin where it asks for its place.
pub(crate) trait ClosedForm {
    /// The name in commands and files.
    const NAME: &'static str;

    /// What it is, in one line.
    const ABOUT: &'static str;

    /// Whether it solves a system for the accelerations, whose matrix and right side can be had.
    const HAS_EQUATIONS: bool = false;

    /// Whether it takes appendages that are neither chains nor paddles as limbs.
    const TAKES_LIMBS: bool = false;

    /// Whether it covers the tree: chains with parallel axes and paddles, unless it says otherwise.
    ///
    /// # Errors
    /// Why not.
    fn covers(tree: &WeldedTree<f64>) -> Result<(), Uncovered> {
        chains_and_paddles(tree)
    }

    /// The system that it solves, hinges appendage by appendage; `None` where it never forms one.
    fn equations<R: Real>(
        _topology: &Topology,
        _parameters: &Parameters<R>,
        _coordinates: &Coordinates<R>,
    ) -> Option<Equations<R>> {
        None
    }

    /// Accelerations of a satellite of chains and paddles.
    fn solve<R: Real>(
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Solution<R>;
}

/// Makes [`Formulation`] of a table with one row for each closed form: its name in the code and the
/// type that knows the form.
macro_rules! formulations {
    ($($(#[$doc:meta])* $name:ident = $form:ty,)*) => {
        /// A closed form of the equations of motion.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Formulation {
            $($(#[$doc])* $name,)*
        }

        impl Formulation {
            /// All, in the order of their development from the report's.
            pub const ALL: [Self; [$(Self::$name),*].len()] = [$(Self::$name),*];

            /// The name in commands and files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$name => <$form>::NAME,)*
                }
            }

            /// What it is, in one line.
            pub fn about(self) -> &'static str {
                match self {
                    $(Self::$name => <$form>::ABOUT,)*
                }
            }

            /// Whether it solves a system for the accelerations, whose matrix and right side can be had.
            pub fn has_equations(self) -> bool {
                match self {
                    $(Self::$name => <$form>::HAS_EQUATIONS,)*
                }
            }

            /// Whether satellites of this topology can be [solved](Self::solve).
            pub fn takes(self, topology: &Topology) -> bool {
                let takes_limbs = match self {
                    $(Self::$name => <$form>::TAKES_LIMBS,)*
                };
                takes_limbs || !topology.has_limbs()
            }

            /// Whether it covers the tree.
            ///
            /// # Errors
            /// Why not: no form covers links that are not rigid; all but `symmetric` take a free main body
            /// alone, and of those all but `articulated` only chains with parallel axes and paddles.
            pub fn covers(self, tree: &WeldedTree<f64>) -> Result<(), Uncovered> {
                match self {
                    $(Self::$name => <$form>::covers(tree),)*
                }
            }

            /// The system that it solves, hinges appendage by appendage, with O at the inertial
            /// origin; `None` where it never forms one.
            ///
            /// The unknowns are (v̇, ω̇, σ̇) for `report`, (v̇, ω̇, τ̇) for `relative` and
            /// (a_O, ω̇, τ̇) for `symmetric`; gravity is left out.
            pub fn equations<R: Real>(
                self,
                topology: &Topology,
                parameters: &Parameters<R>,
                coordinates: &Coordinates<R>,
            ) -> Option<Equations<R>> {
                match self {
                    $(Self::$name => <$form>::equations(topology, parameters, coordinates),)*
                }
            }

            /// Accelerations of a satellite, with O at the inertial origin where the formulation asks
            /// for its place.
            ///
            /// # Panics
            /// When the formulation does not [take](Self::takes) the topology.
            pub fn solve<R: Real>(
                self,
                topology: &Topology,
                parameters: &Parameters<R>,
                coordinates: &Coordinates<R>,
            ) -> Solution<R> {
                match self {
                    $(Self::$name => <$form>::solve(topology, parameters, coordinates),)*
                }
            }
        }
    };
}

formulations! {
    /// Section 5 with the report's unknowns.
    Report = report::Report,
    /// Section 5 with relative hinge rates.
    Relative = relative::Relative,
    /// The matrix of kinetic energy.
    Symmetric = symmetric::Symmetric,
    /// O(n) elimination.
    Articulated = articulated::Articulated,
    /// O(n) elimination on momenta.
    Momentum = momentum::Momentum,
}

impl Formulation {
    /// The formulation with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|formulation| formulation.name() == name)
    }
}

impl fmt::Display for Formulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
