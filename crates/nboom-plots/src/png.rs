//! Sheets as PNG.

use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};
use ttf_parser::OutlineBuilder;

use crate::MARK;
use crate::font::{self, FACE};
use crate::sheet::{Colour, Mark, Place, Sheet, Words};

/// Dots of the picture for each pixel of the sheet: 192 to the inch.
const SCALE: f64 = 2.0;

const WHITE: Colour = [0xff; 3];

/// The sheet as a file.
pub(crate) fn png(sheet: &Sheet) -> Vec<u8> {
    let [width, height] = [sheet.width, sheet.height].map(|side| (SCALE * side).ceil() as u32);
    let mut pixmap = Pixmap::new(width, height).expect("sheets have a width and a height");
    pixmap.fill(tiny_skia::Color::WHITE);
    let mut picture = Picture { pixmap };
    for mark in &sheet.marks {
        match mark {
            Mark::Line { points, stroke, .. } => picture.line(points, stroke),
            Mark::Dot { at, radius, colour, .. } => {
                picture.disc(*at, radius + 0.4, WHITE);
                picture.disc(*at, radius - 0.4, *colour);
            }
            Mark::Words(words) => picture.words(words),
        }
    }
    encoded(&picture.pixmap)
}

/// A file that says what made it and how large its dots are.
fn encoded(pixmap: &Pixmap) -> Vec<u8> {
    // White paper leaves nothing transparent.
    let dots: Vec<u8> =
        pixmap.data().chunks_exact(4).flat_map(|dot| [dot[0], dot[1], dot[2]]).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, pixmap.width(), pixmap.height());
    encoder.set_color(png::ColorType::Rgb);
    let per_metre = (SCALE * 96.0 / 0.0254).round() as u32;
    let unit = png::Unit::Meter;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit }));
    let named = encoder.add_text_chunk("Software".to_owned(), MARK.to_owned());
    let written = named
        .and_then(|()| encoder.write_header())
        .and_then(|mut writer| writer.write_image_data(&dots).and_then(|()| writer.finish()));
    written.expect("memory takes any picture");
    file
}

struct Picture {
    pixmap: Pixmap,
}

impl Picture {
    fn line(&mut self, points: &[Place], stroke: &crate::sheet::Stroke) {
        let mut path = PathBuilder::new();
        for (i, &[x, y]) in points.iter().enumerate() {
            let add = if i == 0 { PathBuilder::move_to } else { PathBuilder::line_to };
            add(&mut path, x as f32, y as f32);
        }
        let Some(path) = path.finish() else { return };
        let dash = stroke.dash.iter().map(|length| *length as f32).collect();
        let stroke_of_skia = Stroke {
            width: stroke.width as f32,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            dash: StrokeDash::new(dash, 0.0),
            ..Stroke::default()
        };
        self.pixmap.stroke_path(&path, &paint(stroke.colour), &stroke_of_skia, to_dots(), None);
    }

    fn disc(&mut self, [x, y]: Place, radius: f64, colour: Colour) {
        if let Some(path) = PathBuilder::from_circle(x as f32, y as f32, radius as f32) {
            self.fill(&path, colour);
        }
    }

    fn words(&mut self, words: &Words) {
        for part in font::parts(words) {
            let scale = part.size / f64::from(FACE.units_per_em());
            let mut at = part.at;
            for letter in part.text.chars() {
                let glyph = font::glyph(letter);
                let mut outline =
                    Outline { path: PathBuilder::new(), at, scale, upward: words.upward };
                FACE.outline_glyph(glyph, &mut outline);
                if let Some(path) = outline.path.finish() {
                    self.fill(&path, words.colour);
                }
                let advance = font::advance(glyph) * part.size;
                if words.upward { at[1] -= advance } else { at[0] += advance }
            }
        }
    }

    fn fill(&mut self, path: &Path, colour: Colour) {
        self.pixmap.fill_path(path, &paint(colour), FillRule::Winding, to_dots(), None);
    }
}

fn to_dots() -> Transform {
    Transform::from_scale(SCALE as f32, SCALE as f32)
}

fn paint([r, g, b]: Colour) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, 0xff);
    paint
}

/// The outline of a letter at a place.
struct Outline {
    path: PathBuilder,
    at: Place,
    scale: f64,
    upward: bool,
}

impl Outline {
    fn place(&self, along: f32, above: f32) -> (f32, f32) {
        let [along, above] = [along, above].map(|units| f64::from(units) * self.scale);
        let [x, y] = self.at;
        let (x, y) = if self.upward { (x - above, y - along) } else { (x + along, y - above) };
        (x as f32, y as f32)
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2)) = (self.place(x1, y1), self.place(x2, y2));
        let (x, y) = self.place(x, y);
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
