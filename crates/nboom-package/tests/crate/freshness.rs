use super::*;

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let scene = satellite("booms", &[3, 3, 3, 3]);
    let (one, other) = (written(&scene, &Choices::default()), written(&scene, &Choices::default()));
    assert_eq!(relative(one.path()), relative(other.path()));
}

#[test]
fn what_is_up_to_date_is_not_written_and_what_is_not_is() {
    let (scene, choices) = (one_boom(), Choices::default());
    let place = place();
    let directory = place.path().join("inner/crate");
    let missing = is_current(&scene, &choices, &directory).expect_err("nothing there");
    assert!(matches!(missing, PackageError::Outdated { standing: None, .. }), "{missing}");
    generate(&scene, &choices, &directory).expect("written");
    is_current(&scene, &choices, &directory).expect("as it was written");
    assert_eq!(generate(&scene, &choices, &directory).ok(), Some(Written::UpToDate));

    let baked = Choices { numbers: Numbers::Baked, ..choices };
    let stale = is_current(&scene, &baked, &directory).expect_err("other numbers");
    let is_stale =
        |error| matches!(error, PackageError::Outdated { standing: Some(Standing::Stale), .. });
    assert!(is_stale(stale));
    let equations = Choices { formulation: Formulation::Symmetric, equations: true, ..baked };
    generate(&scene, &equations, &directory).expect("what was written here is replaced");
    assert!(directory.join("tests/BakedS1Equations.csv").exists());
    generate(&scene, &baked, &directory).expect("what was written here is replaced");
    assert!(!directory.join("tests/BakedS1Equations.csv").exists());
    assert_eq!(relative(&directory), relative(written(&scene, &baked).path()));

    let text = fs::read_to_string(directory.join("src/routines.rs")).expect("readable");
    fs::remove_file(directory.join("src/routines.rs")).expect("removable");
    let missing = is_current(&scene, &baked, &directory).expect_err("one file less");
    assert!(missing.to_string().ends_with("src/routines.rs is missing"), "{missing}");
    generate(&scene, &baked, &directory).expect("what is missing is written");
    assert_eq!(fs::read_to_string(directory.join("src/routines.rs")).ok(), Some(text));
}

#[test]
fn what_others_have_written_is_not_overwritten() {
    let (scene, choices) = (one_boom(), Choices::default());
    for name in ["src/routines.rs", "Cargo.toml", "CERTIFICATE.json", "GENERATED"] {
        let place = written(&scene, &choices);
        let path = place.path().join(name);
        let changed = fs::read_to_string(&path).expect("readable") + "\n";
        fs::write(&path, &changed).expect("writable");
        let before = contents(place.path());
        for choices in [choices, Choices { numbers: Numbers::Baked, ..choices }] {
            let error = generate(&scene, &choices, place.path()).expect_err("edited");
            let PackageError::NotOurs { path: found, standing } = &error else { panic!("{error}") };
            assert_eq!((found, *standing), (&path, Standing::Edited));
            let error = is_current(&scene, &choices, place.path()).expect_err("edited");
            assert!(error.to_string().contains("was changed"), "{error}");
        }
        assert_eq!(contents(place.path()), before);
    }
    let place = place();
    let path = place.path().join("Cargo.toml");
    fs::write(&path, "[package]\nname = \"mine\"\n").expect("writable");
    let error = generate(&scene, &choices, place.path()).expect_err("somebody else's");
    let PackageError::NotOurs { path: found, standing } = &error else { panic!("{error}") };
    assert_eq!((found, *standing), (&path, Standing::Foreign));
    assert_eq!(contents(place.path()).len(), 1);
}

#[test]
fn a_crate_for_another_mass_is_out_of_date() {
    let (scene, choices) = (one_boom(), Choices::default());
    let place = written(&scene, &choices);
    is_current(&scene, &choices, place.path()).expect("as it was written");
    // Masses are no part of the code, but of what its certificate was measured with.
    let mut description = (*scene).clone();
    let mass = &mut description.bodies[0].mass_properties.mass;
    *mass = mass.next_up();
    let heavier = Scene::new(description).expect("the bodies are physical");
    let stale = is_current(&heavier, &choices, place.path()).expect_err("another mass");
    assert!(
        matches!(stale, PackageError::Outdated { standing: Some(Standing::Stale), .. }),
        "{stale}"
    );
    let before = relative(place.path());
    let outcome = generate(&heavier, &choices, place.path()).expect("what was ours is replaced");
    assert!(matches!(outcome, Written::Anew { .. }), "{outcome:?}");
    assert_ne!(relative(place.path()), before);
    is_current(&heavier, &choices, place.path()).expect("as it was written");
}

#[test]
fn lines_of_a_checkout_may_end_otherwise() {
    let (scene, choices) = (one_boom(), Choices::default());
    let place = written(&scene, &choices);
    for (path, bytes) in contents(place.path()) {
        let text = String::from_utf8(bytes).expect("text");
        fs::write(path, text.replace('\n', "\r\n")).expect("writable");
    }
    is_current(&scene, &choices, place.path()).expect("as it was written");
    assert_eq!(generate(&scene, &choices, place.path()).ok(), Some(Written::UpToDate));
    let baked = Choices { numbers: Numbers::Baked, ..choices };
    generate(&scene, &baked, place.path()).expect("what was written here is replaced");
    assert_eq!(relative(place.path()), relative(written(&scene, &baked).path()));
}

/// It is done for all members of a workspace at once.
#[test]
fn cargo_fmt_leaves_a_crate_alone() {
    let scene = satellite("booms", &[3, 1]);
    let choices =
        Choices { equations: true, lock_states: true, right_side: true, ..Choices::default() };
    let place = written(&scene, &choices);
    let done = Command::new(env!("CARGO")).arg("fmt").current_dir(place.path()).status();
    assert!(done.expect("cargo starts").success());
    is_current(&scene, &choices, place.path()).expect("as it was written");
}
