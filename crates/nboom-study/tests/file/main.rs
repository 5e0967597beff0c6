//! Studies as files: what is read, and what is told about those that are wrong.

mod alone;
mod effects;
mod names;
mod reasons;
mod schema;
mod together;

use std::fs;

use nboom_io::InputError;
use nboom_study::{Distribution, FailureMode, LateRelease, Method, Relation, Study};
use proptest::prelude::*;
use tempfile::TempDir;

const SCENE: &str = r#"
[run]
end = 10.0

[parameters]
k = 2.0

[main_body]
mass = 100.0
inertia = [40.0, 30.0, 20.0]

[[body]]
name = "boom"
mass = 3.0
mass_centre = [1.0, 0.0, 0.0]
inertia = [0.1, 1.0, 1.0]

[body.hinge]
at = [0.5, 0.0, 0.1]
axis = "z"
start_deg = 90.0
release = { at = 1.0 }
latch_deg = 0.0
spring = { stiffness = "$k", rest_deg = -10.0 }

[[body]]
name = "tip"
on = "boom"
mass = 1.0
mass_centre = [1.0, 0.0, 0.0]
inertia = [0.1, 1.0, 1.0]

[body.hinge]
at = [2.0, 0.0, 0.0]
axis = "z"
release = { when = "boom", passes_deg = 45.0 }
"#;

const STUDY: &str = r#"scene = "scene.toml"
name = "all of it"
seed = 7
method = "monte_carlo"
draws = 20
results = ["lock_time of boom", "final omega_z"]
trajectories = true

[run]
rtol = 1e-8
integrator = "dop853"
samples = 10
end_time = 5.0

[[vary]]
name = "k"
path = "parameters.k"
as = "factor"
normal = { mean = 1.0, deviation = 0.1, from = 0.5 }

[[vary]]
paths = ["body.tip.mass", "body.boom.mass"]
log_normal = { median = 1.0, sigma = 0.2 }

[[vary]]
name = "spin"
path = "main_body.mass"
values = [100.0, 110.0]
weights = [3, 1]

[[correlation]]
between = ["k", "body_tip_mass"]
coefficient = -0.4

[[fault]]
name = "late"
late_release = { hinge = "boom", by = 0.5 }
change = [{ path = "body.tip.mass", offset = 0.1 }]

[[fault]]
name = "stuck"
stuck = ["1,2"]
failed_latch = ["boom"]
broken_spring = ["boom"]

[[fault]]
name = "missed"
missed_release = ["boom"]
"#;

fn place(study: &str) -> TempDir {
    let place = tempfile::tempdir().expect("a directory");
    fs::write(place.path().join("scene.toml"), SCENE).expect("writable");
    fs::write(place.path().join("study.toml"), study).expect("writable");
    place
}

fn read(study: &str) -> Result<Study, InputError> {
    Study::read(&place(study).path().join("study.toml"))
}

/// Comments of decks need not even be UTF-8.
#[test]
fn a_deck_or_a_robot_is_no_study() {
    let place = place(STUDY);
    for name in ["boom.nml", "arm.URDF"] {
        let path = place.path().join(name);
        fs::write(&path, b"! \xff\n").expect("writable");
        let told = Study::read(&path).expect_err("no study").to_string();
        let message = "found a deck or a robot, expected a study NAME.toml whose scene it is";
        assert_eq!(told, format!("{}: {message}", path.display()));
    }
}

#[test]
fn columns_of_variables_say_what_becomes_of_their_numbers() {
    let angles = "[[vary]]\npaths = ['body.boom.hinge.start_deg', 'body.tip.hinge.release.passes_deg']\n\
                  as = 'offset'\nuniform = { from = -1.0, to = 1.0 }\n";
    let study = read(&STUDY.replace("[[correlation]]", &format!("{angles}[[correlation]]")));
    let columns = nboom_study::columns(&study.expect("right"));
    let told: Vec<_> =
        columns[3..7].iter().map(|of| (of.description.as_str(), of.unit.as_deref())).collect();
    let expected = [
        ("factor on parameters.k", Some("1")),
        ("value of body.tip.mass, body.boom.mass", None),
        ("value of main_body.mass", None),
        ("offset to body.boom.hinge.start_deg, body.tip.hinge.release.passes_deg", Some("deg")),
    ];
    assert_eq!(told, expected);
}

#[test]
fn a_study_is_read_as_it_says() {
    let study = read(STUDY).expect("right");
    assert_eq!((study.name.as_str(), study.seed, study.draws), ("all of it", 7, 20));
    assert_eq!((study.method, study.trajectories, study.cases()), (Method::MonteCarlo, true, 80));
    let names: Vec<_> = study.variables.iter().map(|variable| variable.name.as_str()).collect();
    assert_eq!(names, ["k", "body_tip_mass", "spin"]);
    let [k, masses, spin] = &study.variables[..] else { panic!("three") };
    let (from, to) = (0.5, f64::INFINITY);
    assert_eq!(k.distribution, Distribution::Normal { mean: 1.0, deviation: 0.1, from, to });
    assert_eq!((k.relation, masses.relation), (Relation::Factor, Relation::Value));
    assert_eq!((masses.slots.len(), study.document.number(&masses.slots[0])), (2, 1.0));
    let (values, weights) = (vec![100.0, 110.0], vec![3.0, 1.0]);
    assert_eq!(spin.distribution, Distribution::one_of(values, weights));
    assert_eq!(study.correlations[0].between, [0, 1]);
    assert_eq!(study.faults[0].late_release, [LateRelease { hinge: 0, by: 0.5 }]);
    assert_eq!(study.faults[0].changes[0].relation, Relation::Offset);
    let failures =
        [(FailureMode::Stuck, 1), (FailureMode::FailedLatch, 0), (FailureMode::BrokenSpring, 0)];
    assert_eq!(study.faults[1].failures, failures);
    assert_eq!((study.run.rtol, study.run.samples), (Some(1e-8), Some(10)));
    assert!(study.run.stresses && !study.run.hinge_loads);
    let texts: Vec<_> = study.wanted.iter().map(|wanted| wanted.text()).collect();
    assert_eq!(texts, ["lock_time of boom", "final omega_z"]);
}

#[test]
fn grids_have_points_and_names_of_files() {
    let study = "scene = 'scene.toml'\nmethod = 'grid'\n[[vary]]\npath = 'parameters.k'\n\
                 uniform = { from = 1, to = 2 }\npoints = 3\n";
    let study = read(study).expect("right");
    assert_eq!((study.name.as_str(), study.cases()), ("study", 3));
    let values: Vec<_> = (1..=3).map(|case| study.case(case).values[0]).collect();
    assert_eq!(values, [1.0, 1.5, 2.0]);
}

/// Each wrong study: what is replaced in the right one, and line and words of the message.
#[test]
fn what_is_wrong_is_told_with_its_line() {
    for (from, to, line, words) in [
        ("draws = 20", "drawz = 20", 5, "did you mean `draws`"),
        ("draws = 20", "draws = 0", 5, "a whole number from 1 to 1000000000"),
        ("draws = 20", "draws = 2.5", 5, "a whole number"),
        ("draws = 20\n", "", 1, "how many draws"),
        ("seed = 7", "seed = -7", 3, "a whole number from 0"),
        ("monte_carlo", "montecarlo", 4, "did you mean `monte_carlo`"),
        ("\"all of it\"", "\"../it\"", 2, "the name of a folder"),
        ("final omega_z", "final omega_q", 6, "omega"),
        ("final omega_z", "lock_time of boon", 6, "boom"),
        ("final omega_z", "verdict.worst_load", 6, "a run with stresses"),
        ("trajectories = true", "trajectories = 1", 7, "true or false"),
        ("rtol = 1e-8", "rtol = 2.0", 10, "1e-14 to below 1"),
        ("samples = 10", "max_step = -1.0", 12, "a number above zero"),
        ("samples = 10", "safety_factor = -1.0", 12, "a number above zero"),
        ("samples = 10", "amplification = 3.0", 12, "a number from 1 to 2"),
        ("samples = 10", "safety_factor = 1.4", 12, "no effect, since the scene has no stations"),
        ("samples = 10", "pulses = \"sine\"", 12, "one of half-sine, all-at-once"),
        ("\"scene.toml\"", "\"sene.toml\"", 1, "the file cannot be read"),
        ("dop853", "dop85", 11, "did you mean `dop853`"),
        ("end_time = 5.0", "end_time = -5.0", 13, "a time not before the initial time"),
        ("parameters.k", "parameters.kk", 17, "`parameters.kk`"),
        ("body.tip.mass\", \"", "body.tip.masss\", \"", 22, "did you mean `body.tip.mass`"),
        ("as = \"factor\"", "as = \"times\"", 18, "one of value, factor, offset"),
        ("deviation = 0.1", "deviation = 0.0", 19, "a number above zero"),
        ("from = 0.5", "from = inf", 19, "a number"),
        ("sigma = 0.2", "sigma = 0.2, to = -1.0", 23, "above that of `from`"),
        ("log_normal", "lognormal", 23, "did you mean `log_normal`"),
        ("weights = [3, 1]", "weights = [3]", 29, "as many numbers as `values`"),
        ("weights = [3, 1]", "weights = [0, 0]", 29, "a finite sum above zero"),
        ("weights = [3, 1]", "points = 3", 29, "it with `uniform`, in a grid"),
        ("name = \"spin\"", "name = \"k\"", 26, "a name that no other column has"),
        ("name = \"spin\"", "name = \"case\"", 26, "nor case, seed, fault or status"),
        ("name = \"spin\"", "name = \"2 spins\"", 26, "letters, digits and _"),
        ("[\"k\", ", "[\"q\", ", 32, "the name of a variable"),
        ("[\"k\", ", "[\"body_tip_mass\", ", 32, "two variables"),
        ("-0.4", "-1.0", 33, "above -1 and below 1"),
        ("hinge = \"boom\"", "hinge = \"bom\"", 37, "did you mean `boom`"),
        ("hinge = \"boom\"", "hinge = \"tip\"", 37, "expected one by time"),
        ("by = 0.5", "by = -0.5", 37, "a number above zero"),
        ("offset = 0.1", "offset = 0.1, factor = 2.0", 38, "one of value, factor, offset"),
        ("stuck = [\"1,2\"]", "stuck = [\"1,3\"]", 42, "by the name of its body or by its numbers"),
        ("name = \"late\"", "name = \"stuck\"", 41, "each name once"),
        ("scene = \"scene.toml\"\n", "", 1, "a text"),
        (STUDY, SCENE, 8, "nboom run runs a scene"),
        ("main_body.mass", "parameters.k", 27, "a number that `k` changes too"),
        (
            "path = \"main_body.mass\"",
            "path = \"body.boom.hinge.spring.stiffness\"\nas = \"factor\"",
            27,
            "a number that `k` changes too",
        ),
        (
            "coefficient = -0.4",
            "coefficient = -0.4\n[[correlation]]\nbetween = [\"body_tip_mass\", \"k\"]\ncoefficient = 0.4",
            35,
            "each pair once",
        ),
        ("failed_latch = [\"boom\"]", "failed_latch = [\"tip\"]", 43, "hinges with latch"),
        ("broken_spring = [\"boom\"]", "broken_spring = [\"1,2\"]", 44, "hinges with spring"),
        (
            "stuck = [\"1,2\"]\nfailed_latch = [\"boom\"]\nbroken_spring = [\"boom\"]",
            "",
            40,
            "nothing that is broken",
        ),
        (
            "offset = 0.1 }",
            "offset = 0.1 }, { path = \"body.tip.mass\", factor = 2.0 }",
            38,
            "each number in one change",
        ),
    ] {
        assert!(STUDY.contains(from), "{from}");
        let text = STUDY.replacen(from, to, 1);
        match read(&text) {
            Err(InputError::Content(errors)) => {
                let told: Vec<String> = errors.iter().map(ToString::to_string).collect();
                let is_told = |(error, told): (&nboom_io::Diagnostic, &String)| {
                    error.line == line && told.contains(words)
                };
                assert!(errors.iter().zip(&told).any(is_told), "{to}: {told:#?}");
                assert!(errors.len() <= 3, "{to}: {told:#?}");
            }
            other => panic!("{to}: {:?}", other.map(|study| study.name)),
        }
    }
}

#[test]
fn several_mistakes_are_told_at_once() {
    let text = STUDY.replace("seed = 7", "sead = 7").replace("sigma = 0.2", "sigma = -0.2");
    let Err(InputError::Content(errors)) = read(&text) else { panic!("wrong") };
    let lines: Vec<usize> = errors.iter().map(|error| error.line).collect();
    assert_eq!(lines, [3, 23]);
}

/// What follows from a mistake is not told as another.
#[test]
fn one_mistake_is_told_once() {
    let grid = "scene = 'scene.toml'\nmethod = 'grid'\n[[vary]]\npath = 'parameters.k'\n";
    for more in [
        "uniform = { from = 1, to = 2 }\npoints = 1",
        "values = ['a']",
        "values = [2, nan]",
        "values = [1, 2]\nweights = ['a', 1]",
        "values = [1, 2]\n[run]\nrtol = 2.0",
        "values = [1, 2]\n[[fault]]\nname = 'late'\nlate_release = { hinge = 'tip', by = 1 }",
    ] {
        let method = if more.contains("weights") { "draws = 2\n" } else { "" };
        let grid =
            if method.is_empty() { grid } else { &grid.replace("method = 'grid'\n", method) };
        let Err(InputError::Content(errors)) = read(&format!("{grid}{more}\n")) else {
            panic!("{more}")
        };
        assert_eq!(errors.len(), 1, "{more}: {errors:#?}");
    }
}

#[test]
fn mistakes_of_the_scene_come_after_those_of_the_study() {
    let place = place(&STUDY.replace("seed = 7", "sead = 7"));
    let scene = SCENE.replace("mass = 100.0", "mass = -1.0");
    fs::write(place.path().join("scene.toml"), scene).expect("writable");
    let Err(InputError::Content(errors)) = Study::read(&place.path().join("study.toml")) else {
        panic!("wrong")
    };
    let told: Vec<String> = errors.iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 2, "{told:#?}");
    assert!(told[0].contains("study.toml:3:") && told[1].contains("scene.toml:9:"), "{told:#?}");
}

#[test]
fn what_cannot_be_planned_is_told() {
    for (method, more, words) in [
        ("grid", "uniform = { from = 0, to = 1 }", "points"),
        (
            "grid",
            "uniform = { from = 0, to = 1 }\npoints = 1000000000\n[[vary]]\npath = 'main_body.mass'\nuniform = { from = 1, to = 2 }\npoints = 10",
            "at most 1000000000",
        ),
        (
            "grid",
            "values = [1]\n[[correlation]]\nbetween = ['parameters_k', 'parameters_k']\ncoefficient = 0.1",
            "a grid",
        ),
    ] {
        let text = format!(
            "scene = 'scene.toml'\nmethod = '{method}'\n[[vary]]\npath = 'parameters.k'\n{more}\n"
        );
        let refused = read(&text).expect_err(words).to_string();
        assert!(refused.contains(words), "{refused}");
    }
    let pairs = [("a", "b", 0.9), ("b", "c", 0.9), ("a", "c", -0.9)];
    let mut text = "scene = 'scene.toml'\ndraws = 5\n".to_owned();
    for (name, path) in [("a", "parameters.k"), ("b", "main_body.mass"), ("c", "body.tip.mass")] {
        text += &format!(
            "[[vary]]\nname = '{name}'\npath = '{path}'\nuniform = {{ from = 1, to = 2 }}\n"
        );
    }
    for (a, b, coefficient) in pairs {
        text +=
            &format!("[[correlation]]\nbetween = ['{a}', '{b}']\ncoefficient = {coefficient}\n");
    }
    let refused = read(&text).expect_err("impossible").to_string();
    assert!(refused.contains("positive definite") && refused.contains("a, b, c"), "{refused}");
    let refused =
        read("scene = 'scene.toml'\ndraws = 5\n").expect_err("nothing varies").to_string();
    assert!(refused.contains("vary"), "{refused}");
}

#[test]
fn files_that_are_none_are_refused() {
    let place = place(STUDY);
    let refused = |name: &str| Study::read(&place.path().join(name)).expect_err(name).to_string();
    assert!(refused("nowhere.toml").contains("nowhere.toml"));
    assert!(refused(".").contains("directory"));
    fs::write(place.path().join("binary.toml"), b"scene = \0").expect("writable");
    assert!(refused("binary.toml").contains("zero byte"));
    let other = STUDY.replace("scene.toml", "missing.toml");
    fs::write(place.path().join("other.toml"), other).expect("writable");
    assert!(refused("other.toml").contains("missing.toml"));
    fs::write(place.path().join("half.toml"), "scene = \"scene.toml").expect("writable");
    assert!(refused("half.toml").contains("half.toml:1:"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Whatever stands there, it is read or refused.
    #[test]
    fn mutated_studies_do_not_panic(at in 0.0..1.0_f64, cut in 0_usize..12, piece in "[ -~é\n\t]{0,6}") {
        // It is ASCII.
        let start = (at * STUDY.len() as f64) as usize;
        let end = (start + cut).min(STUDY.len());
        let text = [&STUDY[..start], &piece, &STUDY[end..]].concat();
        if let Err(InputError::Content(errors)) = read(&text) {
            prop_assert!(errors.iter().all(|error| !error.drawn().is_empty()));
        }
    }
}
