use nboom_io::{ReadOptions, SceneDocument, SceneFile};
use nboom_strength::Loads;
use nboom_study::Wanted;

use super::example;

fn file(name: &str) -> SceneFile {
    let document = SceneDocument::read(example(name).as_ref(), &ReadOptions::default());
    document.and_then(|document| document.scene(&[])).expect("an example")
}

#[test]
fn unknown_results_have_the_nearest() {
    let file = file("cubesat.toml");
    for (text, nearest) in [
        ("lock_time of x pannel 1", "lock_time of x panel 1"),
        ("lok_time of x panel 1", "lock_time of x panel 1"),
        ("final nutatoin", "final nutation"),
        ("largest omega", "largest omega_x"),
        ("conservation.enrgy", "conservation.energy"),
        ("verdict.hinges[1].angel", "verdict.hinges[1].angle"),
        ("parameters.stifness", "parameters.stiffness"),
    ] {
        let error = Wanted::named(text, &file, Loads::None).expect_err(text);
        assert_eq!(error.nearest.as_deref(), Some(nearest), "{text}");
        Wanted::named(nearest, &file, Loads::None).unwrap_or_else(|error| panic!("{error}"));
    }
    let spaced = Wanted::named("lock_time  of x panel 1", &file, Loads::None).expect("it is one");
    assert_eq!(spaced.text(), "lock_time of x panel 1");
    for (text, expected) in [
        ("", "`lock_time of HINGE`"),
        ("verdict.hinges[5].angle", "a hinge from 1 to 4"),
        ("verdict.hinges[0].angle", "`lock_time of HINGE`"),
        ("verdict.hinges.angle", "`lock_time of HINGE`"),
        ("peak_force of x panel 1", "a run with loads of hinges"),
        ("peak_stress of x panel 1", "a run with stresses"),
        ("verdict.worst_load", "a run with stresses"),
        ("verdict.largest_hinge_force", "a run with loads of hinges"),
        ("final reaction_force_x", "columns of a main body that moves freely"),
        ("wall_seconds", "a number that is the same each time"),
        ("lock_time of 3", "a hinge by the name of its body"),
    ] {
        let error = Wanted::named(text, &file, Loads::None).expect_err(text);
        assert!(error.expected.starts_with(expected), "{text}: {error}");
    }
    Wanted::named("peak_force of x panel 1", &file, Loads::Hinges).expect("loads are found");
}

#[test]
fn defaults_are_what_the_scene_has() {
    let texts = |name: &str, loads: Loads| -> Vec<String> {
        let wanted = Wanted::defaults(&file(name), loads);
        wanted.iter().map(|wanted| wanted.text().to_owned()).collect()
    };
    let panels = ["x panel 1", "x panel 2", "y panel 1", "y panel 2"];
    let mut expected: Vec<String> = panels
        .iter()
        .flat_map(|panel| ["lock_time", "impulse"].map(|word| format!("{word} of {panel}")))
        .collect();
    let rest = ["final nutation", "conservation.angular_momentum", "conservation.energy"];
    expected.extend(rest.map(str::to_owned));
    assert_eq!(texts("cubesat.toml", Loads::None), expected);
    // The deck has no strengths.
    let deck = texts("n-boom-1970.nml", Loads::Stations);
    assert_eq!(deck.last().map(String::as_str), Some("verdict.worst_load"));
}
