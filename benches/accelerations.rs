//! Nanoseconds for the accelerations of one state: the recursive path, and the generated
//! routine in this processor's code, on the four satellites of `benches/scenes`.
//!
//! `cargo bench --bench accelerations` prints a line for each, with the shortest and the median
//! of many samples and the ratio to the recursive path measured in the same run.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::recognise;
use nboom::model::{HingeState, Mode, Scene};
use nboom::scalar::Vec3;

/// Different states, so that nothing can be learnt from one.
const STATES: usize = 64;
const SAMPLES: usize = 1000;

struct State {
    omega: Vec3<f64>,
    beta: Vec<f64>,
    tau: Vec<f64>,
}

fn main() {
    for name in ["T1", "T2", "T3", "T4"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("benches/scenes/{name}.nml"));
        let scene = nboom::io::read_scene(&path).expect("the scene is in the clone").scene;
        measure(name, &scene);
    }
}

fn measure(name: &str, scene: &Scene) {
    let hinges = scene.bodies.len();
    let mode = Mode { hinges: vec![HingeState::Free; hinges], ..Mode::at_start(scene) };
    let mut dynamics = Recursive::<f64>::new(scene);
    dynamics.set_mode(&mode, &vec![0.0; hinges]);
    let states: Vec<State> = (0..STATES).map(|i| state(i, hinges)).collect();

    let mut found = Accelerations::for_hinges(hinges);
    let recursive = time(|i| {
        let State { omega, beta, tau } = &states[i];
        let motion = Motion { omega_body: *omega, beta, tau };
        dynamics.accelerations(black_box(&motion), black_box(&mut found));
    });
    report(name, "generic_recursive", recursive, recursive);

    let recognised = recognise(dynamics.tree()).expect("chains and paddles");
    let (topology, parameters) = (recognised.topology.to_string(), recognised.parameters.write());
    for kernel in nboom_routines::all().iter().filter(|kernel| kernel.topology == topology) {
        if !kernel.accepts(&parameters) {
            continue;
        }
        let (mut constants, mut out) = (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
        kernel.prepare(&parameters, &mut constants);
        let coordinates: Vec<Vec<f64>> =
            (0..STATES).map(|i| numbers(i, kernel.coordinates)).collect();
        let generated = time(|i| {
            kernel.evaluate(black_box(&constants), black_box(&coordinates[i]), black_box(&mut out));
        });
        let facts = if kernel.pinned.is_empty() { "general" } else { "principal" };
        let label = format!("generated_articulated_{facts}_{}", kernel.instructions);
        report(name, &label, generated, recursive);
    }
}

fn state(i: usize, hinges: usize) -> State {
    let all = numbers(i, 3 + 2 * hinges);
    State {
        omega: Vec3::new(all[0], all[1], all[2]),
        beta: all[3..3 + hinges].to_vec(),
        tau: all[3 + hinges..].to_vec(),
    }
}

/// Numbers between −2 and 2, different for each `i`.
fn numbers(i: usize, count: usize) -> Vec<f64> {
    (0..count).map(|j| 2.0 * (1.7 * j as f64 + 0.9 * i as f64 + 0.3).sin()).collect()
}

/// Shortest and median time of a call.
fn time(mut call: impl FnMut(usize)) -> (f64, f64) {
    (0..2000).for_each(|i| call(i % STATES));
    let mut samples: Vec<f64> = (0..SAMPLES)
        .map(|_| {
            let start = Instant::now();
            (0..STATES).for_each(&mut call);
            start.elapsed().as_secs_f64() * 1e9 / STATES as f64
        })
        .collect();
    samples.sort_by(f64::total_cmp);
    (samples[0], samples[SAMPLES / 2])
}

fn report(scene: &str, path: &str, (least, median): (f64, f64), recursive: (f64, f64)) {
    let ratio = recursive.0 / least;
    println!(
        "{scene} {path} ns_min {least:.1} ns_median {median:.1} faster_than_recursive {ratio:.2}"
    );
}
