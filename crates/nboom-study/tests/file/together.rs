//! Numbers of which only others decide whether they have an effect.

use super::effects::errors;
use super::{SCENE, STUDY};

/// A spring whose stiffness is the parameter that another table varies.
#[test]
fn a_parameter_is_not_varied_beside_what_is_set_in_its_place() {
    let (k, spin) = ("path = \"parameters.k\"\nas = \"factor\"\n", "path = \"main_body.mass\"");
    let stiffness = "path = \"body.boom.hinge.spring.stiffness\"";
    let study = STUDY.replace(k, "path = \"parameters.k\"\n");
    let found = errors(SCENE, &study.replace(spin, stiffness));
    let [(26, told)] = &found[..] else { panic!("{found:#?}") };
    assert!(told.contains("a number that `k` changes too"), "{told}");
    // Whichever comes first, and even if the parameter has other users.
    let two = "axis = \"z\"\nspring = { stiffness = \"$k\" }\nrelease";
    let two = SCENE.replace("axis = \"z\"\nrelease", two);
    assert_ne!(two, SCENE);
    let turned =
        STUDY.replace(k, &format!("{stiffness}\n")).replace(spin, "path = \"parameters.k\"");
    for scene in [SCENE, &two] {
        let found = errors(scene, &turned);
        let [(26, told)] = &found[..] else { panic!("{found:#?}") };
        assert!(told.contains("a number that `k` changes too"), "{told}");
    }
}
