//! Code for main bodies that are held, in loops, part by part, joint by joint and as a straight line, compiled and
//! run: against the closed form for free ones, whose main body is so heavy that only the wrench that holds it moves
//! it, and against the recursion.

use nboom::formulation::{
    Coordinates, Forces, Formulation, Layout, Parameters, RightSideLayout, right_side,
};
use nboom::model::Topology;
use nboom::scalar::{Kernel, Routine};
use nboom::sim::{Method, Options, Path, Recorder, Snapshot, Summary, simulate};

nboom::routine! { Loops: 4xS2_P_2xTrr, external, held }
nboom::routine! { Line: Trr, held, external, level = exact }
nboom::routine! { Joints: 2xTrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr, held, external }
nboom::routine! { Torso: "Trrr(rrsrprr)(rrsrprr)(pr)", held, external }
nboom::routine! { AtRest: 4xS2_P_2xTrr, held }
nboom::routine! { InMode: 4xS2_P_2xTrr, right_side, held, external }

/// Four booms, a paddle and two canted booms on a rig that turns and moves.
const RIG: nboom::CompiledScene = nboom::scene!("tests/scenes/rig.toml");

/// Numbers of order one. Those of links are no bodies', but like theirs in what a hinge needs: large moments of
/// inertia, small products.
fn parameters(topology: &Topology) -> Vec<f64> {
    let mut parameters = Layout::held_main();
    let of = |i: usize| 0.2 * (1.3 * i as f64).sin();
    parameters.extend((Layout::MAIN..Layout::parameters(topology)).map(of));
    let satellite = Parameters::read(topology, parameters.iter().copied());
    let mut satellite = Parameters { main_is_held: true, ..satellite };
    for link in satellite.branches.iter_mut().flat_map(|branch| &mut branch.links) {
        let inertia = &mut link.inertia;
        inertia.mass += 2.0;
        let moments = &mut inertia.about_origin;
        for moment in [&mut moments.xx, &mut moments.yy, &mut moments.zz] {
            *moment += 3.0;
        }
    }
    satellite.write()
}

/// The wrench that holds the main body so that it accelerates like this.
const HELD_AT: [f64; 6] = [0.3, -0.2, 0.5, 1.0, -2.0, 9.8];

fn holding() -> [f64; 6] {
    HELD_AT.map(|acceleration| acceleration * Layout::held_main()[0])
}

/// A state in which the wrench holds the main body.
fn state(topology: &Topology) -> Vec<f64> {
    let mut state: Vec<f64> =
        (0..Layout::coordinates(topology)).map(|i| (0.7 * i as f64).cos()).collect();
    state[3..9].copy_from_slice(&holding());
    state
}

fn evaluated(kernel: &Kernel, parameters: &[f64], x: &[f64]) -> Vec<f64> {
    assert!(kernel.accepts(parameters));
    let (mut constants, mut out) = (vec![0.0; kernel.constants], vec![f64::NAN; kernel.outputs]);
    kernel.prepare(parameters, &mut constants);
    kernel.evaluate(&constants, x, &mut out);
    out
}

fn agree(found: &[f64], expected: &[f64]) {
    let scale = expected.iter().fold(0.0_f64, |largest, e| largest.max(e.abs()));
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12 * scale, "{found} {expected}");
    }
}

/// Accelerations by the closed form that solves for those of the main body, too.
fn of_a_heavy_one(topology: &Topology, state: &[f64]) -> Vec<f64> {
    let heavy = Parameters::read(topology, parameters(topology));
    let coordinates = Coordinates::read(topology, state);
    Formulation::Articulated.solve(topology, &heavy, &coordinates).write(topology)
}

fn accelerates_as_a_heavy_one<T: Routine>() {
    let topology: Topology = T::TOPOLOGY.parse().expect("routines have topologies");
    let state = state(&topology);
    let found = evaluated(&Kernel::of::<T>(), &parameters(&topology), &state);
    agree(&found, &of_a_heavy_one(&topology, &state));
    assert_eq!(found[..6], HELD_AT, "the wrench over a power of two");
}

#[test]
fn hinges_accelerate_as_on_a_main_body_that_nothing_moves() {
    accelerates_as_a_heavy_one::<Loops>();
    accelerates_as_a_heavy_one::<Joints>();
    accelerates_as_a_heavy_one::<Torso>();
    accelerates_as_a_heavy_one::<Line>();
}

#[test]
fn a_main_body_that_nothing_holds_stays() {
    let topology: Topology = AtRest::TOPOLOGY.parse().expect("routines have topologies");
    let mut state = state(&topology);
    state[3..9].fill(0.0);
    let found = evaluated(&Kernel::of::<AtRest>(), &parameters(&topology), &state);
    agree(&found, &of_a_heavy_one(&topology, &state));
    assert_eq!(found[..6], [0.0; 6]);
}

#[test]
fn a_right_side_takes_what_holds_the_main_body_as_a_parameter() {
    let topology: Topology = InMode::TOPOLOGY.parse().expect("routines have topologies");
    let mut forces = Forces::<f64>::none(topology.hinges());
    let [x, y, z, u, v, w] = holding();
    forces.external.moment = nboom::scalar::Vec3::new(x, y, z);
    forces.external.force = nboom::scalar::Vec3::new(u, v, w);
    let of_satellite = parameters(&topology);
    let all = [&of_satellite[..], &forces.write()].concat();
    let y: Vec<f64> =
        (0..RightSideLayout::coordinates(&topology)).map(|i| (0.9 * i as f64).sin()).collect();
    let heavy = Parameters::read(&topology, of_satellite);
    forces.lines.clear();
    let expected = right_side(Formulation::Articulated, &topology, &heavy, &forces, &y);
    let found = evaluated(&Kernel::of::<InMode>(), &all, &y);
    agree(&found, &expected);
    assert_eq!(found[RightSideLayout::OMEGA], HELD_AT[..3]);
}

#[test]
fn other_main_bodies_are_refused() {
    let topology: Topology = Line::TOPOLOGY.parse().expect("routines have topologies");
    let mut parameters = parameters(&topology);
    parameters[0] = 1e6;
    assert!(!Kernel::of::<Line>().accepts(&parameters));
}

/// Angles and rates at all output times.
#[derive(Default)]
struct Hinges(Vec<f64>);

impl Recorder for Hinges {
    fn sample(&mut self, snapshot: &Snapshot) -> std::io::Result<()> {
        self.0.extend(&snapshot.beta);
        self.0.extend(&snapshot.tau);
        Ok(())
    }
}

fn run(options: &Options) -> (Vec<f64>, Summary) {
    let scene = RIG.scene().expect("it was read when this was compiled");
    let mut hinges = Hinges::default();
    let summary = simulate(&scene, options, &mut hinges).expect("the rig runs");
    (hinges.0, summary)
}

#[test]
fn a_compiled_rig_runs_as_by_the_recursion() {
    assert!(
        RIG.kernels()
            .iter()
            .all(|kernel| kernel.assumptions.contains(&(0, Layout::held_main()[0])))
    );
    for integrator in [Method::Dop853, Method::GaussLanes] {
        let options = Options { integrator, rtol: 1e-12, samples: 20, ..Options::default() };
        let (expected, _) = run(&Options { path: Path::Generic, ..options });
        let (path, kernels) = (Path::Generated, RIG.kernels());
        let (found, summary) = run(&Options { path, kernels, ..options });
        assert!(summary.conservation.energy < 1e-10, "{:?}", summary.conservation);
        assert_eq!(summary.code().generated_share, 1.0);
        for (found, expected) in found.iter().zip(&expected) {
            // Both take the same steps and differ by rounding.
            assert!((found - expected).abs() < 1e-11, "{found} {expected}");
        }
    }
}
