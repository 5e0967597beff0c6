//! Numbers of which only others decide whether they have an effect.

use super::effects::{errors, refused};
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

/// A study of the boom with a damper at this angle, and of it this.
fn of_damper(angle: &str, rest: &str) -> Vec<(usize, String)> {
    let damper = "rest_deg = -10.0 }\ndamper = { damping = 1.0, angle = \"$angle * $other\", rest_deg = 0.0 }";
    let scene = SCENE
        .replace("k = 2.0", &format!("k = 2.0\nangle = {angle}\nother = 1.0"))
        .replace("rest_deg = -10.0 }", damper);
    let head = "scene = 'scene.toml'\ndraws = 2\nresults = ['lock_time of boom']\n";
    errors(&scene, &format!("{head}{rest}"))
}

/// The rest of a damper counts where its angle does.
const REST: &str = "[[vary]]\nname = 'rest'\npath = 'body.boom.hinge.damper.rest_deg'\n\
                    uniform = { from = -10, to = 10 }\n";

fn angle(values: &str) -> String {
    format!("[[vary]]\nname = 'angle'\npath = 'parameters.angle'\n{values}\n")
}

#[test]
fn a_number_that_some_cases_depend_on_is_varied() {
    let other = |values| {
        angle(values).replace("'angle'", "'other'").replace("parameters.angle", "parameters.other")
    };
    let fault = |change| format!("[[fault]]\nname = 'it'\nchange = [{{ path = {change} }}]\n");
    let tangled = fault("'parameters.angle', value = -0.2");
    let latch = fault("'body.boom.hinge.latch_deg', value = 1.0").replace("'it'", "'latch'");
    let misaligned = fault("'body.boom.hinge.damper.rest_deg', value = 8.0");
    let some = angle("values = [0.0, -0.2]\nweights = [0.8, 0.2]");
    let rare = angle("values = [0.0, -0.2]\nweights = [0.999, 0.001]");
    for more in [
        format!("{some}{REST}"),
        format!("{rare}{REST}"),
        // Of one the smaller number counts, of the other the larger one.
        format!("{}{}{REST}", angle("values = [0.0, -0.2]"), other("values = [0.0, 1.0]")),
        format!("{REST}{tangled}"),
        format!("{REST}{latch}{tangled}"),
        format!("{some}{misaligned}"),
        format!("{rare}{misaligned}"),
    ] {
        assert_eq!(of_damper("0.0", &more), [], "{more}");
    }
}

#[test]
fn a_number_on_which_only_the_scene_as_it_stands_depends_is_refused() {
    let fault = "[[fault]]\nname = 'it'\nchange = [{ path = 'body.boom.hinge.damper.rest_deg', value = 8.0 }]\n";
    for (more, line) in [
        // No case has the angle of the scene.
        (format!("{}{REST}", angle("values = [0.0]")), 10),
        (format!("{}{fault}", angle("values = [0.0]")), 10),
        // Its value never comes.
        (format!("{}{REST}", angle("values = [0.0, -0.2]\nweights = [1, 0]")), 11),
    ] {
        let found = of_damper("-0.2", &more);
        assert!(!found.is_empty() && found[0].0 == line, "{more}: {found:#?}");
        assert!(found[0].1.contains("without effect"), "{found:#?}");
    }
}

/// A case starts a change from what was drawn, and a change that is no start leaves nothing of what was drawn.
#[test]
fn what_a_fault_sets_is_not_drawn_in_its_cases() {
    let tangled = "[[fault]]\nname = 'it'\nchange = [{ path = 'parameters.angle', value = -0.2 }, \
                   { path = 'body.boom.hinge.damper.rest_deg', value = 8.0 }]\n";
    let found = of_damper("0.0", &format!("{REST}{tangled}"));
    assert!(matches!(&found[..], [(6, told)] if told.contains("without effect")), "{found:#?}");
    let moved = tangled.replace("value = 8.0", "offset = 8.0");
    assert_eq!(of_damper("0.0", &format!("{REST}{moved}")), []);
}

/// A hundred variables, of which the scene has so many parameters, and fifty faults.
#[test]
fn a_large_study_is_read_without_ado() {
    let numbers = 0..100;
    let parameters: String = numbers.clone().map(|i| format!("p{i} = 0.01\n")).collect();
    let sum: Vec<String> = numbers.clone().map(|i| format!("$p{i}")).collect();
    let scene = SCENE.replace("k = 2.0\n", &format!("k = 2.0\n{parameters}"));
    let scene = scene.replace("\"$k\"", &format!("\"$k + {}\"", sum.join(" + ")));
    let tables = numbers.map(|i| {
        format!("[[vary]]\npath = 'parameters.p{i}'\nuniform = {{ from = 0.0, to = 0.02 }}\n")
    });
    let faults = (0..50).map(|i| {
        format!(
            "[[fault]]\nname = 'f{i}'\nchange = [{{ path = 'parameters.p{i}', factor = 2.0 }}]\n"
        )
    });
    let all: String = tables.chain(faults).collect();
    let study = format!("scene = 'scene.toml'\ndraws = 2\nresults = ['final omega_z']\n{all}");
    assert_eq!(errors(&scene, &study), []);
}

#[test]
fn a_fault_is_not_called_what_cases_without_one_are() {
    refused(SCENE, "name = \"late\"", "name = \"no fault\"", 36, &["`no fault`"]);
}
