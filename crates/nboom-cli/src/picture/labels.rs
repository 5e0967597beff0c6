//! Labels that do not lie on each other.

use std::fmt::Write;

use nboom_report::escaped;

use super::view::{HEIGHT, WIDTH};

/// Width of a character and height of a line of a label.
const CHARACTER: f64 = 6.7;
const LINE: f64 = 14.0;

/// Distances of a label from its place: the nearest that is free is taken.
const DISTANCES: [f64; 7] = [12.0, 22.0, 34.0, 48.0, 64.0, 82.0, 102.0];

/// Directions from the place to the label.
const DIRECTIONS: [[f64; 2]; 8] = [
    [1.0, -0.6],
    [1.0, 0.6],
    [-1.0, -0.6],
    [-1.0, 0.6],
    [0.0, -1.0],
    [0.0, 1.0],
    [1.0, 0.0],
    [-1.0, 0.0],
];

/// Width of a mark that labels keep off.
const MARK: f64 = 10.0;

/// The first distance beyond which a line joins a label to its place.
const FAR: f64 = 30.0;

/// A rectangle in the drawing.
#[derive(Clone, Copy)]
struct Area {
    left: f64,
    top: f64,
    width: f64,
}

impl Area {
    fn overlaps(&self, other: &Self) -> bool {
        self.left < other.left + other.width
            && other.left < self.left + self.width
            && (self.top - other.top).abs() < LINE
    }

    fn fits(&self) -> bool {
        self.left > 2.0
            && self.left + self.width < WIDTH - 2.0
            && self.top > 2.0 * LINE
            && self.top + LINE < HEIGHT
    }
}

/// The labels of a drawing so far.
#[derive(Default)]
pub(super) struct Labels(Vec<Area>);

impl Labels {
    /// A label that stands in the middle of its place.
    pub fn fixed(&mut self, text: &mut String, label: &str, colour: &str, (x, y): (f64, f64)) {
        let width = CHARACTER * label.chars().count() as f64;
        let area = Area { left: x - 0.5 * width, top: y - 0.5 * LINE, width };
        self.write(text, label, colour, area);
    }

    /// Keeps labels off a mark at this place.
    pub fn keep_off(&mut self, (x, y): (f64, f64)) {
        self.0.push(Area { left: x - 0.5 * MARK, top: y - 0.5 * LINE, width: MARK });
    }

    /// A label beside its place, away from the middle of the drawing; none where nothing is free.
    pub fn place(&mut self, text: &mut String, label: &str, (x, y): (f64, f64)) {
        let width = CHARACTER * label.chars().count() as f64;
        let beside = |distance: f64, [right, down]: [f64; 2]| {
            let left = x + right * distance - 0.5 * width * (1.0 - right);
            Area { left, top: y + down * distance - 0.5 * LINE, width }
        };
        let inwards =
            |[right, down]: &[f64; 2]| (0.5 * WIDTH - x) * right + (0.5 * HEIGHT - y) * down;
        let mut directions = DIRECTIONS;
        directions.sort_by(|a, b| inwards(a).total_cmp(&inwards(b)));
        let areas = |directions: &[[f64; 2]]| -> Vec<(f64, Area)> {
            let at = |distance| {
                directions.iter().map(move |direction| (distance, beside(distance, *direction)))
            };
            DISTANCES.into_iter().flat_map(at).collect()
        };
        let (outwards, others) = directions.split_at(5);
        let is_free = |area: &Area| area.fits() && !self.0.iter().any(|other| area.overlaps(other));
        let mut all = areas(outwards).into_iter().chain(areas(others));
        let free = all.find(|(_, area)| is_free(area));
        let Some((distance, area)) = free else { return };
        if distance > FAR {
            let end = x.clamp(area.left, area.left + area.width);
            let down = if area.top > y { area.top } else { area.top + LINE };
            let _ = writeln!(
                text,
                "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{end:.1}\" y2=\"{down:.1}\" \
                 stroke=\"#888888\" stroke-width=\"0.7\"/>"
            );
        }
        self.write(text, label, "#111111", area);
    }

    fn write(&mut self, text: &mut String, label: &str, colour: &str, area: Area) {
        let (x, y, label) = (area.left, area.top + 0.78 * LINE, escaped(label));
        // White around the letters, so that they are read on anything.
        for style in ["stroke=\"white\" stroke-width=\"3\" stroke-linejoin=\"round\"", ""] {
            let _ = writeln!(
                text,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{colour}\" {style}>{label}</text>"
            );
        }
        self.0.push(area);
    }
}
