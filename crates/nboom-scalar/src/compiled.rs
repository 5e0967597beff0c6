#![allow(unsafe_code, reason = "calls of functions compiled for processors that have more")]

use std::marker::PhantomData;

use crate::batch::{Eight, PortableEight, one_by_one};
use crate::{InstructionSet, Real, Routine};

/// An evaluation that has a form for each instruction set; to be inlined into a function that is
/// compiled for it.
pub trait Compiled {
    /// What slices are made of.
    type Number;

    /// The form for AVX-512.
    ///
    /// # Safety
    /// The processor has [`InstructionSet::Avx512`].
    #[cfg(target_arch = "x86_64")]
    unsafe fn avx512(k: &[Self::Number], x: &[Self::Number], out: &mut [Self::Number]);

    /// The form for AVX2.
    ///
    /// # Safety
    /// The processor has [`InstructionSet::Avx2`].
    #[cfg(target_arch = "x86_64")]
    unsafe fn avx2(k: &[Self::Number], x: &[Self::Number], out: &mut [Self::Number]);

    /// The form for any processor.
    fn portable(k: &[Self::Number], x: &[Self::Number], out: &mut [Self::Number]);
}

/// What is done state by state on any processor, so that it is compiled once for [`OneState`] and [`EightStates`].
pub(crate) trait Portable: Routine {
    #[inline(never)]
    fn prepare_for_one(parameters: &[f64], constants: &mut [f64]) {
        Self::prepare::<f64>(parameters, constants);
    }

    #[inline(never)]
    fn portable_on_one(k: &[f64], x: &[f64], out: &mut [f64]) {
        Self::evaluate::<f64>(k, x, out);
    }
}

impl<T: Routine> Portable for T {}

/// A routine on one state.
#[derive(Debug)]
pub struct OneState<T>(PhantomData<T>);

impl<T: Routine> Compiled for OneState<T> {
    type Number = f64;

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn avx512(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::evaluate_packed::<crate::Avx512>(k, x, out);
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn avx2(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::evaluate_packed::<crate::Avx2>(k, x, out);
    }

    #[inline(always)]
    fn portable(k: &[f64], x: &[f64], out: &mut [f64]) {
        T::portable_on_one(k, x, out);
    }
}

/// A routine on eight states.
#[derive(Debug)]
pub struct EightStates<T>(PhantomData<T>);

impl<T: Routine> Compiled for EightStates<T> {
    type Number = Eight;

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn avx512(k: &[Eight], x: &[Eight], out: &mut [Eight]) {
        use crate::Avx8;
        T::evaluate::<Avx8>(as_registers(k), as_registers(x), as_registers_mut(out));
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    unsafe fn avx2(k: &[Eight], x: &[Eight], out: &mut [Eight]) {
        use crate::TwoAvx4;
        T::evaluate::<TwoAvx4>(as_registers(k), as_registers(x), as_registers_mut(out));
    }

    fn portable(k: &[Eight], x: &[Eight], out: &mut [Eight]) {
        // Code for all eight would be eight times as long.
        one_by_one([k, x], out, |[k, x], out| T::portable_on_one(k, x, out));
    }
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

/// Work on numbers of eight states, each of which stands in one scalar.
pub trait WorkOnEight {
    /// What it finds.
    type Output;

    /// Does it; to be inlined, with all that it calls.
    fn carry_out<R: EightNumbers>(self) -> Self::Output;
}

/// Does `work` in the registers of this processor, products and sums fused where it can. Results do
/// not depend on how many numbers a register holds.
pub fn in_registers<W: WorkOnEight>(work: W) -> W::Output {
    in_vector_registers(work).unwrap_or_else(|work| work.carry_out::<PortableEight>())
}

/// Does `work` in the vector registers of this processor, or gives it back where there are none.
///
/// Long work does not pay there, and its code would be eight times as long.
///
/// # Errors
/// The work, when it is not done.
pub fn in_vector_registers<W: WorkOnEight>(work: W) -> Result<W::Output, W> {
    #[cfg(target_arch = "x86_64")]
    match InstructionSet::of_this_processor() {
        InstructionSet::Avx512 => {
            #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
            fn inlined<W: WorkOnEight>(work: W) -> W::Output {
                work.carry_out::<crate::Avx8>()
            }
            // SAFETY: the processor has the features.
            return Ok(unsafe { inlined(work) });
        }
        InstructionSet::Avx2 => {
            #[target_feature(enable = "avx2,fma")]
            fn inlined<W: WorkOnEight>(work: W) -> W::Output {
                work.carry_out::<crate::TwoAvx4>()
            }
            // SAFETY: the processor has the features.
            return Ok(unsafe { inlined(work) });
        }
        InstructionSet::Portable => {}
    }
    Err(work)
}

/// Eight `f64` one after the other and nothing else, any of which may be any number.
///
/// # Safety
/// A type of another content or layout would be read from memory that holds [`Eight`].
pub unsafe trait EightNumbers: Real + Send + Sync {
    /// Reads them.
    #[inline(always)]
    fn load(from: &Eight) -> Self {
        as_registers(std::slice::from_ref(from))[0]
    }

    /// Writes them.
    #[inline(always)]
    fn store(self, to: &mut Eight) {
        as_registers_mut(std::slice::from_mut(to))[0] = self;
    }

    /// Reads many in their place.
    #[inline(always)]
    fn all(of: &[Eight]) -> &[Self] {
        as_registers(of)
    }

    /// Many, to be written in their place.
    #[inline(always)]
    fn all_mut(of: &mut [Eight]) -> &mut [Self] {
        as_registers_mut(of)
    }
}

// SAFETY: pairs of pairs of pairs of numbers, all `repr(C)`.
unsafe impl EightNumbers for PortableEight {}
#[cfg(target_arch = "x86_64")]
// SAFETY: two registers of four numbers, `repr(C)` and without room between them.
unsafe impl EightNumbers for crate::TwoAvx4 {}
#[cfg(target_arch = "x86_64")]
// SAFETY: one register of eight numbers, `repr(transparent)`.
unsafe impl EightNumbers for crate::Avx8 {}

/// Reads numbers as scalars in registers.
#[inline(always)]
pub(crate) fn as_registers<R: EightNumbers>(numbers: &[Eight]) -> &[R] {
    const { assert!(size_of::<R>() == size_of::<Eight>()) };
    const { assert!(align_of::<R>() <= align_of::<Eight>()) };
    // SAFETY: size and alignment are as just asserted, and `R` is eight numbers.
    unsafe { std::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) }
}

/// Reads places of numbers as places of scalars in registers.
#[inline(always)]
pub(crate) fn as_registers_mut<R: EightNumbers>(numbers: &mut [Eight]) -> &mut [R] {
    const { assert!(size_of::<R>() == size_of::<Eight>()) };
    const { assert!(align_of::<R>() <= align_of::<Eight>()) };
    // SAFETY: size and alignment are as just asserted, and `R` is eight numbers.
    unsafe { std::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), numbers.len()) }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;

    /// Sums of products, and a function of each number.
    struct Sums<'a>(&'a [Eight; 3]);

    impl WorkOnEight for Sums<'_> {
        type Output = Eight;

        #[inline(always)]
        fn carry_out<R: EightNumbers>(self) -> Eight {
            let [a, b, c] = self.0.map(|numbers| R::load(&numbers));
            let mut found = Eight::default();
            (a.mul_add(b, c) / b - (a * a).sqrt()).store(&mut found);
            found
        }
    }

    #[target_feature(enable = "avx2,fma")]
    fn in_two_registers(work: Sums<'_>) -> Eight {
        work.carry_out::<crate::TwoAvx4>()
    }

    #[test]
    fn results_do_not_depend_on_how_many_numbers_a_register_holds() {
        let numbers = |scale: f64| Eight(std::array::from_fn(|i| scale * (0.3 + i as f64)));
        let all = [numbers(0.7), numbers(-1.9), numbers(13.0)];
        let found = in_registers(Sums(&all));
        if InstructionSet::of_this_processor() >= InstructionSet::Avx2 {
            // SAFETY: the processor has the features.
            assert_eq!(unsafe { in_two_registers(Sums(&all)) }, found);
        }
        for lane in 0..8 {
            let [a, b, c] = all.map(|of_all| of_all.0[lane]);
            let expected = (a * b + c) / b - a;
            assert!((found.0[lane] - expected).abs() < 1e-14 * expected.abs().max(c.abs()));
        }
    }
}
