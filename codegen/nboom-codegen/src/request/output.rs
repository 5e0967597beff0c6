use nboom_formulation::{Layout, RightSideLayout};
use nboom_model::Topology;

/// What an evaluation writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// ω̇, a_O and τ̇, in the order of [`Layout`].
    Accelerations,
    /// The formulation's matrix row by row, then its right side, hinges appendage by appendage
    /// (`Formulation::equations`).
    Equations,
    /// External moment and force about O and hinge torques under which given accelerations come about,
    /// in the order of [`Layout`] (`nboom_formulation::Motion`, `Drive`).
    InverseDynamics,
    /// The rates of change of attitude, ω, β and τ, and the power of the dashpots, in the order of
    /// [`RightSideLayout`].
    RightSide,
}

impl Output {
    /// `accelerations`, `equations`, `inverse_dynamics` or `right_side`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accelerations => "accelerations",
            Self::Equations => "equations",
            Self::InverseDynamics => "inverse_dynamics",
            Self::RightSide => "right_side",
        }
    }

    /// How many numbers a routine prepares.
    pub fn parameters(self, topology: &Topology) -> usize {
        match self {
            Self::Accelerations | Self::Equations | Self::InverseDynamics => {
                Layout::parameters(topology)
            }
            Self::RightSide => RightSideLayout::parameters(topology),
        }
    }

    /// How many numbers an evaluation reads.
    pub fn coordinates(self, topology: &Topology) -> usize {
        match self {
            Self::Accelerations | Self::Equations | Self::InverseDynamics => {
                Layout::coordinates(topology)
            }
            Self::RightSide => RightSideLayout::coordinates(topology),
        }
    }

    /// How many numbers an evaluation writes.
    pub fn size(self, topology: &Topology) -> usize {
        match self {
            Self::Accelerations | Self::InverseDynamics => Layout::outputs(topology),
            Self::Equations => {
                let unknowns = 6 + topology.hinges();
                unknowns * unknowns + unknowns
            }
            Self::RightSide => RightSideLayout::outputs(topology),
        }
    }
}
