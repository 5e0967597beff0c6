use std::fmt;
use std::sync::Arc;

/// Which hinge, as users count: appendage K and segment I of it; and the name of the body on it, if
/// the scene gives names.
///
/// Stored from 0, shown from 1 as `K,I` or `K,I (name)`. In a general tree K is the branch that leaves
/// the main body and I the body's number within it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HingeLabel {
    /// Appendage, from 0.
    pub appendage: usize,
    /// Segment of that appendage, from 0.
    pub segment: usize,
    /// What the scene calls the body.
    pub name: Option<Arc<str>>,
}

impl HingeLabel {
    /// Of a body without a name.
    pub const fn new(appendage: usize, segment: usize) -> Self {
        Self { appendage, segment, name: None }
    }

    /// K and I, from 1.
    pub fn numbers(&self) -> [usize; 2] {
        [self.appendage + 1, self.segment + 1]
    }
}

impl fmt::Display for HingeLabel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [appendage, segment] = self.numbers();
        write!(f, "{appendage},{segment}")?;
        self.name.iter().try_for_each(|name| write!(f, " ({name})"))
    }
}
