//! Events as lines across all panels, with their names above.

use crate::axis::Axis;
use crate::font;
use crate::sheet::{Anchor, Sheet, Stroke, Words};
use crate::source::Source;
use crate::style::{EVENT, PALE_INK, TINY};

/// Lines of names, and the height of one.
const MOST_LINES: usize = 5;
const LINE: f64 = 12.0;

/// Events nearer to each other than this are one line \[px\].
const NEAR: f64 = 0.5;

/// Longest name \[px\].
const LONGEST: f64 = 170.0;

/// An event of one or several hinges at one time.
struct Happening<'a> {
    kind: &'a str,
    time: f64,
    hinges: Vec<String>,
}

impl Happening<'_> {
    /// Lock-ups matter most, then releases.
    fn rank(&self) -> usize {
        match self.kind {
            "lock_up" => 0,
            "release" => 1,
            _ => 2,
        }
    }

    fn name(&self) -> String {
        let kind = match self.kind {
            "lock_up" => "lock-up".to_owned(),
            "kick_off_disengage" => "kick-off off".to_owned(),
            "kick_off_engage" => "kick-off on".to_owned(),
            other => other.replace('_', " "),
        };
        match &self.hinges[..] {
            [] => kind,
            [hinge] => format!("{kind} {hinge}"),
            hinges => {
                let all = format!("{kind} {}", hinges.join(" + "));
                let fits = font::width(&all, TINY) <= LONGEST;
                if fits { all } else { format!("{kind} of {} hinges", hinges.len()) }
            }
        }
    }
}

/// A name above the panels.
struct Name {
    text: String,
    x: f64,
    line: usize,
}

/// Lines of events, and as many names as there is room for.
pub(super) struct EventMarks {
    /// Places in time, and whether something locks there.
    places: Vec<(f64, bool)>,
    names: Vec<Name>,
    lines: usize,
}

impl EventMarks {
    /// Those of a run within the frame; names end at `end`.
    pub fn of(source: &Source<'_>, time: &Axis, [left, right]: [f64; 2], end: f64) -> Self {
        let is_shown = |happening: &Happening<'_>| {
            let x = time.place(happening.time);
            x >= left - NEAR && x <= right + NEAR
        };
        let all: Vec<Happening<'_>> = happenings(source).into_iter().filter(is_shown).collect();
        let mut places: Vec<(f64, bool)> = Vec::new();
        for happening in &all {
            let (x, locks) = (time.place(happening.time), happening.rank() == 0);
            match places.last_mut().filter(|(last, _)| x - *last < NEAR) {
                Some((_, is_lock_up)) => *is_lock_up |= locks,
                None => places.push((x, locks)),
            }
        }
        // Where not all have room those that matter most are named.
        let named = [2, 1, 0].into_iter().find_map(|rank| {
            let named = || all.iter().filter(|happening| happening.rank() <= rank);
            let names = names(named(), time, end);
            (names.len() == named().count()).then_some(names)
        });
        let most = all.iter().filter(|happening| happening.rank() == 0);
        let names = named.unwrap_or_else(|| self::names(most, time, end));
        let lines = names.iter().map(|name| name.line + 1).max().unwrap_or(0);
        Self { places, names, lines }
    }

    /// Room that names need above the panels.
    pub fn height(&self) -> f64 {
        self.lines as f64 * LINE
    }

    /// What the lines mean; nothing without lines.
    pub fn meaning(&self) -> &'static str {
        let any = |is_lock_up: bool| self.places.iter().any(|(_, locks)| *locks == is_lock_up);
        match (any(true), any(false)) {
            (true, true) => "vertical lines: lock-ups; dotted: other events",
            (true, false) => "vertical lines: lock-ups",
            (false, true) => "dotted lines: events",
            (false, false) => "",
        }
    }

    /// Draws them above and across what is between `top` and `bottom`.
    pub fn draw(&self, sheet: &mut Sheet, top: f64, bottom: f64) {
        let base = |line: usize| top - LINE * (self.lines - line) as f64;
        for &(x, locks) in &self.places {
            let dash: &[f64] = if locks { &[] } else { &[1.5, 3.0] };
            let stroke = Stroke { colour: EVENT, width: 0.9, dash };
            sheet.line(&[[x, top], [x, bottom]], stroke);
        }
        for Name { text, x, line } in &self.names {
            let stroke = Stroke { colour: EVENT, width: 0.6, dash: &[] };
            sheet.line(&[[*x, base(*line) + 1.0], [*x, top]], stroke);
            let words = Words::new(text, [x + 3.0, base(*line) + 0.8 * LINE], TINY);
            sheet.words(words.anchored(Anchor::Start).coloured(PALE_INK));
        }
    }
}

/// Events by time and kind, without the end.
fn happenings<'a>(source: &'a Source<'_>) -> Vec<Happening<'a>> {
    let mut found: Vec<Happening<'a>> = Vec::new();
    for event in source.run.events().iter().filter(|event| event.kind != "end") {
        let hinge = event.appendage.zip(event.segment);
        let hinge = hinge.map(|(appendage, segment)| source.label(appendage, segment));
        let same = |last: &&mut Happening<'_>| last.time == event.t && last.kind == event.kind;
        match found.last_mut().filter(same) {
            Some(last) => last.hinges.extend(hinge),
            None => found.push(Happening {
                kind: &event.kind,
                time: event.t,
                hinges: hinge.into_iter().collect(),
            }),
        }
    }
    found
}

/// Names right of their lines, each in the highest line from which down to the panels nothing is in its way; fewer
/// than there are events where there is no room.
fn names<'h>(
    happenings: impl Iterator<Item = &'h Happening<'h>>,
    time: &Axis,
    end: f64,
) -> Vec<Name> {
    let mut ends = [f64::NEG_INFINITY; MOST_LINES];
    let mut names: Vec<Name> = Vec::new();
    for happening in happenings {
        let x = time.place(happening.time);
        let line = ends.iter().rposition(|end| *end > x - 1.0).map_or(0, |taken| taken + 1);
        let text = font::fitted(&happening.name(), TINY, LONGEST.min(end - x - 6.0));
        if line == MOST_LINES {
            continue;
        }
        ends[line] = x + 6.0 + font::width(&text, TINY);
        names.push(Name { text, x, line });
    }
    names
}
