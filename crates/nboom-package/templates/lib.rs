#![doc = include_str!("../README.md")]
/*USES*/
pub mod nboom_scalar;
mod routines;

pub use nboom_scalar::{Kernel, Routine};
pub use routines::{/*NAMES*/, kernels};

/// Where the numbers of one hinge stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hinge {
    /// The scene's appendage, from 1.
    pub appendage: usize,
    /// Its segment, from 1.
    pub segment: usize,
    /// Where the angle stands in a state \[rad\].
    pub angle: usize,
    /// Where the rate stands in a state.
    pub rate: usize,
    /// Where the torque of springs and dashpots stands in a state.
    pub torque: usize,
    /// Where the angular acceleration stands.
    pub acceleration: usize,
}

/// The hinges of the scene, all of them free, in its order.
#[rustfmt::skip]
pub const HINGES: [Hinge; /*HINGE_COUNT*/] = [
/*HINGE_LIST*/];

/// The scene's own numbers, as [`Kernel::prepare`] takes them.
pub fn parameters() -> &'static [f64] {
    &PARAMETERS
}
/*MORE_FUNCTIONS*/
const PARAMETERS: [f64; /*PARAMETER_COUNT*/] = [
/*PARAMETER_LIST*/];
