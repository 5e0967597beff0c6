#![doc = include_str!("../README.md")]
/*USES*/
pub mod nboom_scalar;
mod routines;

use nboom_scalar::TreeLink;
pub use nboom_scalar::{Derivatives, Kernel, Routine};
pub use routines::{/*NAMES*/, kernels};

/// Where the numbers of one hinge stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hinge {
    /// What the scene calls its body; empty if it has no name.
    pub name: &'static str,
    /// The scene's appendage, from 1.
    pub appendage: usize,
    /// Its segment, from 1.
    pub segment: usize,
    /// Whether it slides: all of its numbers are then along its axis, not about it.
    pub slides: bool,
    /// Where the angle stands in a state \[rad\].
    pub angle: usize,
    /// Where the rate stands in a state.
    pub rate: usize,
    /// Where the torque about it stands in a state, of springs, dashpots and motors.
    pub torque: usize,
    /// Where the angular acceleration stands.
    pub acceleration: usize,
/*EQUATION_FIELD*/}

/// The hinges of the scene, all of them free, in its order.
#[rustfmt::skip]
pub const HINGES: [Hinge; /*HINGE_COUNT*/] = [
/*HINGE_LIST*/];

/// The scene's own numbers, as [`Kernel::prepare`] takes them.
pub fn parameters() -> &'static [f64] {
    &PARAMETERS
}
/*HELD_IN_CODE*//*MORE_FUNCTIONS*//*RIGHT_SIDE_IN_CODE*/
/// Derivatives of the scene's accelerations, all hinges free, for these parameters. They loop over the
/// hinges and use no routine.
///
/// # Panics
/// When the parameters are not as many as the scene's.
pub fn derivatives(parameters: &[f64]) -> Derivatives {
    assert_eq!(parameters.len(), PARAMETERS.len(), "parameters of the scene");
    Derivatives::of(&TREE, parameters)
}

/// The hinges as a tree, appendage by appendage in the order of the topology.
#[rustfmt::skip]
const TREE: [TreeLink; /*HINGE_COUNT*/] = [
/*TREE_LIST*/];

#[rustfmt::skip]
const PARAMETERS: [f64; /*PARAMETER_COUNT*/] = [
/*PARAMETER_LIST*/];
