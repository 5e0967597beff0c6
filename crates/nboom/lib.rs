//! Fast, exact simulation of spacecraft that unfold.
//!
//! This crate gathers the parts that a program needs to simulate a deployment: the scene
//! ([`model`]), its file formats ([`io`]), equations of motion ([`dynamics`]), the runner ([`sim`]),
//! section loads ([`loads`]), cross sections ([`sections`]), and the stresses of a run
//! ([`strength`]). `docs/architecture.md` shows how they fit together.
//!
//! With the feature `macros`, `routine!` and `scene!` generate code for a topology or a scene of
//! the program's own.

#[cfg(feature = "macros")]
mod compiled;

#[cfg(feature = "macros")]
pub use compiled::CompiledScene;
pub use nboom_dynamics as dynamics;
pub use nboom_elements as elements;
pub use nboom_formulation as formulation;
pub use nboom_io as io;
pub use nboom_loads as loads;
#[cfg(feature = "macros")]
pub use nboom_macros::{routine, scene};
pub use nboom_model as model;
pub use nboom_ode as ode;
pub use nboom_scalar as scalar;
pub use nboom_sections as sections;
pub use nboom_sim as sim;
pub use nboom_strength as strength;
