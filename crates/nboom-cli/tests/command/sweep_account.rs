//! What a sweep says at its end, and what its cases are called.

use std::fs;

use crate::sweeps::{STUDY, sweep};
use crate::{Place, code, refused, stderr, stdout};

/// A study of the boom in a file of this name, with these keys.
fn place(study: &str, keys: &str) -> Place {
    let place = Place::new();
    place.write(study, &format!("scene = \"boom.nml\"\n{keys}"));
    place
}

/// Two equal arms unfold in a spin: angular momentum alone tells how fast it is at the end, whatever the stiffness of their springs.
const ARMS: &str = r#"
[parameters]
stiffness = 0.5
[run]
end = 12.0
[main_body]
mass = 40.0
inertia = [8.0, 9.0, 10.0]
[initial]
rate_deg = [0.0, 0.0, 30.0]
[[body]]
name = "arm"
repeat = { count = 2, about = "z" }
mass = 2.0
mass_centre = [0.0, 0.8, 0.0]
inertia = { xx = 0.45, yy = 0.01, zz = 0.45 }
[body.hinge]
at = [0.0, 0.4, 0.0]
axis = "z"
start_deg = 100.0
release = { at = 0.5 }
latch_deg = 0.0
spring = { stiffness = "$stiffness", rest_deg = -30.0 }
damper = { damping = 0.3 }
"#;

#[test]
fn nothing_drives_what_only_errors_of_runs_tell_apart() {
    let place = Place::new();
    place.write("scene.toml", ARMS);
    let study = "scene = 'scene.toml'\nmethod = 'grid'\nresults = ['final omega_z', 'impulse of arm 1']\n\
                 [[vary]]\nname = 'k'\npath = 'parameters.stiffness'\npoints = 8\n\
                 uniform = { from = 0.3, to = 0.9 }\n[run]\n";
    for rtol in ["1e-7", "1e-8"] {
        place.write("study.toml", &format!("{study}rtol = {rtol}\n"));
        let account = stdout(&sweep(&place, &["-o", rtol, "--no-report"]));
        let is_driven = |result: &str| {
            let row = account.lines().find(|line| line.starts_with(result)).expect("a row");
            row.contains(" k ")
        };
        assert!(is_driven("impulse of arm 1") && !is_driven("final omega_z"), "{account}");
    }
}

/// A study without a name has that of its file, also where its copy has another file's name.
#[test]
fn cases_are_called_after_the_study_in_its_directory_too() {
    let spin = "path = 'initial.rate_deg[1]'\nuniform = { from = 50.0, to = 60.0 }";
    let place = place("spins.toml", &format!("draws = 3\n[[vary]]\n{spin}\n"));
    let swept = place.nboom(&["sweep", "spins.toml"]);
    assert_eq!(code(&swept), 0, "{}", stderr(&swept));
    let worst = fs::read_dir(place.path("out/spins/worst")).expect("pages");
    for case in worst {
        let name = case.expect("a folder").file_name();
        let name = name.to_str().expect("text");
        let scene = place.summary(&format!("out/spins/worst/{name}"))["scene"].clone();
        assert_eq!(scene, format!("spins, {}", name.replace('-', " ")));
    }
    let run = place.nboom(&["run", "out/spins/study.toml", "--case", "2"]);
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    assert_eq!(place.summary("out/spins-case-2")["scene"], "spins, case 2");
    // Its copy is the same study.
    let again = place.nboom(&["sweep", "out/spins/study.toml"]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
}

#[test]
fn variables_that_vary_together_are_told() {
    let place = Place::new();
    let correlation = "[[correlation]]\nbetween = ['spring', 'spin']\ncoefficient = 0.7\n";
    for (more, is_told) in [("", false), (correlation, true)] {
        let study = STUDY.replacen("draws = 40", "draws = 2", 1) + more;
        place.write("study.toml", &study);
        let output = if is_told { "together" } else { "alone" };
        let account = stdout(&sweep(&place, &["-o", output, "--no-report"]));
        let line = "\nspring, spin vary together: each may seem to drive what another does\n";
        assert_eq!(account.contains(line), is_told, "{account}");
    }
}

#[test]
fn the_table_is_of_cases_without_fault() {
    let place = Place::new();
    let head = |study: &str, more: &[&str]| {
        place.write("study.toml", &study.replacen("draws = 40", "draws = 2", 1));
        let account = stdout(&sweep(&place, more));
        account.lines().nth(2).expect("a head").to_owned()
    };
    assert!(head(STUDY, &[]).starts_with("of cases without fault "));
    let (without, _) = STUDY.split_once("[[fault]]").expect("it has some");
    assert!(head(without, &["-o", "out/other"]).starts_with("   "));
}

#[test]
fn a_sweep_without_a_case_says_why_and_another_where_to_go() {
    let mass = "path = 'main_body.mass'\nvalues = [-1.0]";
    let place = place("study.toml", &format!("draws = 2\n[[vary]]\n{mass}\n"));
    let output = place.nboom(&["sweep", "study.toml"]);
    refused(&output, 3, &["none of 2 cases ran: 2 rejected, 0 failed; case 1 rejected: ", "mass"]);
    place.write("study.toml", STUDY);
    refused(
        &place.nboom(&["sweep", "study.toml", "-o", "out/study"]),
        2,
        &["another sweep found: ", "; name another directory for this one, new or empty"],
    );
}
