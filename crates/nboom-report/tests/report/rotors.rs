//! Speeds of rotors, and what only `output.csv` has.

use std::fs;

use nboom_report::Run;
use tempfile::TempDir;

use crate::directory::{Chain, page_of};

fn write(place: &TempDir, name: &str, text: &str) {
    fs::write(place.path().join(name), text).expect("writable");
}

/// A run of 60 with a wheel that speeds up from 10.25 to 10.75, between output times, and one that does not.
fn with_wheels() -> TempDir {
    let place = Chain { segments: 1, samples: 4, stations: 0 }.write();
    let path = place.path().join("scene.toml");
    let scene = fs::read_to_string(path).expect("a scene");
    let wheels = "[[main_body.rotor]]\naxis = \"x\"\ninertia = 0.1\nspeed_over_time_rad = [[10.25, 0.0], [10.75, 8.0]]\n\
                  [[body]]\nrotor = [{ axis = \"x\", inertia = 0.1, speed_rad = -5.0 }]\n";
    write(&place, "scene.toml", &scene.replacen("[[body]]\n", wheels, 1));
    place
}

#[test]
fn speeds_are_those_that_the_scene_commands_with_all_corners() {
    let place = with_wheels();
    let run = Run::read(place.path()).expect("a run");
    assert!(run.gaps().is_empty(), "{:?}", run.gaps());
    let labels: Vec<String> = run.rotors().into_iter().map(|rotor| rotor.label).collect();
    assert_eq!(labels, ["rotor 1, main body", "rotor 2, segment 1"]);
    let speeds = run.rotor_speeds().expect("two rotors");
    assert_eq!(speeds.times(), [0.0, 10.25, 10.75, 15.0, 30.0, 45.0, 60.0]);
    let column = |name| speeds.column(name).expect("its speed").to_vec();
    assert_eq!(column("rotor_speed_1"), [0.0, 0.0, 8.0, 8.0, 8.0, 8.0, 8.0]);
    assert_eq!(column("rotor_speed_2"), [-5.0; 7]);
    let page = page_of(place.path());
    assert!(page.contains("rotor 2, segment 1") && page.contains("\"rotor_speed_1\""));
}

#[test]
fn the_speeds_of_output_are_those_of_the_run_and_in_radians() {
    let place = with_wheels();
    let header = "t,rotor_speed_1_deg,rotor_speed_2_deg,motor_torque_2";
    write(&place, "output.csv", &format!("{header}\n0.0,180.0,90.0,2.0\n60.0,0.0,90.0,3.0\n"));
    let run = Run::read(place.path()).expect("a run");
    let speeds = run.rotor_speeds().expect("two rotors");
    assert_eq!(speeds.column("rotor_speed_1"), Some(&[std::f64::consts::PI, 0.0][..]));
    let torques = run.requested().expect("a torque").column("motor_torque_2");
    assert_eq!(torques, Some(&[2.0, 3.0][..]));
    // Without the scene rotors have numbers.
    fs::remove_file(place.path().join("scene.toml")).expect("it is there");
    let run = Run::read(place.path()).expect("a run");
    let labels: Vec<String> = run.rotors().into_iter().map(|rotor| rotor.label).collect();
    assert_eq!(labels, ["rotor 1", "rotor 2"]);
}

#[test]
fn the_speeds_of_some_rotors_leave_those_of_the_scene() {
    let place = with_wheels();
    write(&place, "output.csv", "t,rotor_speed_1\n0.0,1.0\n60.0,1.0\n");
    let run = Run::read(place.path()).expect("a run");
    assert!(run.rotor_speeds().is_some_and(|table| table.column("rotor_speed_2").is_some()));
}

#[test]
fn output_without_them_is_not_read_and_with_them_its_break_is_named() {
    let place = with_wheels();
    write(&place, "output.csv", "t,beta_1_1\n0.0,nothing\n");
    assert!(Run::read(place.path()).expect("a run").gaps().is_empty());
    write(&place, "output.csv", "t,rotor_speed_1\n0.0,nothing\n");
    let told: Vec<String> =
        Run::read(place.path()).expect("a run").gaps().iter().map(ToString::to_string).collect();
    assert!(told[0].starts_with("output.csv, line 2: `nothing` found"), "{told:?}");
}
