//! Generated routines of common topologies, ready to run.
//!
//! Each topology comes twice: for satellites whose inertias stand along the segment axes, with
//! every mass centre on its segment's η axis and O at the main body's mass centre, and for all
//! others.
//!
//! ```
//! let topologies: Vec<_> = nboom_routines::all().iter().map(|kernel| kernel.topology).collect();
//! assert!(topologies.contains(&"S2_P"));
//! ```

use std::sync::OnceLock;

use nboom_scalar::{Batch, Kernel};

include!(concat!(env!("OUT_DIR"), "/routines.rs"));

/// The stock routines for accelerations: those of `articulated`, the more specialised one of each
/// topology first, then those of S2_P by the other formulations.
pub fn all() -> &'static [Kernel] {
    static ALL: OnceLock<Vec<Kernel>> = OnceLock::new();
    ALL.get_or_init(stock)
}

/// Matrix and right side of S2_P by `report`, `relative` and `symmetric`, hinges appendage by
/// appendage.
///
/// ```
/// let size = 6 + 4;
/// assert!(nboom_routines::equations().iter().all(|kernel| kernel.outputs == size * size + size));
/// ```
pub fn equations() -> &'static [Kernel] {
    static EQUATIONS: OnceLock<Vec<Kernel>> = OnceLock::new();
    EQUATIONS.get_or_init(of_equations)
}

/// Routines on eight states at once, for satellites with principal axes.
///
/// They are compiled for the topologies of the benches only; any other comes from
/// [`Batch::of`] and a routine of this crate.
///
/// ```
/// use nboom_scalar::Eight;
/// let batch = nboom_routines::batches().iter().find(|batch| batch.topology == "S2_P").unwrap();
/// let constants = vec![Eight::default(); batch.constants];
/// assert!(!batch.accepts(&constants));
/// ```
pub fn batches() -> &'static [Batch] {
    static BATCHES: OnceLock<[Batch; 4]> = OnceLock::new();
    BATCHES.get_or_init(|| {
        [
            Batch::of::<PrincipalS2P>(),
            Batch::of::<Principal4S5>(),
            Batch::of::<PrincipalS100>(),
            Batch::of::<Principal20S5>(),
        ]
    })
}
