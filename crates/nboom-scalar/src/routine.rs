use crate::{Isa, Real};

/// Version of what generated code and its callers agree on; code for another one does not
/// compile.
pub const CONTRACT: u32 = 5;

/// What generated code implements: accelerations of one topology by one formulation, the
/// equations that the formulation solves for them, what causes given accelerations, the right side of the differential equations of a
/// mode, or the loads and stresses of one scene.
///
/// Parameters are prepared once; an evaluation then allocates nothing and does not branch.
/// The order of all numbers is that of `nboom_formulation::Layout`; of right sides that of
/// `nboom_formulation::RightSideLayout`, of stresses that of `nboom_loads`.
pub trait Routine {
    /// What an evaluation writes: `accelerations`, `equations`, `inverse_dynamics`, `right_side` or `stresses`.
    const RESULT: &'static str;
    /// Topology, for example `S2_P`.
    const TOPOLOGY: &'static str;
    /// Formulation, for example `articulated`; none of stresses.
    const FORMULATION: &'static str;
    /// What the routine assumes: parameter numbers and their values.
    const ASSUMPTIONS: &'static [(usize, f64)];
    /// Whether an external wrench on the main body is taken into account.
    const EXTERNAL: bool;
    /// How many numbers describe a satellite.
    const PARAMETERS: usize;
    /// How many prepared constants there are.
    const CONSTANTS: usize;
    /// How many numbers describe a state.
    const COORDINATES: usize;
    /// How many numbers an evaluation writes.
    const OUTPUTS: usize;
    /// Whether [`evaluate_packed`](Self::evaluate_packed) takes equal appendages side by side, so that one state
    /// fills registers.
    const IN_PACKS: bool = false;

    /// Computes the constants that depend on parameters alone.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    fn prepare<R: Real>(parameters: &[R], constants: &mut [R]);

    /// Evaluates on any scalar.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    fn evaluate<R: Real>(constants: &[R], coordinates: &[R], outputs: &mut [R]);

    /// Evaluates one state, equal appendages side by side in the packs of `I`.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    fn evaluate_packed<I: Isa>(constants: &[f64], coordinates: &[f64], outputs: &mut [f64]);
}

/// Values at places: [`Routine::ASSUMPTIONS`] as generated code writes it.
pub const fn assumed<const N: usize>(places: [usize; N], values: [f64; N]) -> [(usize, f64); N] {
    let mut all = [(0, 0.0); N];
    let mut i = 0;
    while i < N {
        all[i] = (places[i], values[i]);
        i += 1;
    }
    all
}
