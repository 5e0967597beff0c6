use std::fs;

use nboom_report::MOST_BYTES;

use crate::directory::{Chain, page_of};

#[test]
fn twenty_segments_with_stresses_are_a_small_page() {
    let place = Chain { segments: 20, samples: 200, stations: 10 }.write();
    let page = page_of(place.path());
    assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
    assert!(!page.contains("rows. Extremes and events"), "nothing is left out");
}

#[test]
fn a_hundred_segments_with_ten_thousand_samples_are_a_small_page() {
    let place = Chain { segments: 100, samples: 10_000, stations: 0 }.write();
    let page = page_of(place.path());
    assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
    assert!(page.contains("of 10001 rows. Extremes and events are all there"));
}

#[test]
fn so_is_a_page_of_a_hundred_segments_with_loads_and_stresses() {
    let place = Chain { segments: 100, samples: 1000, stations: 5 }.write();
    let page = page_of(place.path());
    assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
}

#[test]
fn a_page_of_many_runs_has_room_for_each() {
    let place = Chain { segments: 20, samples: 5000, stations: 0 }.write();
    let runs = (0..8).map(|_| nboom_report::Run::read(place.path()).expect("a run"));
    let page = nboom_report::page(runs.collect());
    assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
}

/// Rows that the page has, and how far its curves are off in per cent, as it says.
fn rows_and_deviation(page: &str) -> (usize, f64) {
    let between = |before: &str, after: &str| {
        let (_, rest) = page.split_once(before).expect(before);
        rest.split_once(after).expect(after).0.to_owned()
    };
    let rows = between("The page has ", " of 40001 rows").parse().expect("a count");
    (rows, between("off by at most ", " %").parse().expect("a number"))
}

/// A satellite at rest whose boom swings has momenta and a nutation that only rounding moves.
#[test]
fn momenta_that_are_rounding_take_no_rows_from_curves() {
    let place = Chain { segments: 1, samples: 40_000, stations: 0 }.write();
    let path = place.path().join("states.csv");
    let waves = fs::read_to_string(&path).expect("a table");
    let (header, _) = waves.split_once('\n').expect("a line");
    let is_noise: Vec<bool> =
        header.split(',').map(|name| name.contains("_momentum_") || name == "nutation").collect();
    let (mut rows, mut deviations) = (Vec::new(), Vec::new());
    for size in [1e-16, 1.0] {
        let mut random = 1u32;
        let mut noise = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            size * f64::from(random >> 8) / f64::from(1u32 << 24)
        };
        let mut line = |line: &str| {
            let fields = line.split(',').zip(&is_noise);
            let field = |(field, is_noise): (&str, &bool)| {
                if *is_noise { format!("{:e}", noise()) } else { field.to_owned() }
            };
            fields.map(field).collect::<Vec<_>>().join(",")
        };
        let lines: Vec<String> = waves.lines().skip(1).map(&mut line).collect();
        fs::write(&path, format!("{header}\n{}\n", lines.join("\n"))).expect("writable");
        let (kept, deviation) = rows_and_deviation(&page_of(place.path()));
        rows.push(kept);
        deviations.push(deviation);
    }
    assert!(rows[0] < rows[1] / 2, "{rows:?}");
    assert!(deviations[0] <= 0.03 && deviations[1] > 1.0, "{deviations:?}");
}
