use std::fmt;

/// Which hinge, as users count: appendage K and segment I of it.
///
/// Stored from 0, shown from 1 as `K,I`. In a general tree K is the branch that leaves the
/// main body and I the body's number within it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HingeLabel {
    /// Appendage, from 0.
    pub appendage: usize,
    /// Segment of that appendage, from 0.
    pub segment: usize,
}

impl fmt::Display for HingeLabel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.appendage + 1, self.segment + 1)
    }
}
