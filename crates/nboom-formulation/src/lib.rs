//! Closed forms of the equations of motion, each written once over any scalar.
//!
//! This crate shares only spatial algebra with the recursion. Tests compare the two.

mod arrow;
pub mod articulated;
mod base;
mod chain;
mod dense;
mod embedding;
mod forces;
mod formulation;
mod inverse_dynamics;
mod limb;
pub mod momentum;
mod name;
mod no_place;
mod paddle;
mod parameters;
mod pose;
mod recognise;
pub mod relative;
pub mod report;
mod right_side;
mod section5;
pub mod stages;
pub mod symmetric;
mod symmetry;
mod tree;

pub use base::AtOrigin;
pub use chain::{ChainLink, OutboardShare};
pub use embedding::Embedding;
pub use forces::{Forces, LinkLine};
pub use formulation::Formulation;
pub use inverse_dynamics::{Drive, HingeMotion, Motion, inverse_dynamics};
pub use no_place::NoPlace;
pub use parameters::{Branch, Coordinates, HingeCoordinates, Layout, Mount, Parameters, Solution};
pub use recognise::{LinkFrame, Recognised, Seats, Uncovered, Why, recognise};
pub use right_side::{RightSideLayout, right_side};
pub use section5::Equations;
pub use symmetry::{Symmetry, assumptions_in_a_word};
