//! A figure as lines and words on a sheet.

mod events;
mod panel;

use crate::axis::Axis;
use crate::figure::Figure;
use crate::font;
use crate::sheet::{Anchor, Sheet, Words};
use crate::source::Source;
use crate::style::{FRAME, LABEL, PALE_INK, SMALL, TINY, TITLE};

use events::EventMarks;
use panel::Frame;

/// Width of a sheet \[px\].
const WIDTH: f64 = 760.0;

/// Room for numbers and names of the vertical axes, and on the right without and with a legend.
const LEFT: f64 = 76.0;
const RIGHT: f64 = 24.0;
const LEGEND: f64 = 150.0;

/// Room below the last panel, and between panels.
const FOOT: f64 = 46.0;
const BETWEEN: f64 = 16.0;

/// Heights of panels: of one alone, of one of two, of one of more.
const HEIGHTS: [f64; 3] = [300.0, 200.0, 160.0];

/// The figure of a run; none without anything to show.
pub(crate) fn drawn(source: &Source<'_>, figure: &Figure<'_>) -> Option<Sheet> {
    let panels: Vec<_> = figure.panels.iter().filter(|panel| !panel.curves.is_empty()).collect();
    let curves = || panels.iter().flat_map(|panel| &panel.curves);
    let times = curves().filter_map(|curve| Some([*curve.times.first()?, *curve.times.last()?]));
    // Pulses end after the run if a hinge locks just before its end.
    let largest = curves().filter_map(|curve| Some(curve.largest?[0]));
    let times: Vec<f64> = times.flatten().chain(largest).collect();
    if times.is_empty() {
        return None;
    }
    let has_legend = curves().any(|curve| !curve.label.is_empty());
    let right = WIDTH - if has_legend { LEGEND } else { RIGHT };
    let time = Axis::exactly(times.into_iter()).between(LEFT, right);
    let title = format!("{}: {}", source.run.label(), lower_first(figure.title));
    let mut sheet = Sheet { title, width: WIDTH, ..Sheet::default() };
    let top = heading(source, figure, &mut sheet);
    let events = EventMarks::of(source, &time, [LEFT, right], WIDTH);
    let top = top + events.height();
    let height = HEIGHTS[panels.len().clamp(1, HEIGHTS.len()) - 1];
    let tops = (0..panels.len()).map(|i| top + (height + BETWEEN) * i as f64);
    let frames: Vec<Frame<'_>> = tops
        .map(|top| Frame { time: &time, left: LEFT, right, top, bottom: top + height })
        .collect();
    let bottom = frames.last().map_or(top, |frame| frame.bottom);
    frames.iter().for_each(|frame| frame.grid(&mut sheet));
    events.draw(&mut sheet, top, bottom);
    for (frame, panel) in frames.iter().zip(&panels) {
        frame.draw(&mut sheet, panel);
    }
    foot(&mut sheet, &time, &source.units.time, bottom);
    let meaning = Words::new(events.meaning(), [right, bottom + 36.0], TINY);
    sheet.words(meaning.anchored(Anchor::End).coloured(PALE_INK));
    sheet.height = bottom + FOOT;
    Some(sheet)
}

/// Title and note; returns where they end.
fn heading(source: &Source<'_>, figure: &Figure<'_>, sheet: &mut Sheet) -> f64 {
    let room = WIDTH - LEFT - RIGHT;
    let title = font::fitted(&sheet.title, TITLE, room);
    sheet.words(Words::new(title, [LEFT, 26.0], TITLE));
    let incomplete = if source.run.is_complete() { "" } else { "The run did not come to its end." };
    let note = format!("{} {incomplete}", figure.note);
    if note.trim().is_empty() {
        return 40.0;
    }
    let note = font::fitted(note.trim(), SMALL, room);
    sheet.words(Words::new(note, [LEFT, 44.0], SMALL).coloured(PALE_INK));
    58.0
}

/// Numbers and name of the axis of time.
fn foot(sheet: &mut Sheet, time: &Axis, unit: &str, bottom: f64) {
    for (x, text, _) in time.ticks() {
        sheet.words(Words::new(text, [x, bottom + 17.0], SMALL).anchored(Anchor::Middle));
    }
    let middle = 0.5 * (time.place_of_end(0) + time.place_of_end(1));
    let words =
        Words::new(with_power(format!("Time [{unit}]"), time), [middle, bottom + 37.0], LABEL);
    sheet.words(words.raised(power(time)).anchored(Anchor::Middle));
}

/// The name of an axis whose numbers are written without a power of ten.
fn with_power(label: String, axis: &Axis) -> String {
    if axis.power == 0 { label } else { label + ", × 10" }
}

fn power(axis: &Axis) -> String {
    if axis.power == 0 { String::new() } else { axis.power.to_string().replace('-', "\u{2212}") }
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

/// Stroke of frames.
fn frame_stroke() -> crate::sheet::Stroke {
    crate::sheet::Stroke { colour: FRAME, width: 1.0, dash: &[] }
}
