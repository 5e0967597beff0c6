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
    /// Both, as in the files.
    pub const ALL: [Self; 2] = [Self::Yield, Self::Ultimate];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Yield => "yield",
            Self::Ultimate => "ultimate",
        }
    }
}

impl Margins {
    /// That to this limit, if it is known.
    pub fn to(&self, limit: Limit) -> Option<f64> {
        match limit {
            Limit::Yield => self.on_yield,
            Limit::Ultimate => self.on_ultimate,
        }
    }

    /// The smaller one, and what it is to.
    pub fn smallest(&self) -> Option<(f64, Limit)> {
        let known = Limit::ALL.into_iter().filter_map(|limit| Some((self.to(limit)?, limit)));
        known.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}
