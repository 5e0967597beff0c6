use std::collections::BTreeSet;
use std::io::Cursor;

use nboom_plots::{Format, PlotFile, names};
use roxmltree::Document;
use tempfile::TempDir;

use crate::directory::{directory, files, table};

fn swinging() -> TempDir {
    let row = |t: f64| vec![t.sin(), t.cos(), 0.1 * t, 0.0, 0.2, 1.0, 0.0, 0.0, 0.0];
    let columns = "beta_1_1,tau_1_1,omega_x,omega_y,omega_z,chi,kappa_x,kappa_y,kappa_z";
    directory("swinging ω", &table(columns, (0..100).map(|i| 0.1 * f64::from(i)), row))
}

fn stems(files: &[PlotFile]) -> Vec<&str> {
    files.iter().map(|file| file.name.split_once('.').expect("an ending").0).collect()
}

#[test]
fn formats_have_the_same_figures_by_names_that_are_told() {
    let place = swinging();
    let [svg, png, mut pdf] = Format::ALL.map(|format| files(&place, format));
    let expected =
        ["01-deployment-angles", "02-hinge-rates", "03-body-rates", "05-direction-cosines"];
    assert_eq!(stems(&svg), expected);
    assert_eq!(stems(&png), expected);
    assert_eq!(pdf.pop().expect("files").name, "all.pdf");
    assert_eq!(stems(&pdf), expected);
    let told: BTreeSet<String> = names(&Format::ALL).into_iter().collect();
    assert!(svg.iter().chain(&png).chain(&pdf).all(|file| told.contains(&file.name)));
    for file in svg.iter().chain(&png).chain(&pdf) {
        let start = String::from_utf8_lossy(&file.bytes[..512]).into_owned();
        assert!(start.contains("made by nboom"), "{}: {start:?}", file.name);
    }
}

#[test]
fn a_picture_in_dots_is_twice_the_size_of_the_drawing_and_not_blank() {
    let place = swinging();
    for (svg, png) in files(&place, Format::Svg).iter().zip(files(&place, Format::Png)) {
        let text = std::str::from_utf8(&svg.bytes).expect("text");
        let document = Document::parse(text).expect("well-formed");
        let side = |name| document.root_element().attribute(name).expect("a side").parse::<f64>();
        let reader = png::Decoder::new(Cursor::new(&png.bytes)).read_info();
        let mut reader = reader.expect("a picture");
        let mut dots = vec![0; reader.output_buffer_size().expect("it fits into memory")];
        let info = reader.next_frame(&mut dots).expect("a picture");
        let sides = [info.width, info.height].map(f64::from);
        assert_eq!(sides, ["width", "height"].map(|name| 2.0 * side(name).expect("a number")));
        let share = |is_it: &dyn Fn(&[u8]) -> bool| {
            dots.chunks_exact(3).filter(|dot| is_it(dot)).count() as f64 / (sides[0] * sides[1])
        };
        let white = share(&|dot| dot == [255; 3]);
        assert!((0.7..0.99).contains(&white), "{}: {white}", png.name);
        assert!(share(&|dot| dot == [0x00, 0x72, 0xb2]) > 1e-4, "{}: no curve", png.name);
        assert!(share(&|dot| dot == [0x22, 0x22, 0x22]) > 1e-4, "{}: no letters", png.name);
    }
}

/// The text of each object of a PDF, by its table of places.
fn objects(bytes: &[u8]) -> Vec<String> {
    // What is no ASCII is packed, and only its length matters.
    let shown = |&byte: &u8| if byte.is_ascii() { char::from(byte) } else { '.' };
    let text: String = bytes.iter().map(shown).collect();
    assert!(text.starts_with("%PDF-1.") && text.trim_end().ends_with("%%EOF"));
    let place = text.rsplit_once("startxref").expect("a place").1.trim_start();
    let place: usize = place.lines().next().expect("a line").trim().parse().expect("a number");
    let mut lines = text[place..].lines();
    assert_eq!(lines.next().map(str::trim), Some("xref"));
    let count = lines.next().expect("a line").split_once(' ').expect("two numbers").1;
    let count: usize = count.trim().parse().expect("a number");
    let entries = lines.take(count).enumerate().filter(|(_, line)| line.trim_end().ends_with('n'));
    let object = |(number, line): (usize, &str)| {
        let at: usize = line[..10].parse().expect("a place");
        let object = &text[at..];
        assert!(object.starts_with(&format!("{number} 0 obj")), "{}", &object[..20]);
        object[..object.find("endobj").expect("an end")].to_owned()
    };
    entries.map(object).collect()
}

#[test]
fn a_pdf_has_a_page_for_each_figure_and_its_font() {
    let place = swinging();
    let figures = files(&place, Format::Svg).len();
    for file in files(&place, Format::Pdf) {
        let objects = objects(&file.bytes);
        let has = |part: &str| objects.iter().filter(|object| object.contains(part)).count();
        let pages = if file.name == "all.pdf" { figures } else { 1 };
        let is_page =
            |object: &&String| object.contains("/Type /Page\n") || object.contains("/Type /Page ");
        assert_eq!(objects.iter().filter(is_page).count(), pages, "{}", file.name);
        assert_eq!(has(&format!("/Count {pages}")), 1);
        assert_eq!((has("/FontFile2"), has("/ToUnicode")), (1, 1));
        assert!(file.bytes.len() < 100_000, "{}: {}", file.name, file.bytes.len());
    }
}
