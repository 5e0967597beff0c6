use super::*;

/// Every parameter that a routine assumes is named in the crate's README: the numbers
/// of a parameter's name over all phrases are those that are assumed in the code.
#[test]
fn a_crate_names_all_that_it_assumes() {
    let place = written(&satellite("mixed", &[1, 2, 2]), &Choices::default());
    let readme = fs::read_to_string(place.path().join("README.md")).expect("readable");
    let row = readme.lines().find(|line| line.starts_with("| `Satellite")).expect("a row");
    let phrases = row.trim_end_matches(" |").rsplit(" | ").next().expect("a last column");
    let named: usize = phrases.split("; ").map(parameters_of).sum();
    let code = fs::read_to_string(place.path().join("src/routines.rs")).expect("readable");
    let start = code.find("const ASSUMPTIONS").expect("a table");
    let (_, places) = code[start..].split_once("assumed(").expect("there are some");
    let (_, places) = places.split_once('[').expect("a list of places");
    let (places, _) = places.split_once(']').expect("its end");
    let assumed = places.split(',').filter(|place| !place.trim().is_empty()).count();
    assert!(assumed > 30, "{places}");
    assert_eq!(named, assumed, "{phrases}");
}

/// How many parameters a phrase speaks of.
fn parameters_of(phrase: &str) -> usize {
    let links = || -> usize {
        let (count, _) = phrase.split_once(" of 5 links").expect("five links");
        count.rsplit(' ').next().and_then(|count| count.parse().ok()).expect("a count")
    };
    match phrase {
        "no external wrench on the main body" => 0,
        "O at the main body's mass centre" | "main body along its principal axes" => 3,
        _ if phrase.starts_with("inertia along the segment axes") => 3 * links(),
        _ if phrase.ends_with("links") => links(),
        _ => {
            let (equations, owners) = phrase.rsplit_once(" of ").expect("equations and owners");
            let owners = owners.split(", ").count();
            let of_group = |group: &str| group.matches(" = ").count();
            owners * equations.split(", ").map(of_group).sum::<usize>()
        }
    }
}

/// Rows stay short, though some of a right side's numbers are handed in.
#[test]
fn a_right_side_with_built_in_numbers_says_so_in_a_word() {
    let mut description = (*satellite("sprung", &[2])).clone();
    description.bodies[1].hinge.kick_off = Some(KickOffSpring {
        main_body_point: Vec3::zero(),
        body_point: Vec3::unit_y(),
        coefficients: [1.0, 0.0, 0.0, 0.0],
        limit_length: 9.0,
    });
    let scene = Scene::new(description).expect("the bodies are physical");
    let choices = Choices { numbers: Numbers::Baked, right_side: true, ..Choices::default() };
    let place = written(&scene, &choices);
    let all = certificate(place.path())["routines"][1]["assumptions"].to_string();
    for phrase in ["numbers of the bodies", "no force along 3 of 4 lines", "A₁ = -0.7"] {
        assert!(all.contains(phrase), "no {phrase:?} in {all}");
    }
    assert!(all.len() < 200, "{all}");
}

#[test]
fn a_crate_says_where_the_numbers_of_a_hinge_stand() {
    let place = written(&satellite("mixed", &[1, 2, 2]), &Choices::default());
    let text = fs::read_to_string(place.path().join("src/lib.rs")).expect("readable");
    let found: Vec<&str> = text.lines().filter(|line| line.starts_with("    Hinge {")).collect();
    // Two chains of two side by side, then the chain of one: 9 numbers before the hinges.
    let expected = [
        (1, 1, [21, 22, 23, 10]),
        (2, 1, [9, 11, 13, 6]),
        (2, 2, [15, 17, 19, 8]),
        (3, 1, [10, 12, 14, 7]),
        (3, 2, [16, 18, 20, 9]),
    ];
    let line = |(appendage, segment, [angle, rate, torque, acceleration]): (i32, i32, [i32; 4])| {
        format!(
            "    Hinge {{ name: \"\", appendage: {appendage}, segment: {segment}, slides: false, \
             angle: {angle}, rate: {rate}, torque: {torque}, acceleration: {acceleration} }},"
        )
    };
    assert_eq!(found, expected.map(line));
}

/// The chains of two come first in the topology 2xS2_S1, and the chain of one last.
#[test]
fn a_crate_says_which_hinge_a_link_is() {
    let scene = satellite("mixed", &[1, 2, 2]);
    let names = ["probe", "left yoke", "left panel", "right yoke", "right panel"];
    let scene = scene.with_names(names.map(str::to_owned).to_vec());
    let place = written(&scene, &Choices::default());
    let text = fs::read_to_string(place.path().join("README.md")).expect("readable");
    let links = "1,1 is hinge 2,1 (left yoke); 1,2 is hinge 2,2 (left panel); 2,1 is hinge 3,1 (right yoke); \
                 2,2 is hinge 3,2 (right panel); 3,1 is hinge 1,1 (probe)";
    assert!(text.contains(links), "{text}");
}

/// The two fingers of the robot slide.
#[test]
fn a_crate_knows_hinges_by_name_and_which_of_them_slide() {
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/robots/panda.urdf");
    let file = read_scene(&robot).expect("the robot is right");
    let place = written(&file.scene, &Choices::default());
    let text = fs::read_to_string(place.path().join("src/lib.rs")).expect("readable");
    let sliding = text.lines().filter(|line| line.contains("slides: true"));
    let sliding: Vec<&str> = sliding.map(|line| line.split('"').nth(1).expect("a name")).collect();
    assert_eq!(sliding, ["panda_leftfinger", "panda_rightfinger"]);
    assert_eq!(text.lines().filter(|line| line.contains("slides: false")).count(), 7);
}
