//! What became of the hinges, the worst of all, and what the run was made of: in the account, and in
//! `summary.json`.

use std::fs;
use std::process::Command;

use serde_json::{Value, json};

use crate::{Place, code, refused, rows, stderr, stdout};

/// The sample deck: four segments that lock, with stations.
const SAMPLE: &str = include_str!("../../../../examples/n-boom-1970.nml");

fn table(place: &Place, file: &str) -> Vec<Vec<String>> {
    let lines = rows(&place.path("out").join(file));
    lines[1..].iter().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().expect("a number")
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn hinges_that_lock_are_told_with_their_times_and_the_largest_impulse() {
    let place = Place::new();
    place.write("sample.nml", SAMPLE);
    let output = place.nboom(&["run", "sample.nml", "-o", "out"]);
    let account = stdout(&output);
    let summary = place.summary("out");
    let verdict = &summary["verdict"];
    let lock_ups: Vec<_> =
        table(&place, "events.csv").into_iter().filter(|row| row[1] == "lock_up").collect();
    let states = table(&place, "states.csv");
    let last = states.last().expect("rows");
    let hinges = verdict["hinges"].as_array().expect("a list");
    assert_eq!(hinges.len(), 4);
    for (i, hinge) in hinges.iter().enumerate() {
        let label = [&hinge["appendage"], &hinge["segment"]].map(ToString::to_string);
        let row = lock_ups.iter().find(|row| row[2..4] == label).expect("it has locked");
        assert_eq!(hinge["time"], json!(number(&row[0])));
        // Columns as in the contract: fourteen, then five for each hinge.
        assert_eq!(hinge["angle"], json!(number(&last[14 + 5 * i])));
        assert_eq!(hinge["state"], json!(1));
        assert_eq!(last[14 + 5 * i + 4], "1");
    }
    let impulse = largest(lock_ups.iter().map(|row| number(&row[4]).abs()));
    assert_eq!(verdict["largest_impulse"], json!(impulse));
    let line = account.lines().find(|line| line.starts_with("all locked ")).expect("told");
    assert!(["1,1 at 0.1617", "2,2 at 0.3241"].iter().all(|part| line.contains(part)), "{line}");
    assert!(account.contains("\nworst impulse 6439.0932 "), "{account}");
    let worst = largest(table(&place, "stress_envelope.csv").iter().map(|row| number(&row[12])));
    assert_eq!(verdict["worst_load"], json!(worst));
    assert_eq!(verdict["smallest_margin"], Value::Null);
}

#[test]
fn a_run_in_which_nothing_locks_says_how_far_hinges_came() {
    let place = Place::new();
    let output =
        place.nboom(&["run", "boom.nml", "-o", "out", "--end-time", "0.5", "--samples", "2"]);
    let states = table(&place, "states.csv");
    let angle = number(&states.last().expect("rows")[14]);
    let verdict = &place.summary("out")["verdict"];
    // It is on its way, and so nearest to its lock at zero at the end.
    let hinge = json!({
        "appendage": 1, "segment": 1, "state": 0, "time": 0.25, "angle": angle,
        "miss": angle, "miss_time": 0.5, "closing_rate": null,
    });
    assert_eq!(verdict["hinges"], json!([hinge]));
    for key in ["largest_impulse", "worst_load", "smallest_margin"] {
        assert_eq!(verdict[key], Value::Null, "{key}");
    }
    let line = stdout(&output);
    let line = line.lines().find(|line| line.starts_with("none locked ")).expect("told");
    let rest = line.split_once("1,1 free at ").expect("the hinge").1;
    let (told, lock) = rest.split_once(" deg, locks at ").expect("both angles");
    // Told with six digits.
    assert!((number(told) - angle.to_degrees()).abs() < 1e-4, "{line} {angle}");
    assert_eq!(lock, "0 deg");
    let output = place.nboom(&["run", "boom.nml", "-o", "out", "--end-time", "0.1"]);
    assert!(stdout(&output).contains("none locked   1,1 unreleased at 80 deg"), "{output:?}");
    assert_eq!(place.summary("out")["verdict"]["hinges"][0]["time"], Value::Null);
}

/// A boom on a spring that swings from 1 rad through 0 to -1 rad and back, twice; its main body is held.
fn swinging(lock_angle: f64) -> String {
    format!(
        "name = \"swing\"\n[run]\nend = 12.0\n\
         [main_body]\nmass = 10.0\ninertia = [1.0, 1.0, 1.0]\nbase = \"fixed\"\n\
         [[body]]\nname = \"boom\"\nmass = 1.0\nmass_centre = [1.0, 0.0, 0.0]\ninertia = [0.1, 1.0, 1.0]\n\
         [body.hinge]\nat = [0.0, 0.0, 0.0]\naxis = \"z\"\nstart_rad = 1.0\nlatch_rad = {lock_angle}\n\
         spring = {{ stiffness = 2.0 }}\n"
    )
}

#[test]
fn a_latch_that_errors_of_the_run_may_have_kept_open_is_told() {
    let place = Place::new();
    // The moment of inertia about the hinge is 2, so β = cos t.
    for (gap, told, warned) in
        [(0.1, "nearest at 3.14159: 5.72958 deg away", false), (1e-8, "nearest at 3.14159", true)]
    {
        place.write("swing.toml", &swinging(-1.0 - gap));
        let output = place.nboom(&["run", "swing.toml", "-o", "out"]);
        assert_eq!(code(&output), 0, "{output:?}");
        assert!(stdout(&output).contains(told), "{output:?}");
        let warning = "from its lock angle at 3.14159 and does not lock";
        assert_eq!(stderr(&output).contains(warning), warned, "{output:?}");
        let hinge = &place.summary("out")["verdict"]["hinges"][0];
        let [miss, time] =
            ["miss", "miss_time"].map(|key| hinge[key].as_f64().expect("it is free"));
        assert!((miss - gap).abs() < 1e-9 && (time - std::f64::consts::PI).abs() < 1e-4, "{hinge}");
    }
}

#[test]
fn a_negative_margin_is_told_even_when_quiet() {
    let place = Place::new();
    place.write("sample.nml", SAMPLE);
    for (yield_stress, is_negative) in [("1e5", true), ("1e7", false)] {
        let words = ["run", "sample.nml", "-o", "out", "--quiet", "--yield-stress", yield_stress];
        let output = place.nboom(&words);
        let told = stderr(&output);
        assert_eq!(code(&output), 0, "{told}");
        let verdict = &place.summary("out")["verdict"];
        let margins = table(&place, "stress_envelope.csv");
        let margins = margins.iter().filter(|row| !row[14].is_empty());
        let least = -largest(margins.map(|row| -number(&row[14])));
        assert_eq!(verdict["smallest_margin"], json!(least));
        let line = told.lines().find(|line| line.starts_with("warning: negative margin: "));
        assert_eq!(line.is_some(), is_negative && least < 0.0, "{told}");
        let at = &verdict["smallest_margin_at"];
        let place =
            format!("segment {},{}, station {}", at["appendage"], at["segment"], at["station"]);
        assert!(line.is_none_or(|line| line.contains(&place)), "{told}: {place}");
    }
}

#[test]
fn a_summary_names_the_program_and_hashes_its_input() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["run", "boom.nml", "-o", "out"])), 0);
    let summary = place.summary("out");
    assert_eq!(summary["version"], env!("CARGO_PKG_VERSION"));
    let known = Command::new("sha256sum").arg(place.path("boom.nml")).output();
    let known = String::from_utf8(known.expect("a unix system").stdout).expect("text");
    let hash = summary["input_sha256"].as_str().expect("a text");
    assert_eq!(known.split(' ').next(), Some(hash));
}

#[test]
fn series_are_said_to_be_series_and_take_no_code() {
    let place = Place::new();
    let series = ["run", "boom.nml", "-o", "out", "--integrator", "taylor"];
    let output = place.nboom(&series);
    assert!(stdout(&output).contains("series path, articulated formulation, integrator taylor"));
    let summary = place.summary("out");
    assert_eq!((&summary["path"], &summary["generated_share"]), (&json!("series"), &json!(0.0)));
    for ignored in
        [["--path", "generated"], ["--path", "generic"], ["--formulation", "articulated"]]
    {
        let output = place.nboom(&[&series[..], &ignored].concat());
        refused(&output, 2, &[ignored[0], "integrator taylor"]);
    }
    let output = place.nboom(&[&series[..], &["--path", "auto"]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}

#[test]
fn options_that_act_on_nothing_are_refused_or_said() {
    let place = Place::new();
    place.write("sample.nml", SAMPLE);
    let cases: &[(&str, &[&str], &[&str])] = &[
        (
            "boom.nml",
            &["--yield-stress", "1e5"],
            &["--yield-stress", "no stations, which in a deck"],
        ),
        (
            "boom.nml",
            &["--amplification", "1.5"],
            &["--amplification", "`pulse_constant` of each body they act on"],
        ),
        ("boom.nml", &["--report-signs"], &["--report-signs", "no stations, which in a deck"]),
        ("sample.nml", &["--safety-factor", "1.5"], &["--yield-stress"]),
        ("sample.nml", &["--amplification", "7"], &["--amplification", "from 1 to 2"]),
        ("sample.nml", &["--amplification", "0.5"], &["--amplification", "from 1 to 2"]),
        ("sample.nml", &["--no-stresses", "--yield-stress", "1e5"], &["--no-stresses"]),
        ("sample.nml", &["--no-stresses", "--amplification", "2"], &["--no-stresses"]),
        ("sample.nml", &["--no-stresses", "--report-signs"], &["--no-stresses"]),
        ("sample.nml", &["--no-stresses", "--pulses", "all-at-once"], &["--pulses"]),
        (
            "boom.nml",
            &["--hinge-loads", "--pulses", "all-at-once"],
            &["--pulses", "no pulses of latches"],
        ),
    ];
    for (deck, options, words) in cases {
        let output = place.nboom(&[&["run", deck][..], options].concat());
        refused(&output, 2, words);
    }
    assert!(!place.path("out").exists());
    let idle = "tube-shear (nothing in this run shows these slips of 1970)";
    let bound = "--rtol (EU1 of the deck bounds the errors of rkam)";
    let said: &[(&[&str], &str, bool)] = &[
        (&["--no-stresses", "--as-1970=tube-shear"], idle, true),
        (&["--as-1970=tube-shear"], idle, false),
        (&["--integrator", "rkam", "--end-time", "0.1", "--rtol", "1e-7"], bound, true),
        (&["--integrator", "rkam", "--end-time", "0.1"], bound, false),
        (&["--rtol", "1e-7"], bound, false),
    ];
    for (options, words, is_said) in said {
        let output = place.nboom(&[&["run", "sample.nml", "-o", "out"][..], options].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let told = stderr(&output);
        let mut notes = told.lines().filter(|line| line.starts_with("note: ignored: "));
        assert_eq!(notes.any(|line| line.contains(words)), *is_said, "{options:?}: {told}");
    }
}

/// A panel that a spring opens until it latches.
const PANEL: &str = r#"
name = "panel"
[run]
end = 4.0
[output]
files = ["hinge_loads"]
[main_body]
mass = 100.0
inertia = [9.0, 9.0, 9.0]
[[body]]
name = "panel"
mass = 2.0
mass_centre = [0.0, 0.5, 0.0]
inertia = [0.2, 0.01, 0.2]
[body.hinge]
at = [0.0, 0.2, 0.0]
axis = "x"
start_deg = 30.0
release = { at = 0.0 }
latch_deg = 0.0
spring = { stiffness = 2.0, rest_deg = 0.0 }
"#;

#[test]
fn hinge_loads_say_whether_they_have_the_pulses_of_latches() {
    const WITHOUT: &str =
        "without pulses of latches and stops, which need pulse_constant of each body they act on";
    let place = Place::new();
    let with = PANEL.replace("mass = 2.0", "mass = 2.0\npulse_constant = 0.001");
    let moments = [PANEL, &with].map(|scene| {
        place.write("panel.toml", scene);
        let output = place.nboom(&["run", "panel.toml", "-o", "out", "--plots", "svg"]);
        let account = stdout(&output);
        let summary = place.summary("out");
        let has_pulses = scene != PANEL;
        assert_eq!(summary["latch_pulses"], json!(has_pulses), "{account}");
        let figure =
            fs::read_to_string(place.path("out/plots/07-hinge-loads.svg")).expect("a figure");
        for text in [account, figure] {
            assert_eq!(text.contains(WITHOUT), !has_pulses, "{text}");
        }
        summary["verdict"]["largest_hinge_moment"].as_f64().expect("a moment")
    });
    // The latch stops the panel, I about 0.7, in a millisecond: its moment is far above that of the spring.
    assert!(moments[1] > 100.0 * moments[0], "{moments:?}");
}

/// A pulse constant is none of a pulse where nothing latches, be it for want of a latch or of a release.
#[test]
fn options_of_pulses_are_refused_where_no_hinge_latches() {
    let place = Place::new();
    let with = PANEL.replace("mass = 2.0", "mass = 2.0\npulse_constant = 0.001");
    for idle in [
        with.replace("latch_deg = 0.0\n", ""),
        with.replace("release = { at = 0.0 }", "state = \"held\""),
    ] {
        place.write("panel.toml", &idle);
        for option in [["--amplification", "1.5"], ["--pulses", "all-at-once"]] {
            let output = place.nboom(&[&["run", "panel.toml"][..], &option].concat());
            refused(&output, 2, &[option[0], "no hinge latches"]);
        }
    }
    assert!(!place.path("out").exists());
    place.write("panel.toml", &with);
    let output = place.nboom(&["run", "panel.toml", "--amplification", "1.5"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // A fault of a study may leave no latch; that is no mistake of its options.
    place.write(
        "study.toml",
        "scene = 'panel.toml'\ndraws = 1\n[run]\namplification = 1.5\n\
         [[fault]]\nname = 'failed'\nfailed_latch = ['panel']\n",
    );
    for case in ["1", "2"] {
        let output = place.nboom(&["run", "study.toml", "--case", case]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_eq!(stdout(&output).contains("judged by"), case == "1", "{}", stdout(&output));
    }
}

/// A force table that rises beyond its last point drives a slide out by itself: its travel grows as an exponential.
#[test]
fn a_motion_that_runs_away_is_told_of_though_its_end_is_reached() {
    let place = Place::new();
    let scene = |end: f64| {
        format!(
            "[run]\nend = {end}\n[main_body]\nmass = 100.0\ninertia = [40.0, 30.0, 20.0]\n[[body]]\nname = \"mast\"\n\
             mass = 2.0\nmass_centre = [0.0, 1.0, 0.0]\ninertia = [1.0, 0.1, 1.0]\n[body.slide]\nat = [0.0, 1.0, 0.0]\n\
             axis = \"y\"\nstart = 0.1\nforce = [[0.0, 0.0], [0.1, 5.0]]\n"
        )
    };
    let told = "hinge 1,1 (mast): the motion runs away, with";
    for (end, is_told) in [(0.5, false), (3.0, true)] {
        place.write("mast.toml", &scene(end));
        let run = place.nboom(&["run", "mast.toml", "--quiet"]);
        assert_eq!(code(&run), 0, "{}", stderr(&run));
        assert_eq!(stderr(&run).contains(told), is_told, "{}", stderr(&run));
        let warnings = place.summary("out/mast")["warnings"].to_string();
        assert_eq!(warnings.contains(told), is_told, "{warnings}");
        let troubles = place.summary("out/mast")["troubles"].to_string();
        assert_eq!(troubles != "[]", is_told, "{troubles}");
        assert_eq!(troubles.contains(told), is_told, "{troubles}");
        assert!(
            warnings.contains("force table of hinge 1,1 (mast) drives it on and on"),
            "{warnings}"
        );
    }
}

/// A latch or a stop of 20 ms, given in ms: the panel would go round and round until it rests.
#[test]
fn a_pulse_in_which_the_hinge_would_go_round_is_told() {
    let place = Place::new();
    let cases = [("latch_deg = 0", "latch"), ("stops_deg = [-180, 0]", "stop")]
        .map(|end| [(end, 0.02, false), (end, 20.0, true)]);
    for ((end, what), constant, is_told) in cases.concat() {
        place.write(
            "panel.toml",
            &format!(
                "[run]\nend = 60.0\n[main_body]\nmass = 1e6\ninertia = [1e6, 1e6, 1e6]\n[[body]]\nname = \"panel\"\n\
                 mass = 2.0\nmass_centre = [0.0, 1.0, 0.0]\ninertia = [1.0, 0.1, 1.0]\npulse_constant = {constant}\n\
                 [body.hinge]\nat = [0.0, 0.0, 0.0]\naxis = \"x\"\nstart_deg = -90\nrate_rad = 3.183098861837907\n{end}\n"
            ),
        );
        let run = place.nboom(&["run", "panel.toml", "--quiet"]);
        assert_eq!(code(&run), 0, "{}", stderr(&run));
        let troubles = place.summary("out/panel")["troubles"].to_string();
        for told in
            ["hinge 1,1 (panel) would move on by 286", &format!("the pulse of its {what}, ")]
        {
            assert_eq!(stderr(&run).contains(told), is_told, "{}", stderr(&run));
            assert_eq!(troubles.contains(told), is_told, "{troubles}");
        }
        let check = stdout(&place.nboom(&["check", "panel.toml"]));
        let lasts =
            if is_told { "20, half a sine of 31.4159" } else { "0.02, half a sine of 0.0314159" };
        let line = format!("  segment 1,1 (panel): pulse: impulse over peak {lasts}\n");
        assert!(check.contains(&line), "{check}");
    }
}
