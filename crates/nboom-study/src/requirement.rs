use serde::{Deserialize, Serialize};

/// Bounds that a result of each run should keep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Requirement {
    /// The result, by its text.
    pub result: String,
    /// The smallest number that meets it, in the unit of the result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// The largest number that meets it, in the unit of the result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

impl Requirement {
    /// Whether a number meets it. NaN, which is no number, does not.
    pub fn is_met(&self, value: f64) -> bool {
        !value.is_nan()
            && self.at_least.is_none_or(|least| value >= least)
            && self.at_most.is_none_or(|most| value <= most)
    }

    /// Its bounds in words.
    pub fn bounds(&self) -> String {
        let bound = |words, bound: Option<f64>| bound.map(|bound| format!("{words} {bound}"));
        let bounds = [bound("at least", self.at_least), bound("at most", self.at_most)];
        bounds.into_iter().flatten().collect::<Vec<_>>().join(" and ")
    }
}
