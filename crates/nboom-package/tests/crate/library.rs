use nboom_package::{Build, Library, library, load};
use nboom_sim::{Options, Path as Code, Recorder, Snapshot, Summary, simulate};

use super::*;

/// How far the end of a run by generated code may be from one by the recursion, relative to it.
const AGREEMENT: f64 = 1e-9;

fn built(scene: &Scene, work: &Path) -> Library {
    let build = Build { work: Some(work.to_owned()), offline: true, ..Build::default() };
    library(scene, None, &build, |_| {}).expect("the scene is covered")
}

/// The numbers of the last state that is recorded.
#[derive(Default)]
struct Last(Vec<f64>);

impl Recorder for Last {
    fn sample(&mut self, snapshot: &Snapshot) -> std::io::Result<()> {
        let rates = snapshot.omega_body;
        let angles = snapshot.beta.iter().chain(&snapshot.tau).copied();
        let attitude = snapshot.attitude;
        let [x, y, z] = attitude.vector.to_array();
        self.0 = [attitude.scalar, x, y, z, rates.x, rates.y, rates.z]
            .into_iter()
            .chain(angles)
            .collect();
        Ok(())
    }
}

pub(super) fn run(scene: &Scene, options: &Options) -> (Vec<f64>, Summary) {
    let mut last = Last::default();
    let options = Options { rtol: 1e-12, atol: 1e-14, ..*options };
    let summary = simulate(scene, &options, &mut last).expect("the run comes to its end");
    (last.0, summary)
}

#[test]
fn a_scene_runs_by_the_routines_of_its_library() {
    let place = place();
    let scene = satellite("two booms", &[1, 2]);
    let first = built(&scene, place.path());
    assert_eq!((first.topology.as_str(), first.up_to_date), ("S2_S1", false));
    assert!(first.path.starts_with(place.path()) && first.folder.starts_with(place.path()));
    let number = first.folder.to_string_lossy().rsplit('-').next().map(str::to_owned);
    let name = first.path.file_name().expect("a file").to_string_lossy();
    assert!(number.is_some_and(|number| name.contains(&number)), "{name}");

    let loaded = load(&first.path).expect("it was built for this program");
    assert!(!loaded.batches.is_empty());
    assert!(loaded.kernels.len() <= first.routines, "{}", first.routines);
    let generated = Options {
        path: Code::Generated,
        kernels: loaded.kernels,
        batches: loaded.batches,
        ..Options::default()
    };
    let (found, summary) = run(&scene, &generated);
    assert_eq!(summary.code().path, "generated");
    let (expected, summary) = run(&scene, &Options { path: Code::Generic, ..Options::default() });
    assert_eq!(summary.code().path, "generic");
    assert_eq!(found.len(), 7 + 2 * 3);
    for (found, expected) in found.iter().zip(&expected) {
        let off = (found - expected).abs();
        assert!(off <= AGREEMENT * expected.abs(), "{found} {expected}");
    }

    let second = built(&scene, place.path());
    assert_eq!(second, Library { up_to_date: true, ..first });
}

/// Compiles a library from a text.
fn compiled(place: &Path, name: &str, text: &str) -> PathBuf {
    let source = place.join(name).with_extension("rs");
    fs::write(&source, text).expect("writable");
    let made = place.join(name);
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut command = Command::new(rustc);
    command.args(["--crate-type", "cdylib", "--crate-name", name, "-o"]).arg(&made).arg(&source);
    assert!(command.status().expect("the compiler starts").success());
    made
}

#[test]
fn what_is_no_library_of_routines_is_refused() {
    let place = place();
    let place = place.path();
    let refused = |path: &Path| load(path).expect_err("there are no routines");

    let nothing = refused(&place.join("nothing"));
    assert!(matches!(nothing, PackageError::Read { .. }), "{nothing}");

    let text = place.join("text");
    fs::write(&text, "no library").expect("writable");
    let no_library = refused(&text);
    assert!(matches!(no_library, PackageError::NoLibrary { .. }), "{no_library}");

    let other = compiled(place, "other", "");
    let no_routines = refused(&other);
    assert!(matches!(no_routines, PackageError::NoRoutines { .. }), "{no_routines}");

    let old = "#[no_mangle]\npub extern \"C\" fn nboom_routines() -> *const u64 { &7 }\n";
    let other_version = refused(&compiled(place, "old", old));
    let PackageError::OtherVersion { source, .. } = other_version else {
        panic!("{other_version}");
    };
    assert_eq!(source.found, 7);
    assert_ne!(source.expected, 7);
}
