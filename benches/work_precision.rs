//! Run time of whole runs against their error, for all code and integrators, on six scenes and on the
//! smooth one that peers integrate.
//!
//! `cargo bench --bench work_precision [-- DIR [SCENE ...]]` prints a table for each scene and writes
//! `SCENE.csv` with all runs and `SCENE.svg`; without DIR below cargo's folder for such files. It is
//! what `nboom bench --work-precision` does for a scene of your own.

use std::fs;
use std::path::{Path, PathBuf};

use nboom_verify::WorkPrecision;

/// For each code and integrator.
const SECONDS: f64 = 0.6;

/// Names and decks.
const SCENES: [(&str, &str); 7] = [
    ("report", "examples/n-boom-1970.nml"),
    ("top", "benches/scenes/top.nml"),
    ("4x5", "benches/scenes/T2.nml"),
    ("whip", "benches/scenes/whip.nml"),
    ("latch", "benches/scenes/latch.nml"),
    ("spin", "benches/scenes/spin.nml"),
    ("T1_smooth", "benches/scenes/T1_smooth.nml"),
];

fn main() {
    // Cargo itself adds `--bench`.
    let mut words = std::env::args().skip(1).filter(|word| word != "--bench");
    let in_target = || PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("work-precision");
    let directory = words.next().map_or_else(in_target, PathBuf::from);
    let chosen: Vec<String> = words.collect();
    fs::create_dir_all(&directory).expect("the folder can be made");
    for (name, deck) in SCENES {
        if !chosen.is_empty() && chosen.iter().all(|word| word != name) {
            continue;
        }
        let deck = Path::new(env!("CARGO_MANIFEST_DIR")).join(deck);
        let scene = nboom::io::read_scene(&deck).expect("the deck is in the clone").scene;
        let routines = (nboom_routines::for_runs(), nboom_routines::right_sides_of_eight());
        let found = WorkPrecision::measure(&scene, routines, SECONDS);
        let found = found.expect("the reference comes to its end");
        for (ending, text) in [("csv", found.csv()), ("svg", found.picture())] {
            let file = directory.join(format!("{name}.{ending}"));
            fs::write(file, text).expect("the folder can be written to");
        }
        println!("{}", found.table());
    }
    println!("files {}", directory.display());
}
