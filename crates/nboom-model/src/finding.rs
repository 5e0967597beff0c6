use std::borrow::Cow;
use std::fmt;

/// What was found and what would have been right: the two halves of a message, which files put in their own order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What was found.
    pub found: String,
    /// What would have been right.
    pub expected: Cow<'static, str>,
}

impl Finding {
    /// This was found, and that expected.
    pub fn new(found: impl Into<String>, expected: impl Into<Cow<'static, str>>) -> Self {
        Self { found: found.into(), expected: expected.into() }
    }

    /// The same with these words before what was found.
    pub fn after(self, words: impl fmt::Display) -> Self {
        Self { found: format!("{words}{}", self.found), ..self }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} found, {} expected", self.found, self.expected)
    }
}
