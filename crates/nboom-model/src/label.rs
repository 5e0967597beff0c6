use std::fmt;
use std::sync::Arc;

use crate::{Joint, shown};

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
    /// Whether it turns or slides.
    pub joint: Joint,
}

impl HingeLabel {
    /// Of a body without a name, on a hinge that turns.
    pub const fn new(appendage: usize, segment: usize) -> Self {
        Self { appendage, segment, name: None, joint: Joint::Revolute }
    }

    /// K and I, from 1.
    pub fn numbers(&self) -> [usize; 2] {
        [self.appendage + 1, self.segment + 1]
    }

    /// Which of these hinges a text names, by its body or by its numbers as `1,2`. Names come before numbers, since a
    /// name may look like the numbers of another hinge.
    pub fn find(hinges: &[Self], text: &str) -> Option<usize> {
        let named =
            |text: &str| hinges.iter().position(|label| label.name.as_deref() == Some(text));
        let numbered = || {
            let (appendage, segment) = text.split_once(',')?;
            let numbers = [appendage.trim().parse().ok()?, segment.trim().parse().ok()?];
            hinges.iter().position(|label| label.numbers() == numbers)
        };
        named(text).or_else(|| named(text.trim())).or_else(numbered)
    }

    /// β or τ of the hinge for people, to six digits: degrees, or a length.
    pub fn coordinate(&self, beta: f64) -> String {
        let (value, unit) = match self.joint {
            Joint::Revolute => (beta.to_degrees(), " deg"),
            Joint::Prismatic => (beta, ""),
        };
        let rounded = format!("{value:.5e}").parse();
        // Nobody wants to read of -0.
        format!("{}{unit}", shown(rounded.unwrap_or(value) + 0.0))
    }
}

impl fmt::Display for HingeLabel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [appendage, segment] = self.numbers();
        write!(f, "{appendage},{segment}")?;
        self.name.iter().try_for_each(|name| write!(f, " ({name})"))
    }
}
