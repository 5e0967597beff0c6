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

use nboom_scalar::Kernel;

include!(concat!(env!("OUT_DIR"), "/routines.rs"));

/// The stock routines, the more specialised one of each topology first.
pub fn all() -> &'static [Kernel] {
    static ALL: OnceLock<Vec<Kernel>> = OnceLock::new();
    ALL.get_or_init(stock)
}
