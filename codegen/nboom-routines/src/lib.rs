//! Generated routines of common topologies, ready to run.
//!
//! Each topology comes for each `Symmetry` of `nboom-formulation` that it may have: along principal axes, with
//! mirrored links if it has chains alone, and any.
//!
//! ```
//! let topologies: Vec<_> = nboom_routines::all().iter().map(|kernel| kernel.topology).collect();
//! assert!(topologies.contains(&"S2_P"));
//! ```

use std::sync::OnceLock;

use nboom_scalar::{Batch, Kernel};

mod stock {
    include!(concat!(env!("OUT_DIR"), "/stock.rs"));
}

mod of_equations {
    include!(concat!(env!("OUT_DIR"), "/equations.rs"));
}

mod of_right_sides {
    include!(concat!(env!("OUT_DIR"), "/right_sides.rs"));
}

pub use stock::{
    General2Trr, GeneralTrrr, Principal4S5, Principal20S5, PrincipalS2P, PrincipalS100,
};

/// The stock routines for accelerations: those of `articulated`, the more specialised one of each
/// topology first, then those of S2_P by the other formulations.
pub fn all() -> &'static [Kernel] {
    stock::kernels()
}

/// Matrix and right side of S2_P by `report`, `relative` and `symmetric`, hinges appendage by
/// appendage.
///
/// ```
/// let size = 6 + 4;
/// assert!(nboom_routines::equations().iter().all(|kernel| kernel.outputs == size * size + size));
/// ```
pub fn equations() -> &'static [Kernel] {
    static EQUATIONS: OnceLock<[Kernel; 3]> = OnceLock::new();
    EQUATIONS.get_or_init(|| {
        [
            Kernel::of::<of_equations::ReportEquationsS2P>(),
            Kernel::of::<of_equations::RelativeEquationsS2P>(),
            Kernel::of::<of_equations::SymmetricEquationsS2P>(),
        ]
    })
}

/// The routines that a run takes: [`all`], then [`right_sides`].
pub fn for_runs() -> &'static [Kernel] {
    static FOR_RUNS: OnceLock<Vec<Kernel>> = OnceLock::new();
    FOR_RUNS.get_or_init(|| [all(), right_sides()].concat())
}

/// Those of [`right_sides`] that are compiled for eight states at once, too: of up to four hinges, and of
/// single chains.
pub fn right_sides_of_eight() -> &'static [Batch] {
    of_right_sides::batches()
}

/// Right sides of the differential equations by `articulated`, without external wrench: those of each
/// topology of [`all`] with up to four equal appendages, and of up to four hinges more that take
/// lines that push the links, along principal axes and along any, and one that takes an external wrench.
///
/// ```
/// use nboom_formulation::RightSideLayout;
/// let topology = "S2_P".parse()?;
/// let of_topology = nboom_routines::right_sides().iter().filter(|kernel| kernel.topology == "S2_P");
/// assert!(of_topology.clone().count() == 5);
/// for kernel in of_topology {
///     assert_eq!(kernel.parameters, RightSideLayout::parameters(&topology));
///     assert_eq!(kernel.coordinates, RightSideLayout::coordinates(&topology));
/// }
/// # Ok::<(), nboom_model::TopologyError>(())
/// ```
pub fn right_sides() -> &'static [Kernel] {
    of_right_sides::kernels()
}

/// Calls a function of a routine's type for each routine that [`batches`] has, and gives the array
/// of what it returns.
///
/// ```
/// use nboom_scalar::Routine;
/// fn topology<T: Routine>() -> &'static str {
///     T::TOPOLOGY
/// }
/// assert_eq!(nboom_routines::for_each_batched!(topology).len(), nboom_routines::batches().len());
/// ```
#[macro_export]
macro_rules! for_each_batched {
    ($($function:ident)::+) => {
        [
            $($function)::+::<$crate::PrincipalS2P>(),
            $($function)::+::<$crate::Principal4S5>(),
            $($function)::+::<$crate::PrincipalS100>(),
            $($function)::+::<$crate::Principal20S5>(),
        ]
    };
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
    static BATCHES: OnceLock<Vec<Batch>> = OnceLock::new();
    BATCHES.get_or_init(|| for_each_batched!(Batch::of).into())
}
