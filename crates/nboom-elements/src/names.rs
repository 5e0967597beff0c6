/// What an element is called in messages and files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Names {
    /// The element.
    pub name: &'static str,
    /// The event that its length or angle rises beyond a bound of its law.
    pub rise: EventName,
    /// The event that its length or angle falls below a bound of its law.
    pub fall: EventName,
    /// Its force and its length, of a force along a line.
    pub line: Option<LineNames>,
}

/// What an event is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EventName {
    /// In tables of events.
    pub in_files: &'static str,
    /// In the listing, before the hinge.
    pub in_listing: &'static str,
}

/// What force and length of a force along a line are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineNames {
    /// The force in messages.
    pub force: &'static str,
    /// The length in messages.
    pub length: &'static str,
    /// The heading of the force in the listing.
    pub force_column: &'static str,
    /// The heading of the length in the listing.
    pub length_column: &'static str,
}
