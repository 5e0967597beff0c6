#![allow(unsafe_code, reason = "calls of functions compiled for processors that have more")]

use std::marker::PhantomData;

use crate::batch::{Eight, PortableEight};
use crate::{InstructionSet, Real, Routine};

type Prepare = fn(&[f64], &mut [f64]);

/// A routine on `f64`, in the form that is fastest on this processor.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// What an evaluation writes: `accelerations`, `equations` or `stresses`.
    pub result: &'static str,
    /// Topology, for example `S2_P`.
    pub topology: &'static str,
    /// Formulation, for example `articulated`; none of stresses.
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
    /// How many numbers an evaluation writes.
    pub outputs: usize,
    /// Instruction set in use: `avx512`, `avx2` or `portable`.
    pub instructions: &'static str,
    prepare: Prepare,
    evaluate: Evaluate<f64>,
}

impl Kernel {
    /// The routine `T` on this processor.
    pub fn of<T: Routine>() -> Self {
        Self::with::<T>(InstructionSet::of_this_processor())
            .expect("the processor has what it is found to have")
    }

    /// The routine `T` in code for an instruction set, if this processor has it.
    pub fn with<T: Routine>(instructions: InstructionSet) -> Option<Self> {
        Some(Self {
            result: T::RESULT,
            topology: T::TOPOLOGY,
            formulation: T::FORMULATION,
            pinned: T::PINNED,
            external: T::EXTERNAL,
            parameters: T::PARAMETERS,
            constants: T::CONSTANTS,
            coordinates: T::COORDINATES,
            outputs: T::OUTPUTS,
            instructions: instructions.name(),
            prepare: T::prepare::<f64>,
            evaluate: compiled::<OneState<T>>(instructions)?,
        })
    }

    /// Whether these parameters are finite numbers and what the routine takes for granted.
    pub fn accepts(&self, parameters: &[f64]) -> bool {
        parameters.len() == self.parameters
            && parameters.iter().all(|parameter| parameter.is_finite())
            && self.pinned.iter().all(|&(i, value)| parameters[i] == value)
    }

    /// Computes the constants that depend on parameters alone.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn prepare(&self, parameters: &[f64], constants: &mut [f64]) {
        (self.prepare)(parameters, constants);
    }

    /// Computes what the routine is for.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn evaluate(&self, constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
        (self.evaluate)(constants, coordinates, outputs);
    }
}

/// A routine on one state.
struct OneState<T>(PhantomData<T>);

impl<T: Routine> Compiled for OneState<T> {
    type Number = f64;

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn avx512(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::evaluate_packed::<crate::Avx512>(k, x, out);
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn avx2(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::evaluate_packed::<crate::Avx2>(k, x, out);
    }

    fn portable(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::evaluate::<f64>(k, x, out);
    }
}

/// An evaluation on constants and coordinates, with what it computes.
pub(crate) type Evaluate<N> = fn(&[N], &[N], &mut [N]);

/// An evaluation that has a form for each instruction set; to be inlined into a function that is
/// compiled for it.
pub(crate) trait Compiled {
    /// What slices are made of.
    type Number;

    #[cfg(target_arch = "x86_64")]
    fn avx512(k: &[Self::Number], x: &[Self::Number], out: &mut [Self::Number]);

    #[cfg(target_arch = "x86_64")]
    fn avx2(k: &[Self::Number], x: &[Self::Number], out: &mut [Self::Number]);

    fn portable(k: &[Self::Number], x: &[Self::Number], out: &mut [Self::Number]);
}

/// The evaluation in code for an instruction set, if this processor has it.
pub(crate) fn compiled<C: Compiled>(instructions: InstructionSet) -> Option<Evaluate<C::Number>> {
    if instructions > InstructionSet::of_this_processor() {
        return None;
    }
    match instructions {
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => Some(on_avx512::<C>),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => Some(on_avx2::<C>),
        _ => Some(C::portable),
    }
}

#[cfg(target_arch = "x86_64")]
fn on_avx512<C: Compiled>(k: &[C::Number], x: &[C::Number], out: &mut [C::Number]) {
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn inlined<C: Compiled>(k: &[C::Number], x: &[C::Number], out: &mut [C::Number]) {
        C::avx512(k, x, out);
    }
    // SAFETY: `compiled` hands this function out only where the features are there.
    unsafe { inlined::<C>(k, x, out) }
}

#[cfg(target_arch = "x86_64")]
fn on_avx2<C: Compiled>(k: &[C::Number], x: &[C::Number], out: &mut [C::Number]) {
    #[target_feature(enable = "avx2,fma")]
    fn inlined<C: Compiled>(k: &[C::Number], x: &[C::Number], out: &mut [C::Number]) {
        C::avx2(k, x, out);
    }
    // SAFETY: `compiled` hands this function out only where the features are there.
    unsafe { inlined::<C>(k, x, out) }
}

/// Work that is to be done in code for the vector instructions that the processor has.
pub trait Work {
    /// Does it; to be inlined, with all that it calls.
    fn carry_out(self);
}

/// Does `work` in code compiled for the vector instructions of this processor, of up to 256
/// bits, which pay for short loops too. Results are the same with and without.
pub fn vectorised<W: Work>(work: W) {
    #[cfg(target_arch = "x86_64")]
    if InstructionSet::of_this_processor() >= InstructionSet::Avx2 {
        #[target_feature(enable = "avx2,fma")]
        fn inlined<W: Work>(work: W) {
            work.carry_out();
        }
        // SAFETY: the processor has the features.
        return unsafe { inlined(work) };
    }
    work.carry_out();
}

/// Eight `f64` one after the other and nothing else, any of which may be any number.
///
/// # Safety
/// A type of another content or layout would be read from memory that holds [`Eight`].
pub(crate) unsafe trait EightNumbers: Real {}

// SAFETY: arrays of eight in all but name; pairs are `repr(C)`, registers of one field
// `repr(transparent)`.
unsafe impl EightNumbers for PortableEight {}
#[cfg(target_arch = "x86_64")]
// SAFETY: as above.
unsafe impl EightNumbers for crate::Pair<crate::Avx4> {}
#[cfg(target_arch = "x86_64")]
// SAFETY: as above.
unsafe impl EightNumbers for crate::Avx8 {}

/// The same numbers as scalars.
#[inline(always)]
pub(crate) fn as_registers<R: EightNumbers>(numbers: &[Eight]) -> &[R] {
    const { assert!(size_of::<R>() == size_of::<Eight>()) };
    const { assert!(align_of::<R>() <= align_of::<Eight>()) };
    // SAFETY: size and alignment are as just asserted, and `R` is eight numbers.
    unsafe { std::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) }
}

/// The same places as scalars.
#[inline(always)]
pub(crate) fn as_registers_mut<R: EightNumbers>(numbers: &mut [Eight]) -> &mut [R] {
    const { assert!(size_of::<R>() == size_of::<Eight>()) };
    const { assert!(align_of::<R>() <= align_of::<Eight>()) };
    // SAFETY: size and alignment are as just asserted, and `R` is eight numbers.
    unsafe { std::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), numbers.len()) }
}
