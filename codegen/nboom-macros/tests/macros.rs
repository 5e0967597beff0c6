//! What the macros expand to, compiled and run: routines against the closed form, a scene against
//! the recursion.

use nboom::dynamics::Recursive;
use nboom::formulation::{
    Coordinates, Forces, Formulation, HingeCoordinates, Motion, Parameters, Recognised,
    inverse_dynamics, recognise, right_side,
};
use nboom::model::{HingeState, Mode, Scene, SectionShape, Structure, Topology, WeldedTree};
use nboom::scalar::{Kernel, Routine, Vec3, Wrench};
use nboom::sim::{Event, EventKind, InstantMotion, Options, Path, Recorder, Snapshot, simulate};
use nboom::strength::{Settings, StressAnalysis, Worst};

nboom::routine! { pub Satellite: S2_P }
nboom::routine! {
    /// In a different order, with every option.
    #[derive(Debug, Default, PartialEq)]
    Forced: P_S2, equations, external, level = exact, formulation = symmetric,
    assumptions = principal,
}
nboom::routine! { RightSide: S2_P, right_side }
nboom::routine! { Inverse: S2_P, inverse_dynamics }
nboom::routine! { ByName: "2xS1", level = exact }
nboom::routine! { OneToken: 4xS1_P }

/// Satellite S2_P of the report, with a deployment to run.
const SAMPLE: nboom::CompiledScene = nboom::scene!("../../examples/n-boom-1970.nml");

/// One without stations.
const PLAIN: nboom::CompiledScene = nboom::scene!("../../benches/scenes/T1.nml");

/// A scene in TOML, with parameters and a repetition.
const WING: nboom::CompiledScene = nboom::scene!("../../examples/wing.toml");

fn sample() -> Scene {
    SAMPLE.scene().expect("it was read when this was compiled")
}

/// Its numbers with all hinges free.
fn parameters() -> Parameters<f64> {
    let scene = sample();
    let hinges = scene.bodies.len();
    let mode = Mode { hinges: vec![HingeState::Free; hinges], ..Mode::at_start(&scene) };
    let tree = WeldedTree::new(&scene, &mode, &vec![0.0; hinges]);
    recognise(&tree).expect("a chain and a paddle").parameters
}

fn state() -> Coordinates<f64> {
    let hinge = |i: usize| HingeCoordinates {
        beta: 0.4 * i as f64 - 0.7,
        tau: 0.3 - 0.2 * i as f64,
        torque: 1.1 * i as f64,
    };
    Coordinates {
        omega: Vec3::new(0.9, -0.2, 0.1),
        external: Wrench::zero(),
        hinges: (0..4).map(hinge).collect(),
    }
}

fn outputs<T: Routine>() -> Vec<f64> {
    let topology: Topology = T::TOPOLOGY.parse().expect("routines have topologies");
    let kernel = Kernel::of::<T>();
    let parameters = parameters().write();
    assert!(kernel.accepts(&parameters));
    let (mut constants, mut out) = (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
    kernel.prepare(&parameters, &mut constants);
    kernel.evaluate(&constants, &state().write(&topology), &mut out);
    out
}

fn agree(found: &[f64], expected: &[f64]) {
    let scale = expected.iter().fold(0.0_f64, |largest, e| largest.max(e.abs()));
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12 * scale, "{found} {expected}");
    }
}

#[test]
fn a_routine_gives_the_closed_forms_accelerations() {
    let topology: Topology = "S2_P".parse().expect("a topology");
    let expected = Formulation::Articulated.solve(&topology, &parameters(), &state());
    agree(&outputs::<Satellite>(), &expected.write(&topology));
    assert!(!Satellite::EXTERNAL && Satellite::ASSUMPTIONS.is_empty());
}

#[test]
fn a_routine_for_equations_gives_the_formulations_matrix() {
    let topology: Topology = "S2_P".parse().expect("a topology");
    let expected = Formulation::Symmetric.equations(&topology, &parameters(), &state());
    let expected = expected.expect("it solves a system");
    agree(&outputs::<Forced>(), &[expected.matrix, expected.forcing].concat());
    assert!(Forced::EXTERNAL && !Forced::ASSUMPTIONS.is_empty());
}

#[test]
fn a_routine_for_inverse_dynamics_undoes_one_for_accelerations() {
    let topology: Topology = "S2_P".parse().expect("a topology");
    let kernel = Kernel::of::<Inverse>();
    let state = state();
    let mut motion = Motion::read(&topology, &state.write(&topology));
    let found = Formulation::Articulated.solve(&topology, &parameters(), &state);
    motion.main = found.main;
    for (hinge, tau_dot) in motion.hinges.iter_mut().zip(found.tau_dot) {
        hinge.tau_dot = tau_dot;
    }
    let expected = inverse_dynamics(&topology, &parameters(), &motion);
    for (torque, hinge) in expected.torques.iter().zip(&state.hinges) {
        // A few roundings of terms that are some hundred times as large.
        assert!((torque - hinge.torque).abs() < 1e-11, "{torque} {hinge:?}");
    }
    let found = evaluated(&kernel, &parameters().write(), &motion.write(&topology));
    agree(&found, &expected.write(&topology));
}

/// Parameters of a right side for the sample with all hinges free, and what it gives at some
/// variables; kick-off springs push or have let go.
fn sample_in_motion(pushed: bool) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let scene = sample();
    let hinges = scene.bodies.len();
    let start = Mode::at_start(&scene);
    let pieces = vec![usize::from(!pushed); start.pieces.len()];
    let mode = Mode { hinges: vec![HingeState::Free; hinges], pieces, ..start };
    let mut dynamics = Recursive::<f64>::new(&scene);
    dynamics.set_mode(&mode, &vec![0.0; hinges]);
    let recognised = recognise(dynamics.tree()).expect("a chain and a paddle");
    let forces = Forces::of(dynamics.elements(), dynamics.tree(), &recognised);
    let forces = forces.expect("no line has company");
    let Recognised { topology, parameters, .. } = &recognised;
    let y: Vec<f64> = (0..7 + 2 * hinges).map(|i| (0.9 * i as f64).sin()).collect();
    let expected = right_side(Formulation::Articulated, topology, parameters, &forces, &y);
    ([parameters.write(), forces.write()].concat(), y, expected)
}

fn evaluated(kernel: &Kernel, parameters: &[f64], y: &[f64]) -> Vec<f64> {
    let (mut constants, mut out) = (vec![0.0; kernel.constants], vec![0.0; kernel.outputs]);
    kernel.prepare(parameters, &mut constants);
    kernel.evaluate(&constants, y, &mut out);
    out
}

#[test]
fn a_routine_for_a_right_side_gives_the_rates_of_a_mode() {
    let kernel = Kernel::of::<RightSide>();
    let (parameters, y, expected) = sample_in_motion(false);
    assert!(kernel.accepts(&parameters));
    agree(&evaluated(&kernel, &parameters, &y), &expected);
    assert!(!kernel.accepts(&sample_in_motion(true).0), "lines push");
}

#[test]
fn a_compiled_scene_has_right_sides_of_its_modes() {
    for (pushed, count) in [(false, 5), (true, 2)] {
        let (parameters, y, expected) = sample_in_motion(pushed);
        let right_sides = SAMPLE.kernels().iter().filter(|kernel| {
            (kernel.result, kernel.topology) == ("right_side", "S2_P")
                && kernel.accepts(&parameters)
        });
        assert_eq!(right_sides.clone().count(), count, "lines push: {pushed}");
        for kernel in right_sides {
            agree(&evaluated(kernel, &parameters, &y), &expected);
        }
    }
}

#[test]
fn topologies_are_names_numbers_or_strings() {
    assert_eq!(
        (Forced::TOPOLOGY, ByName::TOPOLOGY, OneToken::TOPOLOGY),
        ("S2_P", "2xS1", "4xS1_P")
    );
}

#[test]
fn a_compiled_scene_in_toml_is_the_scene_of_the_file() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/wing.toml");
    let file = nboom::io::read_scene(&path).expect("an example");
    let scene = WING.scene().expect("it was read when this was compiled");
    assert_eq!(scene, file.scene);
    assert_eq!((WING.name(), scene.name_of(5)), ("wing", Some("outer panel 2")));
    assert!(!WING.text().contains('$'), "the program has no parameters to look up");
}

/// Times of lock-ups, and the last rates.
#[derive(Default)]
struct Latches(Vec<f64>);

impl Recorder for Latches {
    fn event(&mut self, event: &Event, _: &Snapshot) -> std::io::Result<()> {
        self.0.extend(Some(event.time).filter(|_| event.kind == EventKind::LockUp));
        Ok(())
    }
}

#[test]
fn a_compiled_scene_runs_in_its_own_code_alone() {
    for (compiled, locks) in [(SAMPLE, 4), (WING, 6)] {
        let scene = compiled.scene().expect("it was read when this was compiled");
        let latches = |path, kernels| {
            let mut latches = Latches::default();
            let options = Options { path, kernels, ..Options::default() };
            simulate(&scene, &options, &mut latches).expect("an example runs");
            latches.0
        };
        let (generated, recursion) =
            (latches(Path::Generated, compiled.kernels()), latches(Path::Generic, &[]));
        assert_eq!((generated.len(), recursion.len()), (locks, locks));
        for (generated, recursion) in generated.iter().zip(recursion) {
            assert!((generated - recursion).abs() < 1e-7 * recursion, "{generated} {recursion}");
        }
    }
}

#[test]
fn a_compiled_scene_has_its_numbers_built_in() {
    let numbers = parameters().write();
    let of = |result: &str| -> Vec<&Kernel> {
        let kernels = SAMPLE.kernels().iter();
        kernels.filter(|kernel| kernel.topology == "S2_P" && kernel.result == result).collect()
    };
    let (all_free, right_sides) = (of("accelerations"), of("right_side"));
    assert_eq!((all_free.len(), right_sides.len()), (3, 5));
    assert_eq!(all_free[0].assumptions.len(), numbers.len());
    assert!(all_free[0].assumptions.iter().all(|&(i, value)| numbers[i] == value));
    assert!(all_free[1].assumptions.len() < numbers.len() && all_free[1].accepts(&numbers));
    assert!(all_free[2].assumptions.is_empty() && all_free[2].external);
}

#[test]
fn a_compiled_scene_is_the_scene_of_the_file() {
    let path =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/n-boom-1970.nml");
    let file = nboom::io::read_scene(&path).expect("the sample deck is right");
    assert_eq!(sample(), file.scene);
    assert_eq!(SAMPLE.name(), "n-boom-1970");
    assert_eq!(SAMPLE.text(), std::fs::read_to_string(path).expect("it was read above"));
}

/// Largest von Mises stress of every station, all that a run makes.
struct Stressed(StressAnalysis);

impl Recorder for Stressed {
    fn needs_detail(&self) -> bool {
        true
    }
    fn needs_instants(&self) -> bool {
        true
    }
    fn sample(&mut self, snapshot: &Snapshot) -> std::io::Result<()> {
        let detail = snapshot.detail.as_ref().expect("it was asked for");
        self.0.motion(snapshot, detail).map_err(std::io::Error::other)
    }
    fn instant(&mut self, instant: &InstantMotion) -> std::io::Result<()> {
        self.0.instant(instant).map(drop).map_err(std::io::Error::other)
    }
}

#[test]
fn a_compiled_scene_finds_its_stresses_in_its_own_code() {
    let structure = SAMPLE.structure().expect("it was read").expect("the deck has stations");
    let worst = |kernels| -> Vec<f64> {
        let analysis = StressAnalysis::new(&sample(), &structure, Settings::default());
        let analysis = analysis.expect("sections are right").with_kernels(kernels);
        assert_eq!(analysis.generated_for().is_some(), !kernels.is_empty());
        let mut stressed = Stressed(analysis);
        let options = Options { samples: 50, ..Options::default() };
        simulate(&sample(), &options, &mut stressed).expect("the sample deck runs");
        let of_station = |worst: &Worst| worst.max_von_mises.stress.von_mises();
        stressed.0.envelope().iter().map(of_station).collect()
    };
    let (generated, library) = (worst(SAMPLE.kernels()), worst(&[]));
    assert_eq!(
        generated.len(),
        structure.segments().iter().map(|s| s.stations.len()).sum::<usize>()
    );
    for (generated, library) in generated.iter().zip(library) {
        // The same motion, and no more than rounding in some hundred operations.
        assert!((generated - library).abs() < 1e-12 * library, "{generated} {library}");
    }
}

#[test]
fn code_for_stresses_is_for_the_numbers_it_was_made_from() {
    let structure = SAMPLE.structure().expect("it was read").expect("the deck has stations");
    let runs_generated = |structure: &Structure| {
        let analysis = StressAnalysis::new(&sample(), structure, Settings::default());
        let analysis = analysis.expect("sections are right").with_kernels(SAMPLE.kernels());
        analysis.generated_for().is_some()
    };
    assert!(runs_generated(&structure));
    let mut segments = structure.segments().to_vec();
    let SectionShape::Tube { radius, .. } = &mut segments[0].stations[0].section else {
        panic!("the first section of the deck is a tube");
    };
    *radius *= 1.0 + 1e-15;
    let (other, _) =
        Structure::with_differing_slices(&sample(), segments).expect("the deck's slices");
    assert!(!runs_generated(&other));
}

#[test]
fn a_scene_without_stations_has_no_code_for_stresses() {
    assert!(PLAIN.structure().expect("it was read").is_none());
    assert!(PLAIN.kernels().iter().all(|kernel| kernel.result != "stresses"));
    let of_sample = SAMPLE.kernels().iter().filter(|kernel| kernel.result == "stresses");
    assert_eq!(of_sample.count(), 1);
}
