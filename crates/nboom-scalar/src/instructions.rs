use std::sync::OnceLock;

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

/// Whether nothing is optimised. Work on registers is inlined as a whole; each value of it then has a place of its
/// own on the stack, which runs out of megabytes.
const UNOPTIMISED: bool = match option_env!("NBOOM_OPT_LEVEL") {
    Some(level) => matches!(level.as_bytes(), b"0"),
    None => false,
};

impl InstructionSet {
    /// All, the smallest first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// A variable of the environment that keeps code from larger sets than the one that it names, so that
    /// they can be compared on one processor. It is read once.
    pub const VARIABLE: &'static str = "NBOOM_INSTRUCTIONS";

    /// The largest that this processor has, or the one that [`VARIABLE`](Self::VARIABLE) names if that is
    /// smaller. Compiled without optimisation, only the portable one is used.
    pub fn of_this_processor() -> Self {
        static FOUND: OnceLock<InstructionSet> = OnceLock::new();
        *FOUND.get_or_init(|| {
            let limit = std::env::var(Self::VARIABLE).ok().and_then(|name| Self::named(&name));
            let largest = if UNOPTIMISED { Self::Portable } else { Self::detected() };
            limit.map_or(largest, |limit| limit.min(largest))
        })
    }

    /// The set with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|set| set.name() == name)
    }

    #[cfg(target_arch = "x86_64")]
    fn detected() -> Self {
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

    #[cfg(not(target_arch = "x86_64"))]
    fn detected() -> Self {
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
