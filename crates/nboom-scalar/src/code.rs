//! Functions of routines as they cross the border between programs: pointers, and the C calling
//! convention.
#![allow(unsafe_code, reason = "another compiler's functions can be called by C's rules only")]

use std::slice::{from_raw_parts, from_raw_parts_mut};

use crate::compiled::Compiled;
use crate::kernel::Numbers;
use crate::{InstructionSet, Routine};

/// [`Routine::prepare`] on parameters and constants.
type Prepare<N> = unsafe extern "C" fn(parameters: *const N, constants: *mut N);

/// [`Routine::evaluate`] on constants, coordinates and outputs.
type Evaluate<N> =
    unsafe extern "C" fn(constants: *const N, coordinates: *const N, outputs: *mut N);

/// The functions of a routine, and how many numbers are behind each pointer.
///
/// The sizes are its own, for those of a [`RoutineOn`](crate::RoutineOn) can be changed by whoever
/// has a copy.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Code<N> {
    pub(crate) sizes: Sizes,
    prepare: Prepare<N>,
    evaluate: Evaluate<N>,
}

/// How many numbers of each kind a routine reads and writes.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Sizes {
    pub(crate) parameters: usize,
    pub(crate) constants: usize,
    pub(crate) coordinates: usize,
    pub(crate) outputs: usize,
}

impl<N: Numbers> Code<N> {
    /// The code of a routine for an instruction set, if this processor has it.
    pub(crate) fn of<T: Routine>(instructions: InstructionSet) -> Option<Self> {
        let sizes = Sizes {
            parameters: T::PARAMETERS,
            constants: T::CONSTANTS,
            coordinates: T::COORDINATES,
            outputs: T::OUTPUTS,
        };
        let evaluate = compiled::<N::Forms<T>>(instructions)?;
        Some(Self { sizes, prepare: prepare::<N, T>, evaluate })
    }

    /// # Panics
    /// When a slice does not have the length that the sizes tell.
    #[inline]
    pub(crate) fn prepare(&self, parameters: &[N], constants: &mut [N]) {
        let Sizes { parameters: of_parameters, constants: of_constants, .. } = self.sizes;
        assert!(parameters.len() == of_parameters, "one value for each parameter");
        assert!(constants.len() == of_constants, "room for each constant");
        // SAFETY: the slices have the lengths of the routine whose function this is.
        unsafe { (self.prepare)(parameters.as_ptr(), constants.as_mut_ptr()) };
    }

    /// # Panics
    /// When a slice does not have the length that the sizes tell.
    #[inline]
    pub(crate) fn evaluate(&self, constants: &[N], coordinates: &[N], outputs: &mut [N]) {
        let Sizes { constants: of_constants, coordinates: of_coordinates, .. } = self.sizes;
        assert!(constants.len() == of_constants, "one value for each constant");
        assert!(coordinates.len() == of_coordinates, "one value for each coordinate");
        assert!(outputs.len() == self.sizes.outputs, "room for each output");
        let (constants, coordinates) = (constants.as_ptr(), coordinates.as_ptr());
        // SAFETY: the slices have the lengths of the routine whose function this is, and the
        // processor has what the function is compiled for, or there would be no `Code`.
        unsafe { (self.evaluate)(constants, coordinates, outputs.as_mut_ptr()) };
    }
}

/// # Safety
/// Behind the pointers are the routine's parameters, and room for its constants.
unsafe extern "C" fn prepare<N: Numbers, T: Routine>(parameters: *const N, constants: *mut N) {
    // SAFETY: as the caller vouches.
    let parameters = unsafe { from_raw_parts(parameters, T::PARAMETERS) };
    // SAFETY: as the caller vouches.
    let constants = unsafe { from_raw_parts_mut(constants, T::CONSTANTS) };
    N::prepare::<T>(parameters, constants);
}

/// The evaluation in code for an instruction set, if this processor has it.
fn compiled<C: Compiled>(instructions: InstructionSet) -> Option<Evaluate<C::Number>> {
    if instructions > InstructionSet::of_this_processor() {
        return None;
    }
    match instructions {
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => Some(on_avx512::<C>),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => Some(on_avx2::<C>),
        _ => Some(portable::<C>),
    }
}

/// Constants, coordinates and outputs behind pointers.
type Behind<'a, N> = (&'a [N], &'a [N], &'a mut [N]);

/// # Safety
/// Behind the pointers are the routine's constants, its coordinates, and room for its outputs that
/// nobody else uses.
#[inline(always)]
unsafe fn behind<'a, C: Compiled>(
    k: *const C::Number,
    x: *const C::Number,
    out: *mut C::Number,
) -> Behind<'a, C::Number> {
    // SAFETY: as the caller vouches.
    let k = unsafe { from_raw_parts(k, C::Routine::CONSTANTS) };
    // SAFETY: as the caller vouches.
    let x = unsafe { from_raw_parts(x, C::Routine::COORDINATES) };
    // SAFETY: as the caller vouches.
    (k, x, unsafe { from_raw_parts_mut(out, C::Routine::OUTPUTS) })
}

/// # Safety
/// As of [`behind`], and the processor has [`InstructionSet::Avx512`].
#[cfg(target_arch = "x86_64")]
unsafe extern "C" fn on_avx512<C: Compiled>(
    k: *const C::Number,
    x: *const C::Number,
    out: *mut C::Number,
) {
    // Slices as arguments tell the compiler that what is written is not what is read. Compiled for
    // the features as well, the outer function would take the inner one in, and on AVX2 a right side
    // of eight states then takes twice the time.
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn inlined<C: Compiled>(k: &[C::Number], x: &[C::Number], out: &mut [C::Number]) {
        // SAFETY: this function is compiled for the features, and called only where they are there.
        unsafe { C::avx512(k, x, out) };
    }
    // SAFETY: as the caller vouches.
    let (k, x, out) = unsafe { behind::<C>(k, x, out) };
    // SAFETY: as the caller vouches.
    unsafe { inlined::<C>(k, x, out) };
}

/// # Safety
/// As of [`behind`], and the processor has [`InstructionSet::Avx2`].
#[cfg(target_arch = "x86_64")]
unsafe extern "C" fn on_avx2<C: Compiled>(
    k: *const C::Number,
    x: *const C::Number,
    out: *mut C::Number,
) {
    #[target_feature(enable = "avx2,fma")]
    fn inlined<C: Compiled>(k: &[C::Number], x: &[C::Number], out: &mut [C::Number]) {
        // SAFETY: this function is compiled for the features, and called only where they are there.
        unsafe { C::avx2(k, x, out) };
    }
    // SAFETY: as the caller vouches.
    let (k, x, out) = unsafe { behind::<C>(k, x, out) };
    // SAFETY: as the caller vouches.
    unsafe { inlined::<C>(k, x, out) };
}

/// # Safety
/// As of [`behind`].
unsafe extern "C" fn portable<C: Compiled>(
    k: *const C::Number,
    x: *const C::Number,
    out: *mut C::Number,
) {
    // SAFETY: as the caller vouches.
    let (k, x, out) = unsafe { behind::<C>(k, x, out) };
    C::portable(k, x, out);
}
