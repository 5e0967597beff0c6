use std::marker::PhantomData;

use crate::kernel::{Compiled, Evaluate, as_registers, as_registers_mut, compiled};
use crate::{InstructionSet, Pair, Routine};

/// A number of each of eight states, placed so that one load fills a register.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Eight(pub [f64; 8]);

impl Eight {
    /// The same number in every state.
    pub fn splat(value: f64) -> Self {
        Self([value; 8])
    }
}

/// Eight scalars without any vector instructions.
pub(crate) type PortableEight = Pair<Pair<Pair<f64>>>;

type Prepare = fn(&[Eight], &mut [Eight]);

/// A routine on eight states of one topology at once, in the form that is fastest on this
/// processor.
///
/// The numbers of the eight states lie side by side: the first [`Eight`] of the coordinates has
/// the first coordinate of each state. Each state has parameters of its own as well. Nothing
/// goes from one state to another. Results are those of [`Kernel`](crate::Kernel) to rounding:
/// products and sums are fused wherever the processor can, and sines come from a polynomial,
/// but sums over appendages may be in another order.
#[derive(Clone, Copy, Debug)]
pub struct Batch {
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
    evaluate: Evaluate<Eight>,
}

impl Batch {
    /// The routine `T` on this processor.
    pub fn of<T: Routine>() -> Self {
        Self::with::<T>(InstructionSet::of_this_processor())
            .expect("the processor has what it is found to have")
    }

    /// The routine `T` in code for an instruction set, if this processor has it.
    pub fn with<T: Routine>(instructions: InstructionSet) -> Option<Self> {
        Some(Self {
            topology: T::TOPOLOGY,
            formulation: T::FORMULATION,
            pinned: T::PINNED,
            external: T::EXTERNAL,
            parameters: T::PARAMETERS,
            constants: T::CONSTANTS,
            coordinates: T::COORDINATES,
            outputs: T::OUTPUTS,
            instructions: instructions.name(),
            prepare: |parameters, constants| {
                T::prepare::<PortableEight>(as_registers(parameters), as_registers_mut(constants));
            },
            evaluate: compiled::<EightStates<T>>(instructions)?,
        })
    }

    /// Whether the parameters of all eight states are finite numbers and what the routine takes for
    /// granted.
    pub fn accepts(&self, parameters: &[Eight]) -> bool {
        parameters.len() == self.parameters
            && parameters.iter().flat_map(|eight| eight.0).all(f64::is_finite)
            && self.pinned.iter().all(|&(i, value)| parameters[i] == Eight::splat(value))
    }

    /// Computes the constants that depend on parameters alone.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn prepare(&self, parameters: &[Eight], constants: &mut [Eight]) {
        (self.prepare)(parameters, constants);
    }

    /// Computes accelerations of the eight states.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn evaluate(&self, constants: &[Eight], coordinates: &[Eight], outputs: &mut [Eight]) {
        (self.evaluate)(constants, coordinates, outputs);
    }
}

/// A routine on eight states.
struct EightStates<T>(PhantomData<T>);

impl<T: Routine> Compiled for EightStates<T> {
    type Number = Eight;

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn avx512(k: &[Eight], x: &[Eight], out: &mut [Eight]) {
        use crate::Avx8;
        T::evaluate::<Avx8>(as_registers(k), as_registers(x), as_registers_mut(out));
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn avx2(k: &[Eight], x: &[Eight], out: &mut [Eight]) {
        use crate::Avx4;
        T::evaluate::<Pair<Avx4>>(as_registers(k), as_registers(x), as_registers_mut(out));
    }

    fn portable(k: &[Eight], x: &[Eight], out: &mut [Eight]) {
        T::evaluate::<PortableEight>(as_registers(k), as_registers(x), as_registers_mut(out));
    }
}
