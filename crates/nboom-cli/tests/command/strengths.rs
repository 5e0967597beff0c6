//! Margins of parts of different materials.

use std::f64::consts::TAU;

use serde_json::Value;

use crate::{Place, code, refused, rows, stderr, stdout};

/// A symmetric satellite that spins about z with two locked rods along y and -y: each root carries
/// m ω² r = 3 · 2² · 1.5 and nothing else.
const SPINNER: &str = r#"
[run]
end = 1.0

[main_body]
mass = 100.0
inertia = [10.0, 10.0, 15.0]

[initial]
rate_rad = [0.0, 0.0, 2.0]

[materials.steel]
youngs_modulus = 2.0e11
yield_stress = 60000.0

[materials.plastic]
youngs_modulus = 2.0e9
yield_stress = 40000.0
ultimate_stress = 42000.0

[[body]]
name = "strong rod"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.01, 1.0]
material = "steel"

[body.hinge]
at = [0.0, 0.5, 0.0]
axis = "x"
state = "locked"

[[body.station]]
at = 0.0
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.01, 1.0]
section = { tube = { radius = 0.05, thickness = 0.002 } }

[[body]]
name = "weak rod"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.01, 1.0]
material = "plastic"

[body.hinge]
at = [0.0, -0.5, 0.0]
axis = "x"
axes = { turn = { about = "z", by_deg = 180.0 } }
state = "locked"

[[body.station]]
at = 0.0
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.01, 1.0]
section = { tube = { radius = 0.05, thickness = 0.002 } }
"#;

/// The stress of a root: its force over the area of the thin wall.
fn stress() -> f64 {
    3.0 * 2.0 * 2.0 * 1.5 / (TAU * 0.05 * 0.002)
}

/// Columns `margin` and `ultimate_margin` of both rods, after a run with these options.
fn margins(place: &Place, options: &[&str]) -> [[Option<f64>; 2]; 2] {
    place.write("spinner.toml", SPINNER);
    let run = place.nboom(&[&["run", "spinner.toml", "-o", "out"], options].concat());
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    let table = rows(&place.path("out/stress_envelope.csv"));
    let cells = |row: &String| row.split(',').map(str::to_owned).collect::<Vec<_>>();
    let header = cells(&table[0]);
    let column = |name: &str| header.iter().position(|column| column == name).expect(name);
    assert_eq!(column("ultimate_margin"), header.len() - 1);
    let of_rod = |row: &String| {
        let row = cells(row);
        ["margin", "ultimate_margin"].map(|name| row[column(name)].parse().ok())
    };
    [of_rod(&table[1]), of_rod(&table[2])]
}

fn assert_near(found: Option<f64>, expected: f64) {
    let found = found.expect("a margin");
    // The motion keeps the spin to the tolerance of the run, 1e-9.
    assert!((found - expected).abs() < 1e-8, "{found} {expected}");
}

#[test]
fn margins_follow_from_the_strength_of_each_part() {
    let place = Place::new();
    let [strong, weak] = margins(&place, &[]);
    assert_near(strong[0], 60000.0 / stress() - 1.0);
    assert_eq!(strong[1], None, "steel has no ultimate stress here");
    assert_near(weak[0], 40000.0 / stress() - 1.0);
    assert_near(weak[1], 42000.0 / stress() - 1.0);
    // With both factors the margin of the weak rod to breaking is the smaller one.
    let options = ["--safety-factor", "1.1", "--ultimate-factor", "1.6"];
    let [strong, weak] = margins(&place, &options);
    assert_near(strong[0], 60000.0 / (1.1 * stress()) - 1.0);
    let expected = 42000.0 / (1.6 * stress()) - 1.0;
    assert_near(weak[1], expected);
    let verdict = &place.summary("out")["verdict"];
    assert_near(verdict["smallest_margin"].as_f64(), expected);
    let at = &verdict["smallest_margin_at"];
    assert_eq!((&at["name"], &at["limit"]), (&Value::from("weak rod"), &Value::from("ultimate")));
    // The command line speaks for all parts.
    let [strong, weak] = margins(&place, &["--yield-stress", "50000"]);
    assert_near(strong[0], 50000.0 / stress() - 1.0);
    assert_near(weak[0], 50000.0 / stress() - 1.0);
}

#[test]
fn the_weakest_part_is_told_by_name() {
    let place = Place::new();
    place.write("spinner.toml", SPINNER);
    let run = place.nboom(&["run", "spinner.toml", "--ultimate-factor", "1.6"]);
    let told = stdout(&run);
    let line = told.lines().find(|line| line.starts_with("margin ")).expect("told");
    assert!(line.contains(" to ultimate, in segment 2,1 (weak rod), station 1, at "), "{line}");
    let warning = "negative margin: -0.0837 to the ultimate stress in segment 2,1 (weak rod)";
    assert!(stderr(&run).contains(warning), "{}", stderr(&run));
}

#[test]
fn one_strength_of_all_parts_is_told_with_the_largest_stress() {
    let place = Place::new();
    place.write("spinner.toml", &SPINNER.replace("ultimate_stress = 42000.0\n", ""));
    let told = stdout(&place.nboom(&["run", "spinner.toml", "--yield-stress", "50000"]));
    assert!(
        told.contains(", margin 0.745; of thin walls") && !told.contains("\nmargin "),
        "{told}"
    );
}

#[test]
fn factors_without_a_strength_are_refused() {
    let place = Place::new();
    let without = |key: &str| {
        let lines = SPINNER.lines().filter(|line| !line.starts_with(key));
        lines.collect::<Vec<_>>().join("\n")
    };
    place.write("no-yield.toml", &without("yield_stress"));
    let run = place.nboom(&["run", "no-yield.toml", "--safety-factor", "1.5"]);
    refused(&run, 2, &["--safety-factor has no effect", "has a yield stress", "--yield-stress"]);
    place.write("no-ultimate.toml", &without("ultimate_stress"));
    let run = place.nboom(&["run", "no-ultimate.toml", "--ultimate-factor", "1.5"]);
    refused(&run, 2, &["--ultimate-factor has no effect", "has an ultimate stress"]);
}

#[test]
fn a_part_that_breaks_is_told_though_another_margin_is_smaller() {
    let place = Place::new();
    // Half of what the rod bears before it breaks, a quarter of it before it yields.
    let weak = SPINNER
        .replace("yield_stress = 40000.0", &format!("yield_stress = {}", 0.25 * stress()))
        .replace("ultimate_stress = 42000.0", &format!("ultimate_stress = {}", 0.5 * stress()));
    place.write("spinner.toml", &weak);
    let run = place.nboom(&["run", "spinner.toml", "-o", "out"]);
    for warning in [
        "negative margin: -0.75 in segment 2,1 (weak rod), station 1",
        "negative margin: -0.5 to the ultimate stress in segment 2,1 (weak rod), station 1",
    ] {
        assert!(stderr(&run).contains(warning), "{}", stderr(&run));
    }
    let line = "margin        at least -0.5 to ultimate, in segment 2,1 (weak rod), station 1, at ";
    assert!(stdout(&run).contains(line), "{}", stdout(&run));
    let verdict = &place.summary("out")["verdict"];
    for (limit, margin) in [("yield", -0.75), ("ultimate", -0.5)] {
        let key = format!("smallest_{limit}_margin");
        assert_near(verdict[&key].as_f64(), margin);
        assert_eq!(verdict[format!("{key}_at")]["name"], "weak rod");
    }
    let page = std::fs::read_to_string(place.path("out/report.html")).expect("a page");
    assert!(page.contains("\"ultimate_margin\":-0."), "the page has it");
}

#[test]
fn what_margins_leave_out_is_told() {
    let place = Place::new();
    place.write("spinner.toml", &SPINNER.replacen("yield_stress = 60000.0\n", "", 1));
    let warning = "margins leave out stations whose material has no strength: those of segment 1,1 (strong rod)";
    let line = "\nmargin        none for 1 of 2 stations, whose materials have no strength\n";
    for (options, is_told) in [(&[][..], true), (&["--yield-stress", "50000"], false)] {
        let run = place.nboom(&[&["run", "spinner.toml", "-o", "out"], options].concat());
        assert_eq!(stderr(&run).contains(warning), is_told, "{}", stderr(&run));
        assert_eq!(stdout(&run).contains(line), is_told, "{}", stdout(&run));
        let warnings = place.summary("out")["warnings"].to_string();
        assert_eq!(warnings.contains(warning), is_told, "{warnings}");
    }
    place.write("study.toml", "scene = 'spinner.toml'\ndraws = 2\nresults = ['verdict.smallest_margin']\n\
                 [[vary]]\nname = 'mass'\npath = 'main_body.mass'\nuniform = { from = 90.0, to = 110.0 }\n");
    let sweep = place.nboom(&["sweep", "study.toml"]);
    assert!(stderr(&sweep).contains(warning), "{}", stderr(&sweep));
}
