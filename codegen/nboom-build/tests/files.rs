//! What a build script does to files: an up-to-date one is left alone, a stale one is written
//! anew, and nothing of the user's is overwritten.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use nboom_build::{BuildError, Config, Formulation, Level, Symmetry};

const SAMPLE: &str = "../../examples/n-boom-1970.nml";

fn satellite() -> Config {
    Config::new().topology("Satellite", "S1_P").scalar_path("::nboom::scalar")
}

/// A folder, and the path of a file in it.
fn place() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join("routines.rs");
    (folder, path)
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).expect("the file is there")
}

fn written(config: &Config) -> String {
    let (_folder, path) = place();
    config.write_to(&path).expect("there is no file");
    text(&path)
}

fn message(result: Result<(), BuildError>) -> String {
    format!("{:?}", result.expect_err("refused"))
}

#[test]
fn a_file_outside_the_output_directory_is_not_overwritten() {
    let (_folder, path) = place();
    fs::write(&path, "fn mine() {}").expect("the folder is ours");
    for file in [path.to_str().expect("text"), "../routines.rs", "generated/../../routines.rs"] {
        let told = message(satellite().write(file));
        assert!(told.contains(&format!("file `{file}` found, one in OUT_DIR expected")), "{told}");
    }
    assert_eq!(text(&path), "fn mine() {}");
}

#[test]
fn an_up_to_date_file_is_not_written_again() {
    let (_folder, path) = place();
    satellite().write_to(&path).expect("there is no file");
    let long_ago = SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000);
    let modified = || fs::metadata(&path).and_then(|data| data.modified()).expect("a time");
    let file = fs::File::options().write(true).open(&path).expect("the file is there");
    file.set_modified(long_ago).expect("the file is ours");
    satellite().write_to(&path).expect("it is current");
    satellite().check(&path).expect("it is current");
    assert_eq!(modified(), long_ago);
    satellite().level(Level::Exact).write_to(&path).expect("a stale file is written anew");
    assert_ne!(modified(), long_ago);
    assert!(text(&path).contains("level exact"));
}

#[test]
fn a_checked_in_file_that_is_not_current_is_named_with_the_remedy() {
    let (_folder, path) = place();
    let missing = message(satellite().check(&path));
    assert!(missing.contains("routines.rs: there is no such file; NBOOM_BLESS=1 cargo build"));
    assert!(!path.exists());

    satellite().write_to(&path).expect("there is no file");
    let (current, other) = (text(&path), satellite().formulation(Formulation::Symmetric));
    let stale = message(other.check(&path));
    assert!(stale.contains("routines.rs: generated from another scene or request"), "{stale}");
    assert!(stale.contains("NBOOM_BLESS=1 cargo build writes it anew"));

    let changed = current.replacen("EXTERNAL: bool = false", "EXTERNAL: bool = true", 1);
    fs::write(&path, changed).expect("the folder is ours");
    let edited = message(satellite().check(&path));
    assert!(edited.contains("routines.rs: changed by hand since it was generated"), "{edited}");

    fs::write(&path, "fn main() {}\n").expect("the folder is ours");
    let foreign = message(satellite().check(&path));
    assert!(foreign.contains("routines.rs: not a generated file"), "{foreign}");
}

#[test]
fn nothing_of_the_users_is_overwritten() {
    let (_folder, path) = place();
    let edited = written(&satellite()) + "// mine\n";
    for theirs in [edited.as_bytes(), b"fn main() {}\n", b"", b"\xff\xfe"] {
        fs::write(&path, theirs).expect("the folder is ours");
        let error = satellite().write_to(&path).expect_err("refused");
        assert!(matches!(error, BuildError::NotCurrent { .. }), "{error}");
        // The variable lets only `check` write.
        assert!(!error.to_string().contains("NBOOM_BLESS"), "{error}");
        assert_eq!(fs::read(&path).expect("the file is there"), theirs);
    }
}

#[test]
fn options_reach_the_code() {
    let plain = written(&satellite());
    assert!(plain.contains("use ::nboom::scalar::{"));
    assert!(plain.contains("by formulation articulated, level fast"));
    assert!(plain.contains("pub fn kernels() -> &'static [::nboom::scalar::Kernel]"));
    assert!(plain.contains("const EXTERNAL: bool = false"));
    let forced = written(&satellite().with_external_wrench().with_symmetry(Symmetry::Principal));
    assert!(forced.contains("const EXTERNAL: bool = true"));
    assert!(forced.contains("O at the main body's mass centre"));
    let held = written(&satellite().with_external_wrench().with_held_main_body());
    assert!(held.contains("main body held"));
    let equations = satellite().formulation(Formulation::Symmetric).for_equations();
    let equations = written(&equations);
    assert!(equations.contains("equations by formulation symmetric"));
    // Equations are no accelerations, which is what a run takes kernels for.
    assert!(!equations.contains("kernels()"));
    let inverse = written(&satellite().for_inverse_dynamics());
    assert!(inverse.contains("inverse_dynamics by formulation articulated"));
    assert!(!inverse.contains("kernels()"));
}

/// A rig's mass properties are in the wrench that holds it.
#[test]
fn inverse_dynamics_of_a_scene_on_a_rig_is_that_of_a_free_main_body() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let rig = folder.path().join("rig.toml");
    let main = "name = 'rig'\nunits = 'SI'\n[run]\nend = 1.0\n[main_body]\nmass = 9.0\n\
                inertia = [4.0, 3.0, 2.0]\nbase = 'fixed'\n";
    let boom = "[[body]]\nname = 'boom'\nmass = 1.0\ninertia = [0.1, 0.1, 0.1]\n\
                mass_centre = [0.0, 0.5, 0.0]\n[body.hinge]\nat = [0.0, 0.5, 0.0]\naxis = 'x'\n";
    fs::write(&rig, main.to_owned() + boom).expect("the folder is ours");
    let plain = written(&Config::new().scene(&rig));
    assert!(plain.contains("main body held"), "{plain}");
    let inverse = written(&Config::new().scene(&rig).for_inverse_dynamics());
    assert!(inverse.contains("inverse_dynamics by formulation articulated"), "{inverse}");
    assert!(!inverse.contains("main body held"), "{inverse}");

    let nothing =
        main.replace("mass = 9.0", "mass = 0.0").replace("[4.0, 3.0, 2.0]", "[0.0, 0.0, 0.0]");
    fs::write(&rig, nothing + boom).expect("the folder is ours");
    assert!(written(&Config::new().scene(&rig)).contains("main body held"));
    let (_folder, path) = place();
    for config in [Config::new().for_inverse_dynamics(), Config::new().for_equations()] {
        let refused = message(config.scene(&rig).write_to(&path));
        assert!(refused.contains("main body without mass found"), "{refused}");
    }
}

#[test]
fn a_scene_gives_its_routines() {
    let both = Config::new().scene(SAMPLE).baked_scene(SAMPLE).with_lock_states();
    let text = written(&both);
    for name in ["SatelliteS2P", "BakedS2P", "SatelliteS2", "SatelliteM"] {
        assert_eq!(text.matches(&format!("pub struct {name};")).count(), 1, "{name}");
        assert!(text.contains(&format!("Kernel::of::<{name}>()")), "{name}");
    }
    let right_sides =
        ["RightSideBakedS2P", "PushedBakedS2P", "RightSideSatelliteS2P", "PushedSatelliteS2S1"];
    let with_right_sides = written(&both.with_right_sides());
    for name in right_sides {
        assert!(!text.contains(name), "{name}");
        assert!(with_right_sides.contains(&format!("Kernel::of::<{name}>()")), "{name}");
    }
    let on_eight = |name: &&str| with_right_sides.contains(&format!("Batch::of::<{name}>()"));
    assert!(right_sides.iter().all(on_eight));
    let alone = written(&Config::new().scene(SAMPLE));
    assert_eq!(alone.matches("pub struct ").count(), 1);
}

/// The example in TOML has the motion of the sample deck, so its routines are those of the deck.
#[test]
fn a_scene_in_toml_gives_the_routines_of_its_deck() {
    let of = |file: &str| {
        written(&Config::new().scene(file).baked_scene(file).with_lock_states().with_right_sides())
    };
    let (deck, toml) = (of(SAMPLE), of("../../examples/n-boom.toml"));
    assert!(deck.contains("pub struct BakedS2P;"));
    let differing = deck.lines().zip(toml.lines()).find(|(deck, toml)| deck != toml);
    assert_eq!((differing, deck.lines().count()), (None, toml.lines().count()));
}

#[test]
fn what_cannot_be_generated_is_said_in_words() {
    let (_folder, path) = place();
    let topology = message(Config::new().topology("Satellite", "S2_Q").write_to(&path));
    assert!(
        topology.starts_with("routine `Satellite`: `S2_Q` found, a topology like"),
        "{topology}"
    );
    let twice = satellite().topology("Satellite", "S2");
    assert!(message(twice.write_to(&path)).starts_with("two routines are named `Satellite`"));
    let dense = Config::new().topology("Dense", "S60").formulation(Formulation::Report);
    assert!(message(dense.write_to(&path)).contains("topology S60, formulation report"));
    let nowhere = message(Config::new().scene("nowhere.nml").write_to(&path));
    assert!(nowhere.starts_with("nowhere.nml: the file cannot be read: "), "{nowhere}");
    assert!(!path.exists());
    fs::write(&path, "no folder").expect("the folder is ours");
    let in_a_file = message(satellite().write_to(path.join("none.rs")));
    assert!(in_a_file.contains("none.rs: "), "{in_a_file}");
}

#[test]
fn output_goes_where_cargo_says() {
    // Cargo sets OUT_DIR for packages that have a build script, which this one has not.
    assert!(message(satellite().write("routines.rs")).starts_with("OUT_DIR is not set"));
}

/// Cargo would run the script, and compile the program, in every build.
#[test]
fn cargo_is_to_look_at_no_file_that_is_not_there() {
    const INSIDE: &str = "NBOOM_BUILD_SCRIPT";
    if std::env::var_os(INSIDE).is_some() {
        return satellite().write_to("routines.rs").expect("there is no file");
    }
    let (folder, path) = place();
    let name = "cargo_is_to_look_at_no_file_that_is_not_there";
    let mut script = Command::new(std::env::current_exe().expect("this test"));
    script.args(["--exact", name, "--nocapture"]).current_dir(&folder).env(INSIDE, "1");
    let said = script.output().expect("it runs").stdout;
    assert!(path.exists());
    let said = String::from_utf8(said).expect("text");
    // Without any condition cargo looks at the whole package.
    assert!(said.contains("cargo::rerun-if-"), "{said}");
    // The name of the test may stand before the first.
    for (_, file) in said.lines().filter_map(|line| line.split_once("cargo::rerun-if-changed=")) {
        assert!(folder.path().join(file).exists(), "{file}");
    }
}

/// The style of the program around it is another one, and a file that was changed is refused.
#[test]
fn rustfmt_leaves_a_checked_in_file_alone() {
    let (_folder, path) = place();
    let all = satellite().topology("Booms", "4xS5").scene(SAMPLE);
    let all = all.with_right_sides().with_stresses();
    all.write_to(&path).expect("there is no file");
    let said = Command::new("rustfmt").args(["--edition", "2024"]).arg(&path).output();
    let said = said.expect("the toolchain has rustfmt");
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    all.check(&path).expect("it is as it was written");
}
