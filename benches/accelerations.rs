//! Nanoseconds for the accelerations of one state: the recursive path, the generated routine in
//! this processor's code, the same on eight states at once, and the same with one directional
//! derivative, on the four satellites of `benches/scenes`; and for the right side of the differential
//! equations in one routine, for few hinges also with lines that push the links.
//!
//! `cargo bench --bench accelerations` prints a line for each, with the shortest and the median
//! of many samples and the ratio to the recursive path measured in the same run.

use std::hint::black_box;
use std::path::Path;

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::{Forces, Recognised, RightSideLayout, assumptions_in_a_word, recognise};
use nboom::model::{HingeState, Mode, Scene};
use nboom::scalar::{Dual, Eight, Real, Routine};
use nboom_routines::{Principal4S5, Principal20S5, PrincipalS2P, PrincipalS100};
use timing::{STATES, State, numbers, state, time};

#[path = "timing/mod.rs"]
mod timing;

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
        let assumptions = assumptions_in_a_word(kernel);
        let label = format!("generated_articulated_{assumptions}_{}", kernel.instructions);
        report(name, &label, generated, recursive);
    }
    right_sides(name, &dynamics, &recognised, recursive);
    let eight = eight_at_once(&topology, &parameters);
    report(name, "generated_articulated_principal_lanes8", eight, recursive);
    let dual = match topology.as_str() {
        "S2_P" => with_derivative::<PrincipalS2P>(&parameters),
        "4xS5" => with_derivative::<Principal4S5>(&parameters),
        "S100" => with_derivative::<PrincipalS100>(&parameters),
        _ => with_derivative::<Principal20S5>(&parameters),
    };
    report(name, "generated_articulated_principal_dual", dual, recursive);
}

/// The right side of a mode's differential equations: accelerations, hinge laws and attitude in one, and
/// forces along lines where a routine takes them.
fn right_sides(
    name: &str,
    dynamics: &Recursive<f64>,
    recognised: &Recognised,
    recursive: (f64, f64),
) {
    let forces = Forces::of(dynamics.elements(), dynamics.tree(), recognised);
    let forces = forces.expect("the scenes have springs and dashpots alone");
    let numbers = [recognised.parameters.write(), forces.write()].concat();
    let topology = recognised.topology.to_string();
    let kernels = nboom_routines::right_sides().iter();
    for kernel in kernels.filter(|kernel| kernel.topology == topology) {
        let first_line = RightSideLayout::coefficients(&recognised.topology, 0).start;
        let is_pushed = kernel.assumptions.iter().all(|&(at, _)| at != first_line);
        let word =
            format!("{}{}", assumptions_in_a_word(kernel), if is_pushed { "_lines" } else { "" });
        assert!(kernel.accepts(&numbers), "the scenes have principal axes");
        let (mut constants, mut out) = (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
        kernel.prepare(&numbers, &mut constants);
        let y: Vec<Vec<f64>> = (0..STATES).map(|i| self::numbers(i, kernel.coordinates)).collect();
        let generated = time(|i| {
            kernel.evaluate(black_box(&constants), black_box(&y[i]), black_box(&mut out));
        });
        report(
            name,
            &format!("generated_right_side_{word}_{}", kernel.instructions),
            generated,
            recursive,
        );
    }
}

/// Time per state when eight are evaluated at once, each with parameters of its own.
fn eight_at_once(topology: &str, parameters: &[f64]) -> (f64, f64) {
    let mut batches = nboom_routines::batches().iter();
    let batch = batches.find(|batch| batch.topology == topology).expect("a batch for each scene");
    let parameters: Vec<Eight> = parameters.iter().map(|&value| Eight::splat(value)).collect();
    let mut constants = vec![Eight::default(); batch.constants];
    let mut out = vec![Eight::default(); batch.outputs];
    batch.prepare(&parameters, &mut constants);
    let eight = |i: usize| -> Vec<Eight> {
        let states: [Vec<f64>; 8] =
            std::array::from_fn(|lane| numbers(8 * i + lane, batch.coordinates));
        let side_by_side = |j: usize| Eight(std::array::from_fn(|lane| states[lane][j]));
        (0..batch.coordinates).map(side_by_side).collect()
    };
    let states: Vec<Vec<Eight>> = (0..STATES).map(eight).collect();
    let (least, median) = time(|i| {
        batch.evaluate(black_box(&constants), black_box(&states[i]), black_box(&mut out));
    });
    (least / 8.0, median / 8.0)
}

/// Accelerations with their derivative in one direction of the state, on plain `f64`.
fn with_derivative<T: Routine>(parameters: &[f64]) -> (f64, f64) {
    let parameters: Vec<_> = parameters.iter().map(|&value| Dual::constant(value)).collect();
    let mut constants = vec![Dual::zero(); T::CONSTANTS];
    let mut out = vec![Dual::zero(); T::OUTPUTS];
    T::prepare(&parameters, &mut constants);
    let dual = |i: usize| -> Vec<Dual<f64>> {
        let (values, directions) = (numbers(i, T::COORDINATES), numbers(i + 7, T::COORDINATES));
        let both = values.into_iter().zip(directions);
        both.map(|(value, derivative)| Dual { value, derivative }).collect()
    };
    let states: Vec<_> = (0..STATES).map(dual).collect();
    time(|i| T::evaluate(black_box(&constants), black_box(&states[i]), black_box(&mut out)))
}

fn report(scene: &str, path: &str, (least, median): (f64, f64), recursive: (f64, f64)) {
    let ratio = recursive.0 / least;
    println!(
        "{scene} {path} ns_min {least:.1} ns_median {median:.1} faster_than_recursive {ratio:.2}"
    );
}
