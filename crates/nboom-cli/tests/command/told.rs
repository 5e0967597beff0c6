//! What commands tell beside the results: warnings about what nobody means, and what is ignored.

use crate::{BOOM, Place, code, stderr, stdout};

#[test]
fn what_is_probably_not_meant_is_a_warning_of_check_and_of_run() {
    let place = Place::new();
    let deck = BOOM
        .replace("EKNIK(1,2)=-30.0", "EKNIK(1,2)=30.0,QNIK(1,2)=0.5")
        .replace("RELTB=0.25", "RELTB=2.0E6")
        .replace("TF=4.0", "TZO=1999999.0,TF=2000001.0");
    place.write("boom.nml", &deck);
    let words = [
        "boom.nml:12:15: RELTB(1): found time 2000000 in a run from 1999999 to 2000001, expected less than \
         1e6; from there on it means never, and the hinge is not released",
    ];
    let check = place.nboom(&["check", "boom.nml"]);
    let run = place.nboom(&["run", "boom.nml"]);
    for output in [&check, &run] {
        assert_eq!(code(output), 0);
        for words in words {
            assert!(stderr(output).contains(words), "no {words:?} in {}", stderr(output));
        }
    }
    let deck = deck.replace("RELTB=2.0E6", "RELTB=0.25");
    place.write("boom.nml", &deck.replace("BETAIK=80.0", "BETAIK=-80.0"));
    let check = place.nboom(&["check", "boom.nml"]);
    let run = place.nboom(&["run", "boom.nml", "--end-time", "1999999.5"]);
    let told = [
        "dashpot of hinge 1,1 feeds energy: a torque of 0.5 for each unit of rate",
        "spring of hinge 1,1 pushes the harder the farther it is from 0 deg",
        "torque of springs, tables and couplings on hinge 1,1 where it starts drives it away from its lock angle: from -80 deg, not towards 0 deg",
    ];
    for words in told {
        for output in [&check, &run] {
            assert!(stderr(output).contains(words), "no {words:?} in {}", stderr(output));
        }
        let summary = place.summary("out/boom");
        let warnings = summary["warnings"].as_array().expect("a list").iter();
        let warnings: Vec<&str> = warnings.map(|w| w.as_str().expect("text")).collect();
        assert!(warnings.iter().any(|warning| warning.contains(words)), "{warnings:?}");
    }
}

#[test]
fn an_end_time_beyond_a_release_time_that_means_never_is_a_warning() {
    let place = Place::new();
    place.write("boom.nml", &BOOM.replace("RELTB=0.25", "RELTB=2.0E6"));
    let words = "end time 3000000: hinge 1,1 is never released";
    for (end_time, is_told) in [("3E6", true), ("1E5", false)] {
        let run = place.nboom(&["run", "boom.nml", "--samples", "1", "--end-time", end_time]);
        let vary = "[[vary]]\npath = 'main_body.mass'\nuniform = { from = 9.0, to = 11.0 }\n";
        let of_runs = format!("[run]\nstresses = false\nsamples = 1\nend_time = {end_time}\n");
        place.write("study.toml", &format!("scene = 'boom.nml'\ndraws = 2\n{of_runs}{vary}"));
        let sweep = place.nboom(&["sweep", "study.toml", "--no-report", "-o", end_time]);
        for output in [run, sweep] {
            assert_eq!(code(&output), 0, "{}", stderr(&output));
            let times = stderr(&output).matches(words).count();
            assert_eq!(times, usize::from(is_told), "{}", stderr(&output));
        }
    }
}

#[test]
fn a_scene_that_waits_without_a_release_time_is_not_warned_of_one() {
    let place = Place::new();
    place.write("boom.nml", &BOOM.replace("RELTB=0.25", "RELTB=2.0E6"));
    assert_eq!(code(&place.nboom(&["convert", "boom.nml", "-o", "boom.toml"])), 0);
    let run = place.nboom(&["run", "boom.toml", "--samples", "1", "--end-time", "3E6"]);
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    assert!(!stderr(&run).contains("never released"), "{}", stderr(&run));
}

#[test]
fn stresses_at_few_output_times_are_ignored_where_there_are_no_loads() {
    let place = Place::new();
    let scene = "[run]\nend = 1.0\n\n[output]\nstress_every = 3\n\n[main_body]\nmass = 100.0\n\
                 inertia = [40.0, 30.0, 20.0]\n";
    let boom = "\n[[body]]\nname = \"boom\"\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\ninertia = [1.0, 0.1, 1.0]\n\n[body.hinge]\n\
                at = [0.0, 2.0, 0.0]\naxis = \"x\"\n";
    place.write("boom.toml", &format!("{scene}{boom}"));
    let told = "ignored: stress_every (it thins out loads, and there are none)";
    let run = |args: &[&str]| {
        let output = place.nboom(&[&["run", "boom.toml"], args].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        stderr(&output).contains(told)
    };
    assert!(run(&[]));
    assert!(!run(&["--hinge-loads"]));
    let check = place.nboom(&["check", "boom.toml"]);
    assert!(stdout(&check).contains(told), "{}", stdout(&check));
}

#[test]
fn a_deck_is_told_of_its_own_symbol() {
    let place = Place::new();
    place.write("boom.nml", &BOOM.replace("INSTR=0", "INSTR=3"));
    let output = place.nboom(&["run", "boom.nml"]);
    let told = "ignored: INSTR (it thins out loads, and there are none)";
    assert!(stderr(&output).contains(told), "{}", stderr(&output));
}

#[test]
fn words_that_do_nothing_are_said_to_be_ignored() {
    let place = Place::new();
    let words = "IAX=2,HZO=0.001,LSTEP=1000,SEGSTT=0.0";
    place.write("boom.nml", &BOOM.replace("SEGSTT=0.0", words).replace("NOPLT=1", "NOPLT=0"));
    let note = |args: &[&str]| {
        let output = place.nboom(&[&["run", "boom.nml"], args].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        stderr(&output).lines().filter(|line| line.contains("ignored")).collect::<String>()
    };
    let (rkam, iax) = ("HZO, LSTEP (they steer --integrator rkam)", "IAX (it thins out --listing)");
    let plots = "NOPLT=0 (--plots asks for figures)";
    assert_eq!(note(&[]), format!("note: ignored: {rkam}; {iax}; {plots}"));
    assert_eq!(note(&["--listing"]), format!("note: ignored: {rkam}; {plots}"));
    assert_eq!(note(&["--integrator", "rkam"]), format!("note: ignored: {iax}; {plots}"));
    assert_eq!(note(&["--quiet"]), "");
    let check = place.nboom(&["check", "boom.nml"]);
    assert!(stdout(&check).contains(&format!("\nignored: {rkam}; {iax}; {plots}\n")));
    place.write("boom.nml", BOOM);
    assert_eq!(note(&[]), "");
    assert_eq!(note(&["--lanes"]), "");
    let lanes = "note: ignored: --lanes (the integrator takes no explicit steps)";
    let implicit = ["radau5", "radau9", "radau13", "gauss", "gauss_lanes"];
    for integrator in implicit.into_iter().chain(["adams", "taylor", "rkam"]) {
        assert_eq!(note(&["--lanes", "--integrator", integrator]), lanes, "{integrator}");
    }
}

#[test]
fn a_formulation_that_does_not_cover_the_scene_is_ignored_aloud() {
    let place = Place::new();
    let scene = |rotors: &str| {
        format!(
            "[run]\nend = 1.0\n[main_body]\nmass = 100.0\ninertia = [40.0, 30.0, 20.0]\n{rotors}[[body]]\nname = \"boom\"\nmass = 2.0\n\
             mass_centre = [0.0, 1.0, 0.0]\ninertia = [1.0, 0.1, 1.0]\n[body.hinge]\nat = [0.0, 1.0, 0.0]\n\
             axis = \"x\"\n"
        )
    };
    let told = "note: ignored: --formulation momentum (formulation momentum does not cover rotors)";
    let rotor = "[[main_body.rotor]]\naxis = \"z\"\ninertia = 0.1\nspeed_rad = 10.0\n";
    for (rotors, is_told) in [(rotor, true), ("", false)] {
        place.write("scene.toml", &scene(rotors));
        for quiet in [&[][..], &["--quiet"]] {
            let words = ["run", "scene.toml", "--no-report", "--formulation", "momentum"];
            let run = place.nboom(&[&words[..], quiet].concat());
            assert_eq!(code(&run), 0, "{}", stderr(&run));
            let is_told = is_told && quiet.is_empty();
            assert_eq!(stderr(&run).contains(told), is_told, "{}", stderr(&run));
            for shard in [&[][..], &["--shard", "1/2"]] {
                let vary =
                    "[[vary]]\npath = 'main_body.mass'\nuniform = { from = 90.0, to = 110.0 }\n";
                let study = "scene = 'scene.toml'\ndraws = 2\n[run]\nformulation = 'momentum'\n";
                place.write("study.toml", &format!("{study}{vary}"));
                let directory = format!("out-{rotors:.1}-{}-{}", quiet.len(), shard.len());
                let directory = directory.replace('[', "rotor");
                let words = ["sweep", "study.toml", "--no-report", "-o", &directory];
                let sweep = place.nboom(&[&words[..], quiet, shard].concat());
                assert_eq!(code(&sweep), 0, "{}", stderr(&sweep));
                let told = "note: ignored in case 1: formulation momentum (formulation momentum does not cover rotors)";
                let times = stderr(&sweep).matches(told).count();
                assert_eq!(times, usize::from(is_told), "{}", stderr(&sweep));
            }
        }
    }
}
