//! One panel: its axes, its curves and their names.

use nboom_report::thinned;

use crate::axis::Axis;
use crate::figure::{Curve, Panel};
use crate::font;
use crate::sheet::{Anchor, Mark, Place, Sheet, Stroke, Words};
use crate::style::{GRID, LABEL, PALE_INK, SMALL, stroke};

use super::{LEGEND, frame_stroke, power, with_power};

/// Most points of a curve: many times as many as there are columns of dots on paper.
const MOST_POINTS: usize = 10_000;

/// Height of a line of a legend, length of its sample, distance from the frame.
const LINE: f64 = 17.0;
const SAMPLE: f64 = 26.0;
const GAP: f64 = 12.0;

/// Radii of dots: of a curve of one point, of a largest value.
const POINT: f64 = 2.0;
const LARGEST: f64 = 3.4;

/// Where a panel stands on its sheet.
pub(super) struct Frame<'t> {
    pub time: &'t Axis,
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

impl Frame<'_> {
    /// Lines at the ticks of time.
    pub fn grid(&self, sheet: &mut Sheet) {
        for (x, _, _) in self.time.ticks() {
            sheet.line(&[[x, self.top], [x, self.bottom]], grid());
        }
    }

    pub fn draw(&self, sheet: &mut Sheet, panel: &Panel<'_>) {
        let values = panel.curves.iter().flat_map(Curve::reach);
        let axis = Axis::over(values, panel.scale, panel.least).between(self.bottom, self.top);
        self.scale(sheet, panel, &axis);
        let Self { left, right, top, bottom, .. } = *self;
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
        sheet.line(&corners, frame_stroke());
        let count = panel.curves.len();
        let curves = panel.curves.iter().enumerate();
        let mut curves: Vec<_> = curves.map(|(i, curve)| (curve, stroke(i, count))).collect();
        // Gaps show what is below, so of curves that agree each is seen.
        curves.sort_by_key(|(_, stroke)| stroke.dash.len());
        curves.iter().for_each(|(curve, stroke)| self.curve(sheet, curve, &axis, *stroke));
        for (number, curve) in panel.curves.iter().enumerate() {
            let Some([time, value]) = curve.largest else { continue };
            let at = [self.time.place(time), axis.place(value)];
            let name = Some(format!("largest, {}", curve.label));
            let colour = stroke(number, count).colour;
            if self.has(at) {
                sheet.marks.push(Mark::Dot { at, radius: LARGEST, colour, name });
            }
        }
        self.legend(sheet, panel);
    }

    /// Numbers and name of the vertical axis.
    fn scale(&self, sheet: &mut Sheet, panel: &Panel<'_>, axis: &Axis) {
        for (y, text, raised) in axis.ticks() {
            sheet.line(&[[self.left, y], [self.right, y]], grid());
            let words = Words::new(text, [self.left - 8.0, y + 0.35 * SMALL], SMALL);
            sheet.words(words.raised(raised).anchored(Anchor::End));
        }
        let middle = 0.5 * (self.top + self.bottom);
        let words = Words::new(with_power(panel.label.clone(), axis), [20.0, middle], LABEL);
        sheet.words(words.raised(power(axis)).anchored(Anchor::Middle).upward());
    }

    fn has(&self, [x, y]: Place) -> bool {
        let (beside, above) =
            (self.left - 1.0..=self.right + 1.0, self.top - 1.0..=self.bottom + 1.0);
        beside.contains(&x) && above.contains(&y)
    }

    fn curve(&self, sheet: &mut Sheet, curve: &Curve<'_>, axis: &Axis, stroke: Stroke) {
        let places = curve.times.iter().zip(curve.values.iter());
        let places = places.map(|(&time, &value)| [self.time.place(time), axis.place(value)]);
        let places: Vec<Place> = places.collect();
        let height = self.bottom - self.top;
        // What has no place on the axis, as zeros on a logarithmic one, leaves a gap.
        for piece in places.chunk_by(|a, b| self.has(*a) && self.has(*b)) {
            let name = Some(curve.label.clone());
            match *piece {
                [at] if self.has(at) => {
                    let (radius, colour) = (POINT, stroke.colour);
                    sheet.marks.push(Mark::Dot { at, radius, colour, name });
                }
                [_] | [] => {}
                _ => sheet.marks.push(Mark::Line { points: visible(piece, height), stroke, name }),
            }
        }
    }

    /// Names of curves, right of the frame; of very many curves some.
    fn legend(&self, sheet: &mut Sheet, panel: &Panel<'_>) {
        let count = panel.curves.len();
        let room = ((self.bottom - self.top) / LINE) as usize;
        let shown = count.min(room);
        let left = self.right + GAP;
        for line in 0..shown {
            // All of them, else evenly from the first to the last.
            let number = if shown < count { line * (count - 1) / (shown - 1).max(1) } else { line };
            let label = &panel.curves[number].label;
            if label.is_empty() {
                continue;
            }
            let y = self.top + LINE * (line as f64 + 0.5);
            sheet.line(&[[left, y], [left + SAMPLE, y]], stroke(number, count));
            let label = font::fitted(label, SMALL, LEGEND - GAP - SAMPLE - 10.0);
            sheet.words(Words::new(label, [left + SAMPLE + 6.0, y + 0.35 * SMALL], SMALL));
        }
        if shown < count {
            let words =
                Words::new(format!("{shown} of {count}"), [left, self.bottom + 11.0], SMALL);
            sheet.words(words.coloured(PALE_INK));
        }
    }
}

fn grid() -> Stroke {
    Stroke { colour: GRID, width: 0.8, dash: &[] }
}

/// The points of a line that an eye can tell from straight lines between others.
fn visible(places: &[Place], height: f64) -> Vec<Place> {
    let columns = [0, 1].map(|i| places.iter().map(|place| place[i]).collect::<Vec<f64>>());
    let kept = thinned(&columns, &[height], &[], MOST_POINTS);
    kept.rows.iter().map(|&row| places[row]).collect()
}
