use nboom_formulation::{Formulation, Layout};
use nboom_model::Topology;

use crate::granted::links;

/// How freely generated code may rearrange arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// Every value is that of the closed form on the same scalar.
    Exact,
    /// Products and sums are fused where the scalar can round once.
    Fast,
}

impl Level {
    /// `exact` or `fast`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Fast => "fast",
        }
    }
}

/// What an evaluation writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// ω̇, a_O and τ̇, in the order of [`Layout`].
    Accelerations,
    /// The formulation's matrix row by row, then its right side, hinges appendage by appendage
    /// (`Formulation::equations`).
    Equations,
}

impl Output {
    /// `accelerations` or `equations`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accelerations => "accelerations",
            Self::Equations => "equations",
        }
    }

    /// How many numbers an evaluation writes.
    pub fn size(self, topology: &Topology) -> usize {
        match self {
            Self::Accelerations => Layout::outputs(topology),
            Self::Equations => {
                let unknowns = 6 + topology.hinges();
                unknowns * unknowns + unknowns
            }
        }
    }
}

/// What to generate.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Name of the type that implements the routine, a Rust identifier.
    pub name: String,
    /// Path of the crate `nboom_scalar` where the code will stand.
    pub scalar_path: String,
    /// The satellite's appendages.
    pub topology: Topology,
    /// The closed form that is traced.
    pub formulation: Formulation,
    /// What an evaluation writes.
    pub output: Output,
    /// Parameters that the code takes for granted; `None` stays a runtime value.
    pub pinned: Vec<Option<f64>>,
    /// Whether anything acts on the main body from outside.
    pub external: bool,
    /// How freely arithmetic may be rearranged.
    pub level: Level,
}

impl Request {
    /// Code for a topology with all parameters at run time, without external wrench:
    /// accelerations by `articulated`.
    pub fn new(name: &str, topology: Topology, level: Level) -> Self {
        let pinned = vec![None; Layout::parameters(&topology)];
        Self {
            name: name.to_owned(),
            scalar_path: "::nboom_scalar".to_owned(),
            topology,
            formulation: Formulation::Articulated,
            output: Output::Accelerations,
            pinned,
            external: false,
            level,
        }
    }

    /// Code that also takes an external wrench on the main body.
    pub fn with_external_wrench(mut self) -> Self {
        self.external = true;
        self
    }

    /// Code by another formulation.
    pub fn by(mut self, formulation: Formulation) -> Self {
        self.formulation = formulation;
        self
    }

    /// Code for the matrix and the right side that the formulation solves.
    pub fn for_equations(mut self) -> Self {
        self.output = Output::Equations;
        self
    }

    /// Takes every parameter for granted: code for one satellite.
    ///
    /// `parameters` are the numbers that `nboom_formulation::Parameters::write` gives.
    pub fn baked(mut self, parameters: &[f64]) -> Self {
        self.pinned = parameters.iter().copied().map(Some).collect();
        self
    }

    /// Takes for granted what holds of the report's decks: every mass centre on its segment's
    /// η axis, every inertia along the segment axes, O at the main body's mass centre.
    pub fn with_principal_axes(mut self) -> Self {
        const FIRST_MOMENT_X: usize = 1;
        const FIRST_MOMENT_Z: usize = 3;
        const PRODUCTS: [usize; 3] = [7, 8, 9];
        const NEXT_Z: usize = 11;
        for at in [1, 2, 3, 7, 8, 9] {
            self.pinned[at] = Some(0.0);
        }
        for link in links(&self.topology) {
            for at in [FIRST_MOMENT_X, FIRST_MOMENT_Z, NEXT_Z].into_iter().chain(PRODUCTS) {
                self.pinned[link + at] = Some(0.0);
            }
        }
        self
    }
}
