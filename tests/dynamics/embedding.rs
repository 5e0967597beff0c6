//! Satellites in topologies with more hinges: what is virtual does not show.

use std::collections::BTreeMap;
use std::path::Path;

use nboom::formulation::{
    Coordinates, Embedding, Formulation, Layout, Parameters, Recognised, Symmetry,
    assumptions_in_a_word, recognise,
};
use nboom::model::{HingeState, Mode, Scene, Shape, Topology, WeldedTree};
use nboom::scalar::Kernel;
use nboom::sim::{Fit, Options, Repertoire};

use crate::random_scene::{Moment, Rng};
use crate::satellites::{Satellite, flat, random};
use crate::support::relative_error;

const RANDOM_SATELLITES: u64 = 3000;

/// What virtual links may change, relative to the largest acceleration and times the condition:
/// no term of a sum, but the order in which appendages are added up.
const ROUNDING: f64 = 1e-15;

/// A topology that holds the inner one: chains up to two links longer, and appendages added.
fn larger(inner: &Topology, dice: &mut Rng) -> Topology {
    let mut shapes = Vec::new();
    for shape in inner.shapes().iter().cloned() {
        shapes.push(match shape {
            Shape::Chain(links) => Shape::Chain(links + dice.below(3)),
            other => other,
        });
    }
    shapes.extend((0..dice.below(3)).map(|_| Shape::Chain(1 + dice.below(4))));
    shapes.extend((0..dice.below(2)).map(|_| Shape::Paddle));
    Topology::new(shapes)
}

/// The state with virtual hinges at zero.
fn embedded(embedding: &Embedding, inner: &Coordinates<f64>) -> Vec<f64> {
    let outer = embedding.outer();
    let mut numbers = vec![0.0; Layout::coordinates(outer)];
    numbers[..3].copy_from_slice(&inner.omega.to_array());
    numbers[3..6].copy_from_slice(&inner.external.moment.to_array());
    numbers[6..9].copy_from_slice(&inner.external.force.to_array());
    for (hinge, &place) in inner.hinges.iter().zip(embedding.places()) {
        let [beta, tau, torque] = Layout::hinge_in_state(outer, place);
        (numbers[beta], numbers[tau], numbers[torque]) = (hinge.beta, hinge.tau, hinge.torque);
    }
    numbers
}

/// (a_O, ω̇, τ̇ of the real hinges) from outputs of the outer topology.
fn of_real(embedding: &Embedding, outputs: &[f64]) -> Vec<f64> {
    assert!(outputs.iter().all(|number| number.is_finite()), "{outputs:?}");
    let mut all = [&outputs[3..6], &outputs[..3]].concat();
    all.extend(embedding.places().iter().map(|place| outputs[Layout::OUTPUT + place]));
    all
}

/// A number for each parameter, to be taken where nothing depends on it.
fn any_numbers(count: usize, dice: &mut Rng) -> Vec<(usize, f64)> {
    (0..count).map(|i| (i, dice.between(-2.0, 2.0))).collect()
}

#[test]
fn closed_forms_of_embedded_satellites_give_the_same_accelerations() {
    let mut worst = 0.0_f64;
    for seed in 0..RANDOM_SATELLITES {
        let satellite = Satellite::of_moment(&random(seed));
        let recognised = satellite.recognised();
        let Recognised { topology: inner, parameters, links, .. } = &recognised;
        let coordinates = satellite.coordinates_of(&recognised);
        let own = flat(&Formulation::Articulated.solve(inner, parameters, &coordinates));
        let dice = &mut Rng::new(seed ^ 0xe1b);
        let outer = larger(inner, dice);
        let embedding = Embedding::new(inner, &outer).expect("it is larger");
        let state = Coordinates::read(&outer, &embedded(&embedding, &coordinates));
        for assumptions in [vec![], any_numbers(Layout::parameters(&outer), dice)] {
            let numbers = embedding.parameters(parameters, &assumptions);
            let satellite_in_it = Parameters::read(&outer, numbers);
            let found =
                Formulation::Articulated.solve(&outer, &satellite_in_it, &state).write(&outer);
            let found = of_real(&embedding, &found);
            let error = relative_error(&found, &own, 0.0) / satellite.condition();
            worst = worst.max(error);
            assert!(error < ROUNDING, "seed {seed}, {inner} in {outer}: {error:e}");
            let error = relative_error(&found, &satellite.expected(links), 0.0);
            assert!(error < satellite.allowed(), "seed {seed}, {inner} in {outer}: {error:e}");
        }
    }
    println!("worst difference {worst:.1e} of the condition");
}

fn choosing_from(kernels: impl Iterator<Item = Kernel>) -> Options {
    Options { kernels: kernels.collect::<Vec<_>>().leak(), ..Options::default() }
}

/// Accelerations by a routine, against the recursive path.
fn check_routine(satellite: &Satellite, recognised: &Recognised, fit: &Fit, told: &str) {
    let state = embedded(&fit.embedding, &satellite.coordinates_of(recognised));
    let mut found = vec![0.0; fit.kernel.outputs];
    fit.kernel.evaluate(&fit.constants(), &state, &mut found);
    let found = of_real(&fit.embedding, &found);
    let error = relative_error(&found, &satellite.expected(&recognised.links), 0.0);
    let inner = &recognised.topology;
    assert!(error < satellite.allowed(), "{told}, {inner}, {}: {error:e}", fit.reason());
}

#[test]
fn stock_routines_give_the_accelerations_of_satellites_embedded_in_them() {
    let general = |kernel: &&Kernel| {
        kernel.assumptions.is_empty()
            && kernel.formulation == "articulated"
            && kernel.parameters > 10
    };
    let mut checked = BTreeMap::new();
    for &kernel in nboom_routines::all().iter().filter(general) {
        let options = choosing_from([kernel].into_iter());
        for seed in 0..RANDOM_SATELLITES {
            let satellite = Satellite::of_moment(&random(seed));
            let recognised = satellite.recognised();
            let Some(fit) = Repertoire::new(&options).best(&recognised, true) else { continue };
            if fit.embedding.virtual_links() > 0 {
                check_routine(&satellite, &recognised, &fit, &format!("seed {seed}"));
                *checked.entry(kernel.topology).or_insert(0) += 1;
            }
        }
    }
    println!("{checked:?}");
    for topology in ["4xS5", "4xS3", "S2_P", "S2_S1", "2xS3"] {
        assert!(checked.get(topology).is_some_and(|&count| count > 20), "{topology}: {checked:?}");
    }
}

/// A scene of the benches in a random state of a random mode; hinges are held at angles up to `held_at`, those
/// at the main body never.
fn in_some_mode(scene: &Scene, held_at: f64, seed: u64) -> Moment {
    let dice = &mut Rng::new(seed);
    let at_main_body = |i: usize| scene.bodies[i].inboard.is_none();
    let held = dice.between(0.0, 0.7);
    let hinges: Vec<HingeState> = (0..scene.bodies.len())
        .map(|i| match dice.chance(held) && !at_main_body(i) {
            true => HingeState::Locked,
            false => HingeState::Free,
        })
        .collect();
    let mode = Mode { hinges, ..Mode::at_start(scene) };
    let of_hinges = |[free, held]: [f64; 2], dice: &mut Rng| -> Vec<f64> {
        let size = |i| if mode.is_free(i) { free } else { held };
        (0..scene.bodies.len()).map(|i| size(i) * dice.between(-1.0, 1.0)).collect()
    };
    let (beta, tau) = (of_hinges([3.0, held_at], dice), of_hinges([2.0, 0.0], dice));
    let (omega, velocity_body) = (dice.vector(2.0), dice.vector(2.0));
    Moment { scene: scene.clone(), mode, beta, tau, omega, velocity_body }
}

fn bench_scene(name: &str) -> Scene {
    let path = format!("{}/benches/scenes/{name}.nml", env!("CARGO_MANIFEST_DIR"));
    nboom::io::read_scene(Path::new(&path)).expect("the scene is in the clone").scene
}

#[test]
fn routines_for_symmetric_satellites_take_those_with_fewer_links() {
    for (name, topology, symmetry, held_at) in [
        ("T2", "4xS5", Symmetry::Principal, 0.0),
        ("T2", "4xS5", Symmetry::Mirrored, 3.0),
        ("T4", "20xS5", Symmetry::Principal, 0.0),
        ("T4", "20xS5", Symmetry::Mirrored, 3.0),
        ("T1", "S2_P", Symmetry::Principal, 0.0),
    ] {
        let scene = bench_scene(name);
        let is_symmetric = |kernel: &Kernel| assumptions_in_a_word(kernel) == symmetry.name();
        let of_it = |kernel: &Kernel| kernel.topology == topology && is_symmetric(kernel);
        let options = choosing_from(nboom_routines::all().iter().copied().filter(of_it));
        let mut checked = 0;
        for seed in 0..200 {
            let satellite = Satellite::of_moment(&in_some_mode(&scene, held_at, seed));
            let recognised = satellite.recognised();
            let Some(fit) = Repertoire::new(&options).best(&recognised, false) else { continue };
            check_routine(&satellite, &recognised, &fit, &format!("{name}, seed {seed}"));
            checked += usize::from(fit.embedding.virtual_links() > 0);
        }
        println!("{name}: {checked}");
        assert!(checked > 20, "{name}: {checked}");
    }
}

/// The stock routine of this topology with every parameter of a satellite assumed.
fn baked(topology: &str, parameters: &[f64]) -> Kernel {
    let general = |kernel: &&Kernel| kernel.topology == topology && kernel.assumptions.is_empty();
    let mut kernel = *nboom_routines::all().iter().find(general).expect("a stock topology");
    kernel.assumptions = parameters.iter().copied().enumerate().collect::<Vec<_>>().leak();
    kernel
}

#[test]
fn a_routine_for_one_satellite_alone_takes_nothing_that_is_embedded() {
    let scene = bench_scene("T2");
    let of = |mode: Mode| {
        let beta = vec![0.0; scene.bodies.len()];
        recognise(&WeldedTree::new(&scene, &mode, &beta)).expect("four booms")
    };
    let at_start = Mode::at_start(&scene);
    let all_free = of(at_start.clone());
    let kernel = baked("4xS5", &all_free.parameters.write());
    let options = choosing_from([kernel].into_iter());
    assert!(Repertoire::new(&options).best(&all_free, false).is_some());
    for i in 0..scene.bodies.len() {
        let mut mode = at_start.clone();
        mode.hinges[i] = HingeState::Locked;
        let one_held = of(mode);
        assert!(Embedding::new(&one_held.topology, &all_free.topology).is_some());
        assert!(Repertoire::new(&options).best(&one_held, false).is_none(), "hinge {i} held");
    }
}

#[test]
fn the_choice_is_what_is_probably_fastest() {
    let stock = choosing_from(nboom_routines::all().iter().copied());
    let reversed = choosing_from(nboom_routines::all().iter().rev().copied());
    for (inner, chosen) in [
        ("M", Some("M")),
        ("S2_S1", Some("S2_S1")),
        ("S4", Some("4xS4")),
        ("4xS4", Some("4xS4")),
        ("3xS5_S4", Some("4xS5")),
        ("3xS1", Some("4xS1")),
        ("S3_S1", Some("4xS3")),
        ("2xS2", Some("2xS2")),
        ("7xS1", None),
        ("20xS2", Some("20xS5")),
        ("20xS1", Some("20xS5")),
        ("S45", None),
        ("S50", Some("S100")),
        ("2xP", None),
        ("S3_P", None),
    ] {
        let topology: Topology = inner.parse().expect("a topology");
        let numbers = (0..Layout::parameters(&topology)).map(|i| 1.0 + i as f64);
        let parameters = Parameters::read(&topology, numbers);
        let links = (0..topology.hinges()).collect();
        let recognised = Recognised { topology, parameters, links, frames: Vec::new() };
        for options in [&stock, &reversed] {
            let found =
                Repertoire::new(options).best(&recognised, true).map(|fit| fit.kernel.topology);
            assert_eq!(found, chosen, "{inner}");
        }
    }
}

#[test]
fn only_articulated_is_embedded() {
    let topology: Topology = "S1_P".parse().expect("a topology");
    let numbers = (0..Layout::parameters(&topology)).map(|i| 1.0 + i as f64);
    let parameters = Parameters::read(&topology, numbers);
    let recognised = Recognised { topology, parameters, links: vec![0, 1, 2], frames: Vec::new() };
    for &kernel in nboom_routines::all().iter().filter(|kernel| kernel.topology == "S2_P") {
        let found = Repertoire::new(&choosing_from([kernel].into_iter())).best(&recognised, true);
        let may = kernel.formulation == "articulated" && kernel.assumptions.is_empty();
        assert_eq!(found.is_some(), may, "{}", kernel.formulation);
    }
}
