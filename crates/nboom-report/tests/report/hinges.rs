//! What the page and figures both show of hinges.

use std::fs;

use nboom_report::Run;
use tempfile::TempDir;

use crate::directory::{Chain, page_of};

fn write(place: &TempDir, name: &str, text: &str) {
    fs::write(place.path().join(name), text).expect("writable");
}

fn labels(place: &TempDir) -> Vec<String> {
    let run = Run::read(place.path()).expect("a run");
    run.hinges().into_iter().map(|hinge| hinge.label).collect()
}

#[test]
fn hinges_have_the_names_of_the_scene_else_of_the_verdict_else_their_numbers() {
    let chain = Chain { segments: 2, samples: 4, stations: 0 };
    let place = chain.write();
    assert_eq!(labels(&place), ["segment 1", "segment 2"]);
    fs::remove_file(place.path().join("scene.toml")).expect("it is there");
    let summary = chain.summary("a chain");
    let named = |i: usize| format!("\"segment\": {i}, \"name\": \"panel {i}\"");
    let summary = (1..=2)
        .fold(summary, |summary, i| summary.replace(&format!("\"segment\": {i}"), &named(i)));
    write(&place, "summary.json", &summary);
    assert_eq!(labels(&place), ["panel 1", "panel 2"]);
    assert!(page_of(place.path()).contains("\"label\":\"panel 2\""));
    fs::remove_file(place.path().join("summary.json")).expect("it is there");
    assert_eq!(labels(&place), ["1,1", "1,2"]);
}

#[test]
fn a_kick_off_spring_pushes_by_its_length_until_it_lets_go() {
    let place = Chain { segments: 1, samples: 4, stations: 0 }.write();
    // Its ends are 3 apart at any angle, which is its limit: only the event says that it lets go.
    let scene = "name = \"sprung\"\n[run]\nend = 2.0\n[main_body]\nmass = 9.0\ninertia = [1.0, 1.0, 1.0]\n\
                 [[body]]\nname = \"panel\"\nmass = 1.0\nmass_centre = [0.0, 0.5, 0.0]\n\
                 inertia = [0.1, 0.1, 0.1]\ntip = [0.0, 1.0, 0.0]\n\
                 kick_off = { main_body_end = [0.0, 1.0, 0.0], end = [0.0, 3.0, 0.0], \
                 force = [1.0, 2.0, 0.0, 0.0], limit = 3.0 }\n\
                 [body.hinge]\nat = [0.0, 1.0, 0.0]\naxis = \"x\"\n";
    write(&place, "scene.toml", scene);
    write(&place, "states.csv", "t,beta_1_1,tau_1_1\n0.0,0.0,1.0\n2.0,2.0,1.0\n");
    write(&place, "instants.csv", "t,beta_1_1,tau_1_1\n1.0,1.0,1.0\n1.0,1.0,1.0\n");
    let header = "t,kind,appendage,segment,impulse,energy_before,energy_after\n";
    write(&place, "events.csv", &format!("{header}1.0,kick_off_disengage,1,1,,1.0,1.0\n"));
    let run = Run::read(place.path()).expect("a run");
    assert!(run.gaps().is_empty(), "{:?}", run.gaps());
    let forces = run.kick_offs().expect("a spring").column("force_1_1").expect("its force");
    assert_eq!(forces.iter().map(|force| force.round()).collect::<Vec<_>>(), [7.0, 7.0, 0.0, 0.0]);
}
