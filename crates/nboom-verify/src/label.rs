use std::fmt;

use nboom_formulation::assumptions_in_a_word;
use nboom_scalar::Kernel;
use nboom_sim::{Fit, Selection};
use serde::Serialize;

/// Which code it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Label {
    /// `generic` for code of the library, `generated` for routines.
    pub path: &'static str,
    /// The form of the equations of motion.
    pub formulation: &'static str,
    /// What it assumes of a scene, as [`assumptions_in_a_word`] says it.
    pub assumptions: &'static str,
    /// Instruction set in use: `avx512`, `avx2` or `portable`.
    pub instructions: &'static str,
    /// The topology that a routine is for; none of code that is for any.
    pub topology: Option<&'static str>,
    /// How many links of that topology are virtual, because the satellite has fewer; over several
    /// modes, the most.
    pub virtual_links: usize,
}

impl Label {
    /// The recursion, which the others are compared with.
    pub const RECURSION: Self = Self {
        path: Selection::GENERIC,
        formulation: "recursive",
        assumptions: "general",
        instructions: "portable",
        topology: None,
        virtual_links: 0,
    };

    /// The whole mass matrix by composite bodies, factored by Cholesky's method.
    pub const DENSE: Self = Self { formulation: "dense", ..Self::RECURSION };

    /// A closed form of the library, which assumes nothing.
    pub fn generic(formulation: &'static str) -> Self {
        Self { formulation, ..Self::RECURSION }
    }

    /// A routine and how a mode is embedded in its topology.
    pub fn generated(fit: &Fit) -> Self {
        let (kernel, virtual_links) = (&fit.kernel, fit.embedding.virtual_links());
        let Kernel { formulation, instructions, topology, .. } = *kernel;
        let (assumptions, topology) = (assumptions_in_a_word(kernel), Some(topology));
        let path = Selection::GENERATED;
        Self { path, formulation, assumptions, instructions, topology, virtual_links }
    }

    /// The code alone, however many links it takes as virtual.
    pub(crate) fn code(self) -> Self {
        Self { virtual_links: 0, ..self }
    }
}

impl fmt::Display for Label {
    /// Path, formulation and assumptions.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} ({})", self.path, self.formulation, self.assumptions)
    }
}

/// What is compared, and what its deviations are relative to. The scale of accelerations and that of the
/// forcing are at least a thousandth of the natural size of what adds up to them, such as |ω|² and |ω|² J, so
/// that results that cancel to zero are compared too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// ω̇, a_O and τ̇: relative to the largest of them. Where rounding is magnified more than 1e4 times, deviations are
    /// divided by how much more it is.
    ///
    /// Rounding in a row of the equations is relative to its right side, and to entries of the mass matrix times
    /// accelerations; the inverse of the matrix magnifies it. In an entry it is relative to the root of the product of the
    /// inertias that row and column move: a mass, or half the trace of a tensor, which is as large as moments of inertia
    /// get. A tensor that is turned to other axes has rounding of that size, which is much of what turns a slender body
    /// about its long axis.
    Accelerations,
    /// The matrix of a formulation, O at the inertial origin: entry (i, j) relative to the root of the product of the
    /// inertias that i and j move, as above, so that units do not matter.
    MassMatrix,
    /// The right side that belongs to the matrix: relative to its largest entry.
    Forcing,
}

/// Which hinges turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Hinges {
    /// All of them.
    Free,
    /// Some or none, the others are held at random angles.
    Held,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Accelerations => "accelerations",
            Self::MassMatrix => "mass matrix",
            Self::Forcing => "forcing",
        })
    }
}
