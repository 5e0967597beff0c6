use std::fmt;

use nboom_scalar::Kernel;
use serde::Serialize;

/// Which code it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Label {
    /// `generic` for code of the library, `generated` for routines.
    pub path: &'static str,
    /// The form of the equations of motion.
    pub formulation: &'static str,
    /// What it takes for granted about a scene: `general` nothing, `principal` some parameters,
    /// `baked` all of them.
    pub facts: &'static str,
    /// Instruction set in use: `avx512`, `avx2` or `portable`.
    pub instructions: &'static str,
}

impl Label {
    /// The recursion, which the others are compared with.
    pub const RECURSION: Self = Self {
        path: "generic",
        formulation: "recursive",
        facts: "general",
        instructions: "portable",
    };

    /// A closed form of the library, which takes any facts.
    pub fn generic(formulation: &'static str) -> Self {
        Self { formulation, ..Self::RECURSION }
    }

    /// A routine.
    pub fn generated(kernel: &Kernel) -> Self {
        let facts = match kernel.pinned.len() {
            0 => "general",
            pinned if pinned == kernel.parameters => "baked",
            _ => "principal",
        };
        let Kernel { formulation, instructions, .. } = *kernel;
        Self { path: "generated", formulation, facts, instructions }
    }
}

impl fmt::Display for Label {
    /// Path, formulation and facts.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} ({})", self.path, self.formulation, self.facts)
    }
}

/// What is compared, and what its deviations are relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// ω̇, a_O and τ̇: relative to the largest of them. Where the mass matrix, scaled to diagonal 1,
    /// has a condition above 1e4, deviations are divided by its ratio to 1e4, since it magnifies
    /// rounding as much.
    Accelerations,
    /// The matrix of a formulation, O at the inertial origin: entry (i, j) relative to √(Mᵢᵢ Mⱼⱼ),
    /// where M is the matrix of kinetic energy, so that units do not matter.
    MassMatrix,
    /// The right side that belongs to the matrix: relative to its largest entry.
    Forcing,
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
