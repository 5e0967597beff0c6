/// Why nothing was generated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodegenError {
    /// The name of the type is not one.
    #[error("routine `{0}`: a Rust identifier expected")]
    Name(String),
    /// The path of the scalar crate is not one.
    #[error("routine `{name}`: `{path}` found, the path of the crate nboom_scalar expected")]
    Path {
        /// The routine.
        name: String,
        /// What was given.
        path: String,
    },
    /// Parameters taken for granted do not fit the topology.
    #[error("topology {topology}: {found} parameters found, {expected} expected")]
    Parameters {
        /// The topology.
        topology: String,
        /// How many were given.
        found: usize,
        /// How many it has.
        expected: usize,
    },
    /// A parameter taken for granted is infinite or not a number.
    #[error("topology {topology}: parameter {number} is {value}, a finite number expected")]
    NotFinite {
        /// The topology.
        topology: String,
        /// Which parameter, from 0.
        number: usize,
        /// Its value.
        value: f64,
    },
    /// The topology has more links than generated loops are meant for.
    #[error("topology {topology}: {links} hinges found, at most {limit} expected")]
    TooLarge {
        /// The topology.
        topology: String,
        /// Its hinges.
        links: usize,
        /// The most that is generated.
        limit: usize,
    },
}
