//! Closed forms of the equations of motion, each written once over any scalar.
//!
//! Nothing here is shared with the recursive path but spatial algebra: the two are compared
//! with each other on everything that is tested.

pub mod articulated;
mod base;
mod chain;
mod paddle;
mod parameters;
mod recognise;
pub mod stages;

pub use base::AtOrigin;
pub use chain::ChainLink;
pub use parameters::{Branch, Coordinates, HingeCoordinates, Layout, Parameters, Solution};
pub use recognise::{Recognised, recognise};
