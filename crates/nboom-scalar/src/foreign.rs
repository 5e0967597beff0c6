//! Routines of a library that another program loads.
//!
//! Program and library may come from different compilers, so nothing but C's layouts and calls goes
//! from one to the other: a [`ForeignTable`], behind a pointer.
#![allow(unsafe_code, reason = "what another compiler has laid out is read through pointers only")]

use std::error::Error;
use std::fmt;
use std::slice::from_raw_parts;
use std::str::from_utf8_unchecked;

use crate::code::Code;
use crate::{Batch, CONTRACT, Eight, Kernel, Numbers, RoutineOn};

/// Version of the layout of a table and of all that it has: any change counts on.
const LAYOUT: u32 = 2;

/// The first number of a table: a mark, the layout, and what generated code and callers agree on.
const ABI: u64 = (0x6e62_6f6f << 32) | ((LAYOUT as u64) << 16) | CONTRACT as u64;

const _: () = assert!(LAYOUT < 1 << 16 && CONTRACT < 1 << 16, "each has its own digits");
const _: () = assert!(size_of::<Eight>() == 64 && align_of::<Eight>() == 64, "a line of a cache");

/// The routines of a library, in a layout that every compiler agrees on.
#[derive(Debug)]
#[repr(C)]
pub struct ForeignTable {
    /// Stands first in every version.
    abi: u64,
    kernels: Many<ForeignRoutine<f64>>,
    batches: Many<ForeignRoutine<Eight>>,
}

/// What stands one after the other and stays for ever.
#[derive(Debug)]
#[repr(C)]
struct Many<T> {
    first: *const T,
    count: usize,
}

/// A [`RoutineOn`] in a layout that every compiler agrees on.
#[derive(Debug)]
#[repr(C)]
struct ForeignRoutine<N> {
    result: Many<u8>,
    topology: Many<u8>,
    formulation: Many<u8>,
    instructions: Many<u8>,
    assumptions: Many<Assumption>,
    external: bool,
    in_packs: bool,
    code: Code<N>,
}

/// A parameter number and its value.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct Assumption {
    parameter: usize,
    value: f64,
}

/// The table is not of the version that this program reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignError {
    /// The first number of the table.
    pub found: u64,
    /// The number that this program reads.
    pub expected: u64,
}

impl fmt::Display for ForeignError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { found, expected } = self;
        write!(f, "the table of routines has the number {found:#x}, {expected:#x} is expected")
    }
}

impl Error for ForeignError {}

impl ForeignTable {
    /// The table of these routines, for the library's side; it stays for ever.
    pub fn of(kernels: &'static [Kernel], batches: &'static [Batch]) -> &'static Self {
        let (kernels, batches) = (Many::of(routines(kernels)), Many::of(routines(batches)));
        Box::leak(Box::new(Self { abi: ABI, kernels, batches }))
    }

    /// The routines of a table, for the side that has loaded the library; they stay for ever.
    ///
    /// Nothing but the number is read before it is known to be right.
    ///
    /// # Errors
    /// [`ForeignError`] when the table is of another version. No table at all has the number zero.
    ///
    /// # Safety
    /// The pointer is null, or that of a table by [`of`](Self::of) of any version, in a library that
    /// is never closed and for the processor that this program runs on.
    pub unsafe fn routines(
        table: *const Self,
    ) -> Result<(&'static [Kernel], &'static [Batch]), ForeignError> {
        // SAFETY: the number stands first in every version.
        let found = if table.is_null() { 0 } else { unsafe { table.cast::<u64>().read() } };
        if found != ABI {
            return Err(ForeignError { found, expected: ABI });
        }
        // SAFETY: the number is right, so this is a table of this layout, which stays.
        let table: &'static Self = unsafe { &*table };
        // SAFETY: `of` has made all that the table has.
        Ok(unsafe { (table.kernels.routines(), table.batches.routines()) })
    }
}

fn routines<N: Numbers>(all: &'static [RoutineOn<N>]) -> &'static [ForeignRoutine<N>] {
    all.iter().map(ForeignRoutine::of).collect::<Vec<_>>().leak()
}

impl<T> Many<T> {
    fn of(all: &'static [T]) -> Self {
        Self { first: all.as_ptr(), count: all.len() }
    }

    /// # Safety
    /// [`of`](Self::of) has made it, in this program or in a library that is never closed.
    unsafe fn all(&self) -> &'static [T] {
        // SAFETY: pointer and length are those of a slice that stays for ever.
        unsafe { from_raw_parts(self.first, self.count) }
    }
}

impl Many<u8> {
    /// # Safety
    /// As of [`all`](Self::all), and the bytes are those of a string.
    unsafe fn text(&self) -> &'static str {
        // SAFETY: as the caller vouches.
        unsafe { from_utf8_unchecked(self.all()) }
    }
}

impl<N: Numbers> Many<ForeignRoutine<N>> {
    /// # Safety
    /// As of [`all`](Self::all), and [`ForeignRoutine::of`] has made each.
    unsafe fn routines(&self) -> &'static [RoutineOn<N>] {
        // SAFETY: as the caller vouches.
        let all = unsafe { self.all() };
        // SAFETY: as the caller vouches.
        all.iter().map(|routine| unsafe { routine.routine() }).collect::<Vec<_>>().leak()
    }
}

impl<N: Numbers> ForeignRoutine<N> {
    fn of(routine: &RoutineOn<N>) -> Self {
        let text = |text: &'static str| Many::of(text.as_bytes());
        let assumption = |&(parameter, value)| Assumption { parameter, value };
        let assumptions: Vec<Assumption> = routine.assumptions.iter().map(assumption).collect();
        Self {
            result: text(routine.result),
            topology: text(routine.topology),
            formulation: text(routine.formulation),
            instructions: text(routine.instructions),
            assumptions: Many::of(assumptions.leak()),
            external: routine.external,
            in_packs: routine.in_packs,
            code: routine.code,
        }
    }

    /// # Safety
    /// [`of`](Self::of) has made it, in this program or in a library that is never closed.
    unsafe fn routine(&self) -> RoutineOn<N> {
        // SAFETY: `of` has made them of slices.
        let assumptions = unsafe { self.assumptions.all() };
        let assumptions = assumptions.iter().map(|a| (a.parameter, a.value)).collect::<Vec<_>>();
        let sizes = self.code.sizes;
        RoutineOn {
            // SAFETY: `of` has made it of a string.
            result: unsafe { self.result.text() },
            // SAFETY: as above.
            topology: unsafe { self.topology.text() },
            // SAFETY: as above.
            formulation: unsafe { self.formulation.text() },
            assumptions: assumptions.leak(),
            external: self.external,
            parameters: sizes.parameters,
            constants: sizes.constants,
            coordinates: sizes.coordinates,
            outputs: sizes.outputs,
            in_packs: self.in_packs,
            // SAFETY: as above.
            instructions: unsafe { self.instructions.text() },
            code: self.code,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InstructionSet, Isa, Real, Routine};

    /// A turn and a fused sum of two numbers.
    struct Turned;

    impl Routine for Turned {
        const RESULT: &'static str = "accelerations";
        const TOPOLOGY: &'static str = "M";
        const FORMULATION: &'static str = "articulated";
        const ASSUMPTIONS: &'static [(usize, f64)] = &[(1, 0.25)];
        const EXTERNAL: bool = true;
        const PARAMETERS: usize = 2;
        const CONSTANTS: usize = 1;
        const COORDINATES: usize = 3;
        const OUTPUTS: usize = 2;
        const IN_PACKS: bool = true;

        fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) {
            constants[0] = parameters[0] / parameters[1];
        }

        #[inline(always)]
        fn evaluate<R: Real>(k: &[R], x: &[R], out: &mut [R]) {
            let (sin, cos) = x[2].sin_cos();
            out[0] = x[0].mul_add(cos, k[0] * x[1] * sin);
            out[1] = (x[1] * x[1] + k[0]).sqrt();
        }

        #[inline(always)]
        fn evaluate_packed<I: Isa>(k: &[f64], x: &[f64], out: &mut [f64]) {
            Self::evaluate::<f64>(k, x, out);
        }
    }

    /// In code for each instruction set that the processor has.
    fn in_all_code<N: Numbers>() -> &'static [RoutineOn<N>] {
        let sets = [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512];
        sets.into_iter().filter_map(RoutineOn::with::<Turned>).collect::<Vec<_>>().leak()
    }

    fn results<N: Numbers>(routine: &RoutineOn<N>) -> [N; 2] {
        let parameters = [0.3, 0.25].map(N::splat);
        assert!(routine.accepts(&parameters));
        let mut constants = [N::splat(0.0)];
        routine.prepare(&parameters, &mut constants);
        let mut outputs = [N::splat(0.0); 2];
        routine.evaluate(&constants, &[1.7, -0.6, 0.9].map(N::splat), &mut outputs);
        outputs
    }

    fn compare<N: Numbers + fmt::Debug>(direct: &[RoutineOn<N>], loaded: &[RoutineOn<N>]) {
        assert_eq!(direct.len(), loaded.len());
        for (direct, loaded) in direct.iter().zip(loaded) {
            assert!(direct.is_of_same_routine(loaded), "{direct:?} {loaded:?}");
            assert_eq!(direct.instructions, loaded.instructions);
            assert!(direct.in_packs && loaded.in_packs);
            assert_eq!(results(direct), results(loaded));
        }
    }

    #[test]
    fn routines_by_way_of_a_table_give_the_same_bits() {
        let (kernels, batches) = (in_all_code(), in_all_code());
        let table = ForeignTable::of(kernels, batches);
        // SAFETY: the table was just made.
        let loaded = unsafe { ForeignTable::routines(table) }.expect("it is of this version");
        compare(kernels, loaded.0);
        compare(batches, loaded.1);
    }

    #[test]
    fn a_table_of_another_version_is_refused_by_its_number() {
        // Nothing stands behind the number.
        let number = Box::new(ABI + (1 << 16));
        let refused = |table: *const u64| {
            // SAFETY: the pointer is null, or that of the first number of some version.
            unsafe { ForeignTable::routines(table.cast()) }.expect_err("of another version")
        };
        let other = refused(&raw const *number);
        assert_eq!(other, ForeignError { found: *number, expected: ABI });
        assert!(other.to_string().contains(&format!("{:#x}", *number)), "{other}");
        assert_eq!(refused(std::ptr::null()).found, 0);
    }

    #[test]
    #[should_panic(expected = "room for each output")]
    fn changed_sizes_do_not_let_functions_write_beyond_a_slice() {
        let mut kernel = Kernel::of::<Turned>();
        kernel.outputs = 1;
        kernel.evaluate(&[1.2], &[1.7, -0.6, 0.9], &mut [0.0]);
    }
}
