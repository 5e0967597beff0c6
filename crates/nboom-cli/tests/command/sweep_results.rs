//! What a sweep says of its results.

use crate::sweeps::{cases, sweep};
use crate::{Place, code, stderr};

/// Two panels on `+x` and `-x`, from rest.
const PANELS: &str = r#"
[run]
end = 3.0

[main_body]
mass = 10.0
inertia = [1.0, 1.0, 1.0]

[[body]]
name = "panel +x"
mass = 1.0
mass_centre = [0.5, 0.0, 0.0]
inertia = [0.1, 0.1, 0.1]
hinge = { at = [0.2, 0.0, 0.0], axis = "y", start_deg = 90.0, latch_deg = 0.0, spring = { stiffness = 0.5 } }

[[body]]
name = "panel -x"
mass = 1.0
mass_centre = [-0.5, 0.0, 0.0]
inertia = [0.1, 0.1, 0.1]
hinge = { at = [-0.2, 0.0, 0.0], axis = "-y", start_deg = 90.0, latch_deg = 0.0, spring = { stiffness = 0.5 } }
"#;

#[test]
fn names_that_differ_in_a_sign_have_columns_of_their_own_and_no_momentum_has_no_nutation() {
    let place = Place::new();
    place.write("panels.toml", PANELS);
    let vary =
        "[[vary]]\nname = 'hub'\npath = 'main_body.mass'\nuniform = { from = 9.0, to = 11.0 }\n";
    place.write("study.toml", &format!("scene = 'panels.toml'\ndraws = 9\n{vary}"));
    sweep(&place, &["--no-report"]);
    for case in cases(&place, "out/study") {
        let [first, second] = ["lock_time_of_1_1", "lock_time_of_2_1"].map(|name| &case[name]);
        assert!(!first.is_empty() && first == second, "they mirror each other: {case:?}");
        assert_eq!(case["final_nutation"], "", "rounding has no direction");
    }
}

#[test]
fn the_worst_margins_are_the_smallest() {
    let place = Place::new();
    let study = "scene = 'four.toml'\ndraws = 12\nresults = ['verdict.smallest_margin']\n";
    let vary = "[[vary]]\nname = 'root'\npath = 'parameters.damping'\nas = 'factor'\nuniform = { from = 0.05, to = 1.6 }\n";
    place.write("four.toml", include_str!("../../../../examples/solar-array.toml"));
    place.write("study.toml", &format!("{study}{vary}"));
    let output = place.nboom(&["sweep", "study.toml", "--csv"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let mut margins: Vec<(f64, String)> = cases(&place, "out/study")
        .iter()
        .map(|case| {
            (case["verdict_smallest_margin"].parse().expect("a margin"), case["case"].clone())
        })
        .collect();
    margins.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (margin, case) in &margins[..5] {
        let page = place.path("out/study/worst").join(format!("case-{case}/report.html"));
        assert!(page.is_file(), "{margin} of case {case} is among the worst: {margins:?}");
    }
    let is_told = stderr(&output).contains(&format!("in case {}", margins[0].1));
    assert_eq!(is_told, margins[0].0 < 0.0, "{}", stderr(&output));
}
