use crate::Pack;

/// The packs that a kind of processor takes side by side.
///
/// Registers may be named only in code that runs where the processor has them, so the kinds that
/// have some are this crate's own: [`Kernel`](crate::Kernel) chooses among them.
pub trait Isa {
    /// The most numbers that one register holds; 4 or 8.
    const WIDEST: usize;
    /// One number.
    type One: Pack<f64>;
    /// Two numbers.
    type Two: Pack<f64>;
    /// Four numbers.
    type Four: Pack<f64>;
    /// Eight numbers.
    type Eight: Pack<f64>;
}

/// AVX2 with fused products and sums.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2;

#[cfg(target_arch = "x86_64")]
impl Isa for Avx2 {
    const WIDEST: usize = 4;
    type One = crate::Fused;
    type Two = crate::AvxHalf;
    type Four = crate::Avx4;
    type Eight = crate::Several<8>;
}

/// AVX-512.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512;

#[cfg(target_arch = "x86_64")]
impl Isa for Avx512 {
    const WIDEST: usize = 8;
    type One = crate::Fused;
    type Two = crate::AvxHalf;
    type Four = crate::Avx4;
    type Eight = crate::Avx8;
}
