//! Sheets as SVG: text stays text, in whatever font there is with the widths of Helvetica.

use std::fmt::Write;

use nboom_report::escaped;

use crate::MARK;
use crate::sheet::{Anchor, Colour, Mark, Place, RAISED_BY, RAISED_SIZE, Sheet, Stroke, Words};

const FONTS: &str = "Helvetica, Arial, 'Liberation Sans', sans-serif";

/// The sheet as a file.
pub(crate) fn svg(sheet: &Sheet) -> String {
    let Sheet { width, height, .. } = sheet;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"{FONTS}\">\n<!-- {MARK} -->\n\
         <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        escaped(&sheet.title)
    );
    for mark in &sheet.marks {
        match mark {
            Mark::Line { points, stroke, name } => line(&mut text, points, stroke, name.as_deref()),
            Mark::Dot { at: [x, y], radius, colour, name } => {
                let _ = writeln!(
                    text,
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\" fill=\"{}\" stroke=\"#ffffff\" \
                     stroke-width=\"0.8\">{}</circle>",
                    number(*x),
                    number(*y),
                    hex(*colour),
                    title(name.as_deref())
                );
            }
            Mark::Words(words) if words.text.is_empty() => {}
            Mark::Words(words) => self::words(&mut text, words),
        }
    }
    text + "</svg>\n"
}

fn line(text: &mut String, points: &[Place], stroke: &Stroke, name: Option<&str>) {
    text.push_str("<polyline points=\"");
    for (i, [x, y]) in points.iter().enumerate() {
        let _ = write!(text, "{}{},{}", if i > 0 { " " } else { "" }, number(*x), number(*y));
    }
    let _ = write!(
        text,
        "\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
        hex(stroke.colour),
        stroke.width
    );
    if !stroke.dash.is_empty() {
        let dashes: Vec<String> = stroke.dash.iter().map(ToString::to_string).collect();
        let _ = write!(text, " stroke-dasharray=\"{}\"", dashes.join(" "));
    }
    match name {
        Some(_) => writeln!(text, ">{}</polyline>", title(name)),
        None => writeln!(text, "/>"),
    }
    .expect("a string takes any text");
}

fn words(text: &mut String, words: &Words) {
    let anchor = match words.anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let [x, y] = words.at.map(number);
    let turn =
        if words.upward { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
    let size = words.size;
    let _ = write!(
        text,
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{}\"{anchor}{turn}>{}",
        hex(words.colour),
        escaped(&words.text)
    );
    if !words.raised.is_empty() {
        let (up, small) = (number(-RAISED_BY * size), number(RAISED_SIZE * size));
        let raised = escaped(&words.raised);
        let _ = write!(text, "<tspan dy=\"{up}\" font-size=\"{small}\">{raised}</tspan>");
    }
    text.push_str("</text>\n");
}

fn title(name: Option<&str>) -> String {
    name.map_or_else(String::new, |name| format!("<title>{}</title>", escaped(name)))
}

/// To a hundredth of a pixel.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
