//! Sheets as the pages of a PDF, with text that can be searched and copied.

use std::collections::BTreeMap;
use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{CidFontType, FontFlags, LineJoinStyle, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use crate::MARK;
use crate::font::{self, FACE};
use crate::sheet::{Mark, Place, Sheet, Stroke, Words};

/// Points of a page for each pixel of the sheet.
const SCALE: f32 = 0.75;

/// The circle of a disc from four cubics: how far their inner points are out.
const ROUND: f64 = 0.552_284_749_8;

const FONT: Name<'static> = Name(b"F");
const FONT_NAME: Name<'static> = Name(b"PlotSans");

const INFO: Ref = Ref::new(1);
const CATALOG: Ref = Ref::new(2);
const PAGES: Ref = Ref::new(3);
const TYPE0: Ref = Ref::new(4);
const CID_FONT: Ref = Ref::new(5);
const DESCRIPTOR: Ref = Ref::new(6);
const FONT_FILE: Ref = Ref::new(7);
const UNICODE: Ref = Ref::new(8);
/// The first page; its content follows, then the next page.
const FIRST: i32 = 9;

const SYSTEM: SystemInfo<'static> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The sheets as a file.
pub(crate) fn pdf(sheets: &[&Sheet]) -> Vec<u8> {
    let mut pdf = Pdf::new();
    let title = sheets.first().map_or("", |sheet| &sheet.title);
    // First, so that the beginning of the file says what made it.
    pdf.document_info(INFO).producer(TextStr(MARK)).title(TextStr(title));
    pdf.catalog(CATALOG).pages(PAGES);
    let page = |i: usize| Ref::new(FIRST + 2 * i as i32);
    pdf.pages(PAGES).kids((0..sheets.len()).map(page)).count(sheets.len() as i32);
    let mut letters = BTreeMap::new();
    for (i, sheet) in sheets.iter().enumerate() {
        let content_id = Ref::new(page(i).get() + 1);
        let [width, height] = [sheet.width, sheet.height].map(|side| side as f32 * SCALE);
        let mut written = pdf.page(page(i));
        written.parent(PAGES).media_box(Rect::new(0.0, 0.0, width, height)).contents(content_id);
        written.resources().fonts().pair(FONT, TYPE0);
        written.finish();
        let mut page = Page { content: Content::new(), letters: &mut letters };
        // Places count from the upper left corner.
        page.content.transform([SCALE, 0.0, 0.0, -SCALE, 0.0, height]);
        page.content.set_line_join(LineJoinStyle::RoundJoin);
        sheet.marks.iter().for_each(|mark| page.mark(mark));
        let content = deflated(&page.content.finish());
        pdf.stream(content_id, &content).filter(Filter::FlateDecode);
    }
    embed_font(&mut pdf, &letters);
    pdf.finish()
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).expect("memory takes any text")
}

struct Page<'l> {
    content: Content,
    /// Letters by glyph.
    letters: &'l mut BTreeMap<u16, char>,
}

impl Page<'_> {
    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Line { points, stroke, .. } => self.line(points, stroke),
            Mark::Dot { at, radius, colour, .. } => {
                let [r, g, b] = share(*colour);
                self.disc(*at, radius + 0.4, [1.0; 3]);
                self.disc(*at, radius - 0.4, [r, g, b]);
            }
            Mark::Words(words) => self.words(words),
        }
    }

    fn line(&mut self, points: &[Place], stroke: &Stroke) {
        let [r, g, b] = share(stroke.colour);
        let dash = stroke.dash.iter().map(|length| *length as f32);
        self.content.set_stroke_rgb(r, g, b);
        self.content.set_line_width(stroke.width as f32);
        self.content.set_dash_pattern(dash, 0.0);
        for (i, &[x, y]) in points.iter().enumerate() {
            let [x, y] = [x, y].map(hundredths);
            if i == 0 {
                self.content.move_to(x, y)
            } else {
                self.content.line_to(x, y)
            };
        }
        self.content.stroke();
    }

    fn disc(&mut self, [x, y]: Place, radius: f64, [r, g, b]: [f32; 3]) {
        let at = |along: f64, down: f64| [x + along * radius, y + down * radius].map(hundredths);
        self.content.set_fill_rgb(r, g, b);
        let [x0, y0] = at(1.0, 0.0);
        self.content.move_to(x0, y0);
        // Quarters, each turned by a right angle from the one before.
        let (mut from, mut to) = ([1.0, 0.0], [0.0, 1.0]);
        for _ in 0..4 {
            let [x1, y1] = at(from[0] + ROUND * to[0], from[1] + ROUND * to[1]);
            let [x2, y2] = at(to[0] + ROUND * from[0], to[1] + ROUND * from[1]);
            let [x3, y3] = at(to[0], to[1]);
            self.content.cubic_to(x1, y1, x2, y2, x3, y3);
            (from, to) = (to, [-from[0], -from[1]]);
        }
        self.content.fill_nonzero();
    }

    fn words(&mut self, words: &Words) {
        let [r, g, b] = share(words.colour);
        self.content.set_fill_rgb(r, g, b);
        for part in font::parts(words).iter().filter(|part| !part.text.is_empty()) {
            let [x, y] = part.at.map(hundredths);
            // Letters stand upright though places count downwards.
            let turn = if words.upward { [0.0, -1.0, -1.0, 0.0] } else { [1.0, 0.0, 0.0, -1.0] };
            let [a, b, c, d] = turn;
            let mut glyphs = Vec::new();
            for letter in part.text.chars() {
                let glyph = font::glyph(letter).0;
                glyphs.extend(glyph.to_be_bytes());
                self.letters.entry(glyph).or_insert(letter);
            }
            self.content.begin_text();
            self.content.set_font(FONT, part.size as f32);
            self.content.set_text_matrix([a, b, c, d, x, y]);
            self.content.show(Str(&glyphs));
            self.content.end_text();
        }
    }
}

fn hundredths(value: f64) -> f32 {
    ((value * 100.0).round() / 100.0) as f32
}

fn share(colour: [u8; 3]) -> [f32; 3] {
    colour.map(|part| f32::from(part) / 255.0)
}

/// The whole font, with the widths of the letters that occur and what they mean.
fn embed_font(pdf: &mut Pdf, letters: &BTreeMap<u16, char>) {
    let to_thousandths = 1000.0 / f32::from(FACE.units_per_em());
    let units = |units: i16| f32::from(units) * to_thousandths;
    pdf.type0_font(TYPE0)
        .base_font(FONT_NAME)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(CID_FONT)
        .to_unicode(UNICODE);
    let mut font = pdf.cid_font(CID_FONT);
    font.subtype(CidFontType::Type2).base_font(FONT_NAME).system_info(SYSTEM);
    font.font_descriptor(DESCRIPTOR).cid_to_gid_map_predefined(Name(b"Identity"));
    let mut widths = font.widths();
    for &glyph in letters.keys() {
        let width = 1000.0 * font::advance(ttf_parser::GlyphId(glyph)) as f32;
        widths.consecutive(glyph, [width]);
    }
    widths.finish();
    font.finish();
    let bounds = FACE.global_bounding_box();
    let [x_min, y_min, x_max, y_max] =
        [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(units);
    pdf.font_descriptor(DESCRIPTOR)
        .name(FONT_NAME)
        .flags(FontFlags::NON_SYMBOLIC)
        .bbox(Rect::new(x_min, y_min, x_max, y_max))
        .italic_angle(0.0)
        .ascent(units(FACE.ascender()))
        .descent(units(FACE.descender()))
        .cap_height(units(FACE.capital_height().unwrap_or_else(|| FACE.ascender())))
        .stem_v(80.0)
        .font_file2(FONT_FILE);
    let file = deflated(&font::FILE);
    let length = font::FILE.len() as i32;
    let mut stream = pdf.stream(FONT_FILE, &file);
    stream.filter(Filter::FlateDecode);
    stream.pair(Name(b"Length1"), length);
    stream.finish();
    let mut meanings = UnicodeCmap::new(Name(b"Custom"), SYSTEM);
    letters.iter().for_each(|(&glyph, &letter)| meanings.pair(glyph, letter));
    pdf.cmap(UNICODE, &meanings.finish());
}
