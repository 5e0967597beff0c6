use nboom_model::HingeLabel;

/// Why code cannot be compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The scene's numbers are finite, but one made of them is not. No routine is handed such a
    /// number.
    #[error("{parameter} of topology {topology} is {value}, a finite one expected")]
    NotFinite {
        /// The scene's topology.
        topology: String,
        /// Which parameter it is, in words.
        parameter: String,
        /// What it is.
        value: f64,
    },
    /// A random state has nothing to compare with.
    #[error("state {state} has no accelerations to compare: {}", no_reference(.hinge))]
    NoReference {
        /// The state, from 1.
        state: usize,
        /// The hinge about which nothing has inertia, where that is the reason.
        hinge: Option<HingeLabel>,
    },
    /// A routine is for the scene's topology, but not for the numbers that it has.
    #[error(
        "a routine of {topology}, {formulation}, takes {coordinates} numbers and gives {outputs}; \
         {expected_coordinates} and {expected_outputs} expected"
    )]
    Sizes {
        /// The routine's topology.
        topology: &'static str,
        /// The routine's formulation.
        formulation: &'static str,
        /// How many numbers it says a state takes.
        coordinates: usize,
        /// How many numbers it says there are in what it computes.
        outputs: usize,
        /// How many a state takes.
        expected_coordinates: usize,
        /// How many there are.
        expected_outputs: usize,
    },
    /// Somebody wants it to end.
    #[error("interrupted")]
    Interrupted,
    /// A routine for a matrix is of a formulation that has none.
    #[error("a routine gives a matrix of {formulation}, which has none")]
    NoEquations {
        /// The routine's formulation.
        formulation: &'static str,
    },
}

fn no_reference(hinge: &Option<HingeLabel>) -> String {
    match hinge {
        Some(hinge) => format!("nothing has inertia about hinge {hinge}"),
        None => "the mass matrix is singular or the forces are beyond all numbers".to_owned(),
    }
}
