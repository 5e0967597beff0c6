//! `--plots`: figures of a run for documents.

use std::fs;

use crate::{BOOM, Place, code, refused, stderr, stdout};

fn names(place: &Place, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(place.path(folder)).expect("a folder");
    let name = |entry: fs::DirEntry| entry.file_name().into_string().expect("text");
    let mut names: Vec<String> = entries.map(|entry| name(entry.expect("readable"))).collect();
    names.sort();
    names
}

#[test]
fn a_run_draws_its_figures_and_report_draws_the_same() {
    let place = Place::new();
    let output =
        place.nboom(&["run", "boom.nml", "-o", "out", "--quiet", "--plots", "svg,pdf,svg"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let of_the_run = names(&place, "out/plots");
    for name in ["01-deployment-angles.svg", "03-body-rates.pdf", "09-energy.svg", "all.pdf"] {
        assert!(of_the_run.iter().any(|found| found == name), "{name}: {of_the_run:?}");
    }
    assert!(of_the_run.iter().all(|name| !name.ends_with("png")), "{of_the_run:?}");
    let angles = fs::read(place.path("out/plots/01-deployment-angles.svg")).expect("a figure");
    fs::remove_dir_all(place.path("out/plots")).expect("removable");
    let output = place.nboom(&["report", "out", "--plots", "svg"]);
    let told = stdout(&output);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(told.starts_with("out/report.html\nout/plots/01-deployment-angles.svg\n"), "{told}");
    assert_eq!(told.lines().count(), 1 + names(&place, "out/plots").len());
    let made_again = fs::read(place.path("out/plots/01-deployment-angles.svg")).expect("a figure");
    assert!(angles == made_again, "the figure depends on when it is made");
}

#[test]
fn no_figure_of_an_earlier_run_stays_and_what_is_not_of_a_run_does() {
    let place = Place::new();
    let run = |args: &[&str]| {
        place.nboom(&[&["run", "boom.nml", "-o", "out", "--quiet", "--no-report"], args].concat())
    };
    assert_eq!(code(&run(&["--plots", "png"])), 0);
    assert_eq!(code(&run(&[])), 0);
    assert!(!place.path("out/plots").exists());
    assert_eq!(code(&run(&["--plots", "svg"])), 0);
    place.write("out/plots/notes.txt", "mine");
    assert_eq!(code(&run(&["--plots", "pdf"])), 0);
    let left = names(&place, "out/plots");
    assert!(left.iter().all(|name| name.ends_with("pdf") || name == "notes.txt"), "{left:?}");
    place.write("out/plots/03-body-rates.svg", "drawn by hand");
    let before = fs::read(place.path("out/summary.json")).expect("a summary");
    refused(&run(&["--plots", "svg"]), 2, &["03-body-rates.svg", "that no run has written"]);
    assert!(fs::read(place.path("out/summary.json")).expect("a summary") == before);
    let drawn = fs::read_to_string(place.path("out/plots/03-body-rates.svg"));
    assert_eq!(drawn.ok().as_deref(), Some("drawn by hand"));
    assert_eq!(code(&run(&[])), 0, "a run without figures has nothing to do with it");
}

#[test]
fn formats_are_those_that_there_are() {
    let place = Place::new();
    for wrong in ["gif", "svg,,png", "SVG"] {
        let output = place.nboom(&["run", "boom.nml", "--plots", wrong]);
        refused(&output, 2, &["svg, png, pdf expected"]);
    }
    assert!(!place.path("out").exists());
}

#[test]
fn a_run_that_fails_has_figures_up_to_there() {
    let place = Place::new();
    place.write("boom.nml", BOOM);
    let output = place.nboom(&[
        "run",
        "boom.nml",
        "-o",
        "out",
        "--quiet",
        "--max-events",
        "1",
        "--plots",
        "svg",
    ]);
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    let angles = fs::read_to_string(place.path("out/plots/01-deployment-angles.svg"));
    assert!(angles.expect("a figure").contains("The run did not come to its end."));
}

/// Forces of the four kick-off springs at the initial time in the printout of Section 18.
#[test]
fn kick_off_forces_of_the_sample_deck_begin_as_printed() {
    let place = Place::new();
    let deck = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/n-boom-1970.nml");
    let output = place.nboom(&["run", deck, "-o", "out", "--quiet", "--plots", "svg"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let figure =
        fs::read_to_string(place.path("out/plots/06-kick-off-forces.svg")).expect("a figure");
    // The frame is from 0 to 20 F.
    let frame =
        figure.lines().find(|line| line.contains("<polyline") && line.matches(',').count() == 5);
    let ys = |line: &str| -> Vec<f64> {
        let points = line.split('"').nth(1).expect("points").split(' ');
        points.filter_map(|point| point.split_once(',')?.1.parse().ok()).collect()
    };
    let corners = ys(frame.expect("a frame"));
    let (top, bottom) = (corners[0], corners[2]);
    for (hinge, force) in [("1,1", 8.4), ("1,2", 4.0), ("2,1", 0.96), ("2,2", 18.8)] {
        let name = format!("<title>segment {hinge}</title>");
        let curve = figure.lines().find(|line| line.contains(&name)).expect("a curve");
        let drawn = 20.0 * (bottom - ys(curve)[0]) / (bottom - top);
        assert!((drawn - force).abs() < 0.02, "{hinge}: {drawn} instead of {force}");
    }
    for name in ["07-hinge-loads.svg", "08-stresses.svg"] {
        let figure = fs::read_to_string(place.path("out/plots").join(name)).expect("a figure");
        assert_eq!(figure.matches("<title>largest, ").count() % 4, 0, "{name}");
        assert!(figure.contains("<title>largest, segment 2,1</title>"), "{name}");
    }
}

/// Extremes, first and last point of each curve, by its name.
fn curves(figure: &str) -> Vec<(String, [f64; 6])> {
    let curve = |line: &str| {
        let name = line.split("<title>").nth(1)?.split('<').next()?.to_owned();
        let points = line.split("points=\"").nth(1)?.split('"').next()?.split(' ');
        let points = points.map(|point| {
            let (x, y) = point.split_once(',').expect("two coordinates");
            [x, y].map(|number| number.parse::<f64>().expect("a number"))
        });
        let points: Vec<[f64; 2]> = points.collect();
        let least = points.iter().fold(f64::INFINITY, |least, point| least.min(point[1]));
        let most = points.iter().fold(0.0, |most: f64, point| most.max(point[1]));
        let [[x0, y0], [x1, y1]] = [points[0], points[points.len() - 1]];
        Some((name, [x0, y0, x1, y1, least, most]))
    };
    figure.lines().filter(|line| line.starts_with("<polyline")).filter_map(curve).collect()
}

fn texts(figure: &str) -> Vec<&str> {
    let texts = figure.lines().filter(|line| line.starts_with("<text"));
    texts.filter_map(|line| line.split_once('>')).map(|(_, text)| text).collect()
}

/// The figure in `docs/results.md`; `NBOOM_BLESS=1` makes it anew.
#[test]
fn the_figure_of_the_documentation_is_that_of_the_mast() {
    let place = Place::new();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/mast.toml");
    let output = place.nboom(&["run", scene, "-o", "out", "--quiet", "--plots", "svg"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let made = fs::read_to_string(place.path("out/plots/02-hinge-rates.svg")).expect("a figure");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/pictures/mast-rates.svg");
    if std::env::var_os("NBOOM_BLESS").is_some() {
        fs::write(path, &made).expect("docs/pictures can be written");
    }
    let kept = fs::read_to_string(path).expect("a figure");
    assert_eq!(texts(&made), texts(&kept), "NBOOM_BLESS=1 makes it anew");
    let (made, kept) = (curves(&made), curves(&kept));
    assert_eq!(made.len(), kept.len());
    for ((name, places), (other, kept)) in made.iter().zip(&kept) {
        assert_eq!(name, other);
        let near = places.iter().zip(kept).all(|(a, b)| (a - b).abs() < 0.05);
        assert!(near, "{name}: {places:?} {kept:?}");
    }
}

#[test]
fn letters_that_the_font_lacks_are_told_where_they_become_boxes() {
    let place = Place::new();
    place.write("漢.nml", BOOM);
    let told = |file: &str, formats: &str| {
        let output = place.nboom(&["run", file, "-o", "out", "--quiet", "--plots", formats]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        stderr(&output)
    };
    for formats in ["png", "svg,pdf"] {
        let warning = "warning: figures in PNG and PDF have boxes for letters that their font lacks; SVG has them: 漢\n";
        assert_eq!(told("漢.nml", formats), warning);
    }
    assert_eq!(told("漢.nml", "svg"), "");
    assert_eq!(told("boom.nml", "pdf"), "");
}
