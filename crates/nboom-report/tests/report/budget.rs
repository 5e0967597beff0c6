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
