//! Accelerations of the satellite of the scene /*SCENE*/, topology /*TOPOLOGY*/.
//!
//! Written by nboom /*VERSION*/: edit the scene or the options of `nboom generate`, not this crate.
//! `CERTIFICATE.json` says how far each formulation is from the truth before it is compiled, and
//! `cargo test` measures the compiled code.
//!
//! | routine | topology | gives | formulation | level | takes for granted |
//! | --- | --- | --- | --- | --- | --- |
/*ROUTINE_TABLE*///!
//! # Use
//!
//! Constants are prepared once for each set of parameters. An evaluation then allocates nothing.
//!
//! ```
//! use /*CRATE*/::{HINGES, kernels, parameters};
//!
//! let kernel = &kernels()[0];
//! assert!(kernel.accepts(parameters()));
//! let mut constants = vec![0.0; kernel.constants];
//! kernel.prepare(parameters(), &mut constants);
//!
//! let mut state = vec![0.0; kernel.coordinates];
//! state[..3].copy_from_slice(&[1.0, 0.1, 0.0]);
//! for hinge in &HINGES {
//!     state[hinge.angle] = 0.5;
//!     state[hinge.rate] = 0.1;
//!     state[hinge.torque] = 0.0;
//! }
//! let mut accelerations = vec![0.0; kernel.outputs];
//! kernel.evaluate(&constants, &state, &mut accelerations);
//! assert!(accelerations.iter().all(|number| number.is_finite()));
//! ```
//!
//! # Numbers
//!
//! All are in the scene's own units; angles are radians. A **state** is ω (3 numbers, main-body
//! axes), moment and force on the main body about O (6 numbers, main-body axes; taken to be zero by
//! a routine that is not `EXTERNAL`), then angle, rate and torque of each hinge, where [`HINGES`]
//! says. **Accelerations** are ω̇ and a_O (6 numbers, main-body axes; without gravity), then the
//! acceleration of each hinge.
/*STRESSES*///!
//! # Other parts of nboom
//!
//! [`Kernel`] is this crate's own, in [`nboom_scalar`], so that crates of several scenes can be in
//! one program. Simulations of the crate `nboom` take routines that its macros and build scripts
//! generate, not these.
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
/*EQUATIONS_FUNCTION*/
const PARAMETERS: [f64; /*PARAMETER_COUNT*/] = [
/*PARAMETER_LIST*/];
