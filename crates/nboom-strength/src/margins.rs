/// Shares of its strength that a part has left; below zero it fails.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Margins {
    /// To yielding, where the yield stress is known.
    pub on_yield: Option<f64>,
    /// To breaking, where the ultimate stress is known.
    pub on_ultimate: Option<f64>,
}

/// What a part does beyond its strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// It yields.
    Yield,
    /// It breaks.
    Ultimate,
}

impl Limit {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Yield => "yield",
            Self::Ultimate => "ultimate",
        }
    }
}

impl Margins {
    /// The smaller one, and what it is to.
    pub fn smallest(&self) -> Option<(f64, Limit)> {
        let known = [(self.on_yield, Limit::Yield), (self.on_ultimate, Limit::Ultimate)];
        let known = known.into_iter().filter_map(|(margin, limit)| Some((margin?, limit)));
        known.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}
