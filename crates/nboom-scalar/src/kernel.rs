#![allow(unsafe_code, reason = "calls of functions compiled for processors that have more")]

use crate::Routine;

type Prepare = fn(&[f64], &mut [f64]);
type Evaluate = fn(&[f64], &[f64], &mut [f64]);

/// A routine on `f64`, in the form that is fastest on this processor.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// Topology, for example `S2_P`.
    pub topology: &'static str,
    /// Formulation, for example `articulated`.
    pub formulation: &'static str,
    /// What the routine takes for granted: parameter numbers and their values.
    pub pinned: &'static [(usize, f64)],
    /// Whether an external wrench on the main body is taken into account.
    pub external: bool,
    /// How many numbers describe a satellite.
    pub parameters: usize,
    /// How many prepared constants there are.
    pub constants: usize,
    /// How many numbers describe a state.
    pub coordinates: usize,
    /// How many numbers accelerations are.
    pub outputs: usize,
    /// Instruction set in use: `avx512`, `avx2` or `portable`.
    pub instructions: &'static str,
    prepare: Prepare,
    evaluate: Evaluate,
}

impl Kernel {
    /// The routine `T` on this processor.
    pub fn of<T: Routine>() -> Self {
        let (instructions, evaluate) = fastest::<T>();
        Self {
            topology: T::TOPOLOGY,
            formulation: T::FORMULATION,
            pinned: T::PINNED,
            external: T::EXTERNAL,
            parameters: T::PARAMETERS,
            constants: T::CONSTANTS,
            coordinates: T::COORDINATES,
            outputs: T::OUTPUTS,
            instructions,
            prepare: T::prepare::<f64>,
            evaluate,
        }
    }

    /// Whether these parameters are what the routine takes for granted.
    pub fn accepts(&self, parameters: &[f64]) -> bool {
        parameters.len() == self.parameters
            && self.pinned.iter().all(|&(i, value)| parameters[i] == value)
    }

    /// Computes the constants that depend on parameters alone.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn prepare(&self, parameters: &[f64], constants: &mut [f64]) {
        (self.prepare)(parameters, constants);
    }

    /// Computes accelerations.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn evaluate(&self, constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
        (self.evaluate)(constants, coordinates, outputs);
    }
}

#[cfg(target_arch = "x86_64")]
fn fastest<T: Routine>() -> (&'static str, Evaluate) {
    let fused = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    if fused
        && is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
    {
        ("avx512", on_avx512::<T>)
    } else if fused {
        ("avx2", on_avx2::<T>)
    } else {
        ("portable", T::evaluate::<f64>)
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn fastest<T: Routine>() -> (&'static str, Evaluate) {
    ("portable", T::evaluate::<f64>)
}

#[cfg(target_arch = "x86_64")]
fn on_avx512<T: Routine>(constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn compiled<T: Routine>(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::evaluate_packed::<crate::Avx512>(k, x, out);
    }
    // SAFETY: `fastest` hands this function out only where the features are there.
    unsafe { compiled::<T>(constants, coordinates, outputs) }
}

#[cfg(target_arch = "x86_64")]
fn on_avx2<T: Routine>(constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
    #[target_feature(enable = "avx2,fma")]
    fn compiled<T: Routine>(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::evaluate_packed::<crate::Avx2>(k, x, out);
    }
    // SAFETY: `fastest` hands this function out only where the features are there.
    unsafe { compiled::<T>(constants, coordinates, outputs) }
}
