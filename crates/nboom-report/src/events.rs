//! The table of events of a run.

use std::path::Path;

use nboom_results::EVENTS_FILE;
use nboom_tables::{Rows, count, number};
use serde::Serialize;

use crate::Gap;

/// Most events in a page.
const MOST_EVENTS: usize = 20_000;

/// An event, as the table of events has it.
#[derive(Debug, Serialize)]
pub struct EventKeys {
    /// When.
    pub t: f64,
    /// `release`, `lock_up`, and so on.
    pub kind: String,
    /// The hinge's appendage, from 1; none of an event of the satellite.
    pub appendage: Option<usize>,
    /// The hinge's place in it, from 1.
    pub segment: Option<usize>,
    impulse: Option<f64>,
    before: f64,
    after: f64,
}

/// The events of a run.
pub(crate) fn read(directory: &Path, gaps: &mut Vec<Gap>) -> Vec<EventKeys> {
    let mut events = Vec::new();
    match read_events(directory, &mut events) {
        Ok(true) => {}
        Ok(false) => gaps.push(Gap::Missing { file: EVENTS_FILE, shows: "table of events" }),
        Err(gap) => gaps.push(gap),
    }
    if events.len() > MOST_EVENTS {
        events.truncate(MOST_EVENTS);
        gaps.push(Gap::TooMany { file: EVENTS_FILE, most: MOST_EVENTS });
    }
    events
}

/// Reads up to one event more than a page shows; false if there is no such file.
fn read_events(directory: &Path, events: &mut Vec<EventKeys>) -> Result<bool, Gap> {
    let Some(mut rows) = Rows::open(directory, EVENTS_FILE)? else { return Ok(false) };
    let [t, kind, appendage, segment, impulse, before, after] = rows.places([
        "t",
        "kind",
        "appendage",
        "segment",
        "impulse",
        "energy_before",
        "energy_after",
    ])?;
    rows.each(|fields| {
        let given = |place: usize| Some(&fields[place]).filter(|text| !text.is_empty());
        if events.len() > MOST_EVENTS {
            return Ok(());
        }
        events.push(EventKeys {
            t: number(&fields[t])?,
            kind: fields[kind].to_owned(),
            appendage: given(appendage).map(count).transpose()?,
            segment: given(segment).map(count).transpose()?,
            impulse: given(impulse).map(number).transpose()?,
            before: number(&fields[before])?,
            after: number(&fields[after])?,
        });
        Ok(())
    })?;
    Ok(true)
}
