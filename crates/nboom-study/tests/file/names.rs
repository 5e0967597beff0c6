//! Names of hinges and columns.

use nboom_study::{FailureMode, Study};
use std::fs;

use super::effects::errors;
use super::{SCENE, STUDY, place};

/// A body may be called like the numbers of another hinge, and its name comes first.
#[test]
fn names_come_before_numbers() {
    let scene = SCENE.replace("\"boom\"", "\"1,2\"").replace("\"tip\"", "\"1,1\"");
    let study = STUDY
        .replace("body.boom.mass", "body.1,2.mass")
        .replace("body.tip.mass", "body.1,1.mass")
        .replace("body_tip_mass", "body_1_1_mass")
        .replace("lock_time of boom", "lock_time of 1,2")
        .replace("\"final omega_z\"", "\"final beta of 1,2\"")
        .replace("stuck = [\"1,2\"]", "stuck = [\"1,1\"]")
        .replace("\"boom\"", "\"1,2\"");
    let place = place(&study);
    fs::write(place.path().join("scene.toml"), scene).expect("writable");
    let study = Study::read(&place.path().join("study.toml")).expect("right");
    assert_eq!(
        study.faults[1].failures[..2],
        [(FailureMode::Stuck, 1), (FailureMode::FailedLatch, 0)]
    );
    assert_eq!(study.faults[0].late_release[0].hinge, 0);
    for wanted in &study.wanted {
        assert_eq!(wanted.column().body.as_deref(), Some("1,2"), "{}", wanted.text());
    }
    assert_eq!(study.document.number(&study.variables[1].slots[1]), 3.0);
}

#[test]
fn names_that_begin_or_end_with_blanks_can_be_said() {
    let scene = SCENE.replace("\"boom\"", "\" boom \"");
    let study = STUDY
        .replace("body.boom.mass", "body.' boom '.mass")
        .replace("lock_time of boom", "lock_time of  boom ")
        .replace("final omega_z", "final beta of  boom ")
        .replace("\"boom\"", "\" boom \"");
    assert_eq!(errors(&scene, &study), []);
}

#[test]
fn what_is_suggested_is_right() {
    let wrong = STUDY.replace("final omega_z", "final omga");
    let [(6, told)] = &errors(SCENE, &wrong)[..] else { panic!("one error") };
    assert!(told.contains("did you mean `final omega_x`?"), "{told}");
}

#[test]
fn results_with_one_name_are_told_how_to_be_told_apart() {
    let study = STUDY.replace("\"final omega_z\"", "\"final omega_z\", \"final  omega_z\"");
    let [(6, told)] = &errors(SCENE, &study)[..] else { panic!("one error") };
    assert!(told.contains("`final_omega_z`, twice") && told.contains("by their numbers"), "{told}");
}

/// Results and their requirements are told by words; how many blanks stand between them says nothing.
#[test]
fn results_and_requirements_have_one_grammar() {
    let spelled = [" lock_time  of boom", "lock_time of boom ", "final  omega_z", " final omega_z"];
    for wanted in spelled {
        for required in spelled.iter().filter(|of| of.contains("omega") == wanted.contains("omega"))
        {
            let study =
                STUDY.replace("\"lock_time of boom\", \"final omega_z\"", &format!("\"{wanted}\""));
            let requirement =
                format!("\n[[requirement]]\nresult = \"{required}\"\nat_most = 4.0\n");
            assert_eq!(errors(SCENE, &(study + &requirement)), [], "{wanted:?}, {required:?}");
        }
    }
}

#[test]
fn columns_of_hinges_go_by_names_and_by_numbers() {
    let read = |column: &str| {
        let place = place(&STUDY.replace("final omega_z", column));
        Study::read(&place.path().join("study.toml")).expect("right")
    };
    let [by_name, by_numbers] = ["final beta of tip", "final beta of 1,2"].map(read);
    let [named, numbered] = [&by_name, &by_numbers].map(|study| study.wanted[1].column());
    assert_eq!(
        (&named.body, &named.unit, &named.description),
        (&numbered.body, &numbered.unit, &numbered.description)
    );
    assert_eq!(numbered.body.as_deref(), Some("tip"));
    let wrong = STUDY.replace("final omega_z", "final beta of 1,3");
    let [(6, told)] = &errors(SCENE, &wrong)[..] else { panic!("one error") };
    assert!(told.contains("by the name of its body, or as `beta_1_2`"), "{told}");
}
