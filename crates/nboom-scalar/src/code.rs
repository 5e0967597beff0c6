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
        Some(Self { sizes, prepare: T::prepare_behind::<N>, evaluate: T::compiled(instructions)? })
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

/// The functions of a routine, for callers that have pointers.
///
/// rustc compiles a method with the module of its type, and modules side by side. Free functions of all
/// routines, a hundred of them, it would compile with this module, on one core.
trait Functions: Routine + Sized {
    /// The evaluation in code for an instruction set, if this processor has it.
    fn compiled<N: Numbers>(instructions: InstructionSet) -> Option<Evaluate<N>> {
        if instructions > InstructionSet::of_this_processor() {
            return None;
        }
        match instructions {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => Some(Self::on_avx512),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => Some(Self::on_avx2),
            _ => Some(Self::portable),
        }
    }

    /// # Safety
    /// Behind the pointers are the routine's parameters, and room for its constants.
    unsafe extern "C" fn prepare_behind<N: Numbers>(parameters: *const N, constants: *mut N) {
        // SAFETY: as the caller vouches.
        let parameters = unsafe { from_raw_parts(parameters, Self::PARAMETERS) };
        // SAFETY: as the caller vouches.
        let constants = unsafe { from_raw_parts_mut(constants, Self::CONSTANTS) };
        N::prepare::<Self>(parameters, constants);
    }

    /// # Safety
    /// As of [`behind`](Self::behind), and the processor has [`InstructionSet::Avx512`].
    #[cfg(target_arch = "x86_64")]
    unsafe extern "C" fn on_avx512<N: Numbers>(k: *const N, x: *const N, out: *mut N) {
        // SAFETY: as the caller vouches.
        let (k, x, out) = unsafe { Self::behind(k, x, out) };
        // SAFETY: as the caller vouches.
        unsafe { Self::slices_on_avx512(k, x, out) };
    }

    // Slices as arguments tell the compiler that what is written is not what is read. Compiled for the
    // features as well, the function with pointers would take the one with slices in, and on AVX2 a right
    // side of eight states then takes twice the time.

    /// The evaluation on slices, in code for AVX-512.
    ///
    /// # Safety
    /// The processor has [`InstructionSet::Avx512`].
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    unsafe fn slices_on_avx512<N: Numbers>(k: &[N], x: &[N], out: &mut [N]) {
        // SAFETY: as the caller vouches.
        unsafe { N::Forms::<Self>::avx512(k, x, out) };
    }

    /// # Safety
    /// As of [`behind`](Self::behind), and the processor has [`InstructionSet::Avx2`].
    #[cfg(target_arch = "x86_64")]
    unsafe extern "C" fn on_avx2<N: Numbers>(k: *const N, x: *const N, out: *mut N) {
        // SAFETY: as the caller vouches.
        let (k, x, out) = unsafe { Self::behind(k, x, out) };
        // SAFETY: as the caller vouches.
        unsafe { Self::slices_on_avx2(k, x, out) };
    }

    /// The evaluation on slices, in code for AVX2.
    ///
    /// # Safety
    /// The processor has [`InstructionSet::Avx2`].
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn slices_on_avx2<N: Numbers>(k: &[N], x: &[N], out: &mut [N]) {
        // SAFETY: as the caller vouches.
        unsafe { N::Forms::<Self>::avx2(k, x, out) };
    }

    /// # Safety
    /// As of [`behind`](Self::behind).
    unsafe extern "C" fn portable<N: Numbers>(k: *const N, x: *const N, out: *mut N) {
        // SAFETY: as the caller vouches.
        let (k, x, out) = unsafe { Self::behind(k, x, out) };
        N::Forms::<Self>::portable(k, x, out);
    }

    /// # Safety
    /// Behind the pointers are the routine's constants, its coordinates, and room for its outputs that
    /// nobody else uses.
    #[inline(always)]
    unsafe fn behind<'a, N: Numbers>(k: *const N, x: *const N, out: *mut N) -> Behind<'a, N> {
        // SAFETY: as the caller vouches.
        let k = unsafe { from_raw_parts(k, Self::CONSTANTS) };
        // SAFETY: as the caller vouches.
        let x = unsafe { from_raw_parts(x, Self::COORDINATES) };
        // SAFETY: as the caller vouches.
        (k, x, unsafe { from_raw_parts_mut(out, Self::OUTPUTS) })
    }
}

impl<T: Routine> Functions for T {}

/// Constants, coordinates and outputs behind pointers.
type Behind<'a, N> = (&'a [N], &'a [N], &'a mut [N]);
