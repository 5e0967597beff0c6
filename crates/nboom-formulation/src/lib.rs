//! Closed forms of Sections 4 and 5.
