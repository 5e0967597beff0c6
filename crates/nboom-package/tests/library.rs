//! Routines of a scene that are compiled into a library and loaded into this process.

use std::fs;
use std::path::Path;

use nboom_codegen::{Level, Module};
use nboom_formulation::Formulation;
use nboom_io::read_scene;
use nboom_package::{Build, PackageError, library, load};
use nboom_sim::{Options, Recorder, Snapshot, simulate};

/// The end of a run.
struct Last(Vec<f64>);

impl Recorder for Last {
    fn sample(&mut self, snapshot: &Snapshot) -> std::io::Result<()> {
        let Snapshot { omega_body, beta, tau, .. } = snapshot;
        self.0 = [&omega_body.to_array()[..], beta, tau].concat();
        Ok(())
    }
}

fn end(path: &Path, options: Options) -> (Vec<f64>, &'static str) {
    let file = read_scene(path).expect("an example");
    let mut last = Last(Vec::new());
    let summary = simulate(&file.scene, &options, &mut last).expect("a run");
    (last.0, summary.code().path)
}

/// The crates that it uses have no dependencies, so that cargo needs no network.
#[test]
fn a_running_program_takes_the_routines_of_a_library() {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/boom.toml");
    let place = tempfile::tempdir().expect("a directory");
    let build = Build { work: Some(place.path().to_owned()), offline: true, ..Build::default() };
    let file = read_scene(&example).expect("an example");
    let made = library(&file.scene, None, &build, |_| {}).expect("cargo runs this test");
    assert!(!made.up_to_date && made.routines > 0 && made.topology == "S1", "{made:?}");
    let again = library(&file.scene, None, &build, |_| {}).expect("it is there");
    assert!(again.up_to_date && again.path == made.path);

    let loaded = load(&made.path).expect("a library of ours");
    assert!(!loaded.kernels.is_empty() && !loaded.batches.is_empty());
    let (kernels, batches) = (loaded.kernels, loaded.batches);
    let (by_recursion, generic) = end(&example, Options::default());
    let (by_library, generated) = end(&example, Options { kernels, batches, ..Options::default() });
    assert_eq!((generic, generated), ("generic", "generated"));
    // Both are within the tolerance of a step, 1e-9, of the truth.
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-7 * a.abs().max(1.0);
    assert!(by_recursion.iter().zip(&by_library).all(close), "{by_recursion:?} {by_library:?}");
}

#[test]
fn what_is_no_library_of_routines_is_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("it.so");
    let error = load(&path).expect_err("nothing is there");
    assert!(matches!(error, PackageError::Read { .. }), "{error}");
    fs::write(&path, "a text").expect("writable");
    let error = load(&path).expect_err("it is no library");
    assert!(matches!(error, PackageError::NoLibrary { .. }), "{error}");
}

/// Springs, slides, a hundred hinges, lines that push or do not: what is asked of the generator for each
/// example is code, or refused with a reason.
#[test]
fn no_example_is_too_much_for_the_generator() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut scenes = 0;
    for entry in fs::read_dir(examples).expect("readable") {
        let path = entry.expect("readable").path();
        if !path.extension().is_some_and(|ending| ending == "toml" || ending == "nml") {
            continue;
        }
        let file = read_scene(&path).expect("an example");
        let (formulation, level) = (Formulation::Articulated, Level::Fast);
        match Module::of_simulator(&file.scene, file.structure.as_ref(), formulation, level) {
            Ok(module) => assert!(!module.routines.is_empty(), "{}", path.display()),
            Err(error) => assert!(!error.to_string().is_empty(), "{}", path.display()),
        }
        scenes += 1;
    }
    assert!(scenes > 8, "{scenes} examples");
}
