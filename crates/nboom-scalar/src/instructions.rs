/// What vector instructions code is compiled for; a processor that has one has all smaller ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// None beyond what every processor of the kind has.
    Portable,
    /// AVX2 with fused products and sums.
    Avx2,
    /// AVX-512 with its instructions on doublewords, quadwords and shorter registers.
    Avx512,
}

impl InstructionSet {
    /// The largest that this processor has.
    #[cfg(target_arch = "x86_64")]
    pub fn of_this_processor() -> Self {
        if !(is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")) {
            Self::Portable
        } else if is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
        {
            Self::Avx512
        } else {
            Self::Avx2
        }
    }

    /// The largest that this processor has.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn of_this_processor() -> Self {
        Self::Portable
    }

    /// `avx512`, `avx2` or `portable`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}
