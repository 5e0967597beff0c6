//! The page of a run, as the command writes it.

use std::fs;

use crate::{BOOM, Place, code, refused, stderr, stdout};

/// A place with a deck, and a run of it with these options into `out`.
fn run(place: &Place, args: &[&str]) {
    place.write("boom.nml", BOOM);
    let output = place.nboom(&[&["run", "boom.nml", "-o", "out", "--quiet"], args].concat());
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn a_run_leaves_its_page_and_report_makes_the_same() {
    let place = Place::new();
    run(&place, &[]);
    let of_the_run = fs::read(place.path("out/report.html")).expect("a page");
    fs::remove_file(place.path("out/report.html")).expect("it is there");
    let output = place.nboom(&["report", "out"]);
    assert_eq!((code(&output), stdout(&output)), (0, "out/report.html\n".to_owned()));
    let made_again = fs::read(place.path("out/report.html")).expect("a page");
    assert!(of_the_run == made_again, "the page depends on when it is made");
}

#[test]
fn no_page_of_an_earlier_run_stays() {
    let place = Place::new();
    run(&place, &["--no-report"]);
    assert!(!place.path("out/report.html").exists());
    // A page that was made later does not stand in the way of the next run.
    assert_eq!(code(&place.nboom(&["report", "out"])), 0);
    run(&place, &["--no-report", "--samples", "7"]);
    assert!(!place.path("out/report.html").exists());
    run(&place, &["--samples", "8"]);
    assert!(place.path("out/report.html").exists());
}

#[test]
fn several_runs_share_a_page() {
    let place = Place::new();
    run(&place, &[]);
    let output = place.nboom(&[
        "run",
        "boom.nml",
        "-o",
        "other",
        "--quiet",
        "--formulation",
        "symmetric",
        "--path",
        "generic",
    ]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let output = place.nboom(&["report", "out", "other"]);
    assert_eq!((code(&output), stdout(&output)), (0, "comparison.html\n".to_owned()));
    let page = fs::read_to_string(place.path("comparison.html")).expect("a page");
    for part in ["\"label\":\"out\"", "\"label\":\"other\"", "\"formulation\":\"symmetric\""] {
        assert!(page.contains(part), "{part}");
    }
    let output = place.nboom(&["report", "out", "-o", "page.html"]);
    assert_eq!(code(&output), 0);
    assert!(place.path("page.html").exists());
}

#[test]
fn what_is_no_run_is_refused_and_half_a_run_is_shown() {
    let place = Place::new();
    for (directory, part) in [
        ("nowhere", "no directory of a run found"),
        ("empty", "neither summary.json nor states.csv found"),
    ] {
        if directory == "empty" {
            fs::create_dir(place.path(directory)).expect("writable");
        }
        let output = place.nboom(&["report", directory]);
        assert_eq!(code(&output), 2, "{directory}");
        assert!(stderr(&output).contains(part), "{}", stderr(&output));
    }
    run(&place, &[]);
    refused(&place.nboom(&["report", "out/states.csv"]), 2, &["no directory of a run found"]);
    let states = fs::read_to_string(place.path("out/states.csv")).expect("a table");
    place.write("out/states.csv", &states[..states.len() / 2]);
    let output = place.nboom(&["report", "out"]);
    assert_eq!(code(&output), 0);
    assert!(stderr(&output).contains("note: out: states.csv, line"), "{}", stderr(&output));
}

#[test]
fn a_page_is_an_html_file_and_no_input() {
    let place = Place::new();
    run(&place, &[]);
    let states = fs::read(place.path("out/states.csv")).expect("a table");
    let output = place.nboom(&["report", "out", "-o", "out/states.csv"]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert!(fs::read(place.path("out/states.csv")).expect("a table") == states);
}

#[test]
fn a_page_that_nboom_has_not_made_stays() {
    let place = Place::new();
    run(&place, &["--no-report"]);
    for (file, words) in [
        ("notes.html", &["report", "out", "-o", "notes.html"][..]),
        ("out/report.html", &["report", "out"]),
        ("comparison.html", &["report", "out", "out"]),
    ] {
        place.write(file, "<p>my notes</p>");
        refused(&place.nboom(words), 2, &[file, "a file that nboom has not made"]);
        let kept = fs::read_to_string(place.path(file)).expect("still there");
        assert_eq!(kept, "<p>my notes</p>");
    }
}

#[test]
fn the_page_of_a_sweep_goes_where_it_is_asked_for_and_stands_alone() {
    let place = Place::new();
    run(&place, &[]);
    let vary = "[[vary]]\npath = 'initial.rate_deg[1]'\nuniform = { from = 50.0, to = 60.0 }\n";
    place.write("study.toml", &format!("scene = 'boom.nml'\ndraws = 2\n{vary}"));
    assert_eq!(code(&place.nboom(&["sweep", "study.toml", "-o", "all", "--quiet"])), 0);
    fs::remove_file(place.path("all/report.html")).expect("it is there");
    let reports = |page: &str| {
        let page = fs::read_to_string(place.path(page)).expect("a page");
        !page.contains("\"reports\":[]")
    };
    for (page, has_links) in [("page.html", false), ("all/page.html", true)] {
        let output = place.nboom(&["report", "all", "-o", page]);
        assert_eq!((code(&output), stdout(&output)), (0, format!("{page}\n")));
        assert_eq!(reports(page), has_links, "pages of cases are in all/worst");
    }
    assert!(!place.path("all/report.html").exists());
    refused(&place.nboom(&["report", "all", "-o", "page.txt"]), 2, &["page.txt", "NAME.html"]);
    refused(&place.nboom(&["report", "all", "--plots", "svg"]), 2, &["--plots", "all", "sweep"]);
    for directories in [["all", "all"], ["out", "all"], ["all", "out"]] {
        let output = place.nboom(&[&["report"][..], &directories].concat());
        refused(&output, 2, &["all: found a sweep", "cannot be compared"]);
    }
    assert!(!place.path("comparison.html").exists());
}

#[test]
fn runs_in_other_units_share_no_axes() {
    let place = Place::new();
    run(&place, &["--units", "SI"]);
    let other = place.nboom(&["run", "boom.nml", "-o", "feet", "--quiet", "--units", "ft-lbf-s"]);
    assert_eq!(code(&other), 0, "{}", stderr(&other));
    let output = place.nboom(&["report", "out", "feet"]);
    refused(&output, 2, &["feet: found units ft, s, lbf, expected m, s, N as in out"]);
    assert!(!place.path("comparison.html").exists());
}
