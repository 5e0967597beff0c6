//! Nanoseconds for the accelerations of one state against the number of free hinges: hinges of
//! three satellites of `benches/scenes` are held one after the other, from the tips inward and
//! from the roots outward.
//!
//! `cargo bench --bench free_hinges` prints a line for each number of free hinges: the topology
//! that is left, the recursion in that mode, and the generated routine that a run would take (its
//! topology, what it assumes, how many of its links are virtual), or `-` where it would find
//! none. The last column is what holding has cost: the time of the code that a run would take over
//! the shortest such time with more hinges free. The last lines tell the largest ratio of each code,
//! and the exit code is 1 where one is above what README.md says.

use std::hint::black_box;
use std::path::Path;
use std::process::ExitCode;

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::{Layout, assumptions_in_a_word, recognise};
use nboom::model::{HingeState, Mode, Scene};
use nboom::sim::{Fit, Options, Repertoire};
use timing::{STATES, numbers, state, time};

#[path = "timing/mod.rs"]
mod timing;

/// What README.md says: a held hinge makes the code that a run takes slower by a sixth at most, on
/// any processor.
const MOST_OF_RUN: f64 = 7.0 / 6.0;

/// The recursion never becomes slower; the rest is what a measurement is good to.
const MOST_OF_RECURSION: f64 = 1.05;

/// How often a reading above these is taken again: what disturbs one only ever makes it longer.
const REPEATS: usize = 3;

fn main() -> ExitCode {
    println!(
        "scene order free topology recursion_ns routine assumed virtual routine_ns of_more_free"
    );
    let mut worst = Worst::default();
    for (name, orders) in [
        ("T1", &[Order::TipsFirst, Order::RootsFirst][..]),
        ("T2", &[Order::TipsFirst, Order::RootsFirst]),
        ("T4", &[Order::TipsFirst]),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("benches/scenes/{name}.nml"));
        let scene = nboom::io::read_scene(&path).expect("the scene is in the clone").scene;
        for &order in orders {
            worst.add(table(name, &scene, order));
        }
    }
    let Worst { of_run, of_recursion } = worst;
    println!("largest ratio of what a run takes: {of_run:.3}, at most {MOST_OF_RUN:.3} claimed");
    println!(
        "largest ratio of the recursion: {of_recursion:.3}, at most {MOST_OF_RECURSION} claimed"
    );
    if worst.is_as_claimed() {
        ExitCode::SUCCESS
    } else {
        println!("README.md claims too much");
        ExitCode::FAILURE
    }
}

/// The largest ratio of a time to the shortest one with more hinges free.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    of_run: f64,
    of_recursion: f64,
}

impl Worst {
    fn add(&mut self, other: Self) {
        self.of_run = self.of_run.max(other.of_run);
        self.of_recursion = self.of_recursion.max(other.of_recursion);
    }

    fn is_as_claimed(&self) -> bool {
        self.of_run <= MOST_OF_RUN && self.of_recursion <= MOST_OF_RECURSION
    }
}

/// Which hinges are held first.
#[derive(Clone, Copy, Debug)]
enum Order {
    /// The outermost of each appendage in turn, as booms do that lock from their tips.
    TipsFirst,
    /// Those at the main body, as booms do that are released from their tips.
    RootsFirst,
}

impl Order {
    fn hinges(self, scene: &Scene) -> Vec<usize> {
        let mut depths = vec![0; scene.bodies.len()];
        for (i, body) in scene.bodies.iter().enumerate() {
            depths[i] = body.inboard.map_or(0, |inboard| depths[inboard] + 1);
        }
        let mut hinges: Vec<usize> = (0..depths.len()).collect();
        hinges.sort_by_key(|&i| depths[i]);
        if matches!(self, Self::TipsFirst) {
            hinges.reverse();
        }
        hinges
    }
}

fn table(name: &str, scene: &Scene, order: Order) -> Worst {
    let hinges = scene.bodies.len();
    let mut mode = Mode { hinges: vec![HingeState::Free; hinges], ..Mode::at_start(scene) };
    let mut dynamics = Recursive::<f64>::new(scene);
    let beta: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
    let order_of_holding = order.hinges(scene);
    let options = Options {
        kernels: nboom_routines::for_runs(),
        batches: nboom_routines::right_sides_of_eight(),
        ..Options::default()
    };
    let mut repertoire = Repertoire::new(&options);
    let (mut worst, mut shortest) = (Worst::default(), [f64::INFINITY; 2]);
    for held in 0..=hinges {
        if held > 0 {
            mode.hinges[order_of_holding[held - 1]] = HingeState::Locked;
        }
        dynamics.set_mode(&mode, &beta);
        let free = hinges - held;
        let (topology, routine) = recognise(dynamics.tree()).map_or_else(
            |_| ("no_chains".to_owned(), None),
            |found| (found.topology.to_string(), repertoire.best(&found, false)),
        );
        let mut read = || {
            let recursion = recursion(&mut dynamics, free);
            [routine.as_ref().map_or(recursion, timed), recursion]
        };
        let mut times = read();
        for _ in 0..REPEATS {
            if ratios(times, shortest).is_as_claimed() {
                break;
            }
            let again = read();
            times = [0, 1].map(|code| times[code].min(again[code]));
        }
        let ratios = ratios(times, shortest);
        shortest = [0, 1].map(|code| times[code].min(shortest[code]));
        worst.add(ratios);
        let [of_run, recursion] = times;
        let routine = routine.map_or_else(
            || "- - - -".to_owned(),
            |fit| format!("{} {of_run:.1}", description(&fit)),
        );
        println!(
            "{name} {order:?} {free} {topology} {recursion:.1} {routine} {:.3}",
            ratios.of_run
        );
    }
    worst
}

fn ratios(times: [f64; 2], shortest: [f64; 2]) -> Worst {
    let [of_run, of_recursion] = [0, 1].map(|code| times[code] / shortest[code]);
    Worst { of_run, of_recursion }
}

/// The routine's topology, what it assumes and its virtual links.
fn description(fit: &Fit) -> String {
    let assumed = assumptions_in_a_word(&fit.kernel);
    format!("{} {assumed} {}", fit.kernel.topology, fit.embedding.virtual_links())
}

fn timed(fit: &Fit) -> f64 {
    let kernel = &fit.kernel;
    let constants = fit.constants();
    let mut coordinates: Vec<Vec<f64>> = vec![vec![0.0; kernel.coordinates]; STATES];
    for (i, state) in coordinates.iter_mut().enumerate() {
        let any = numbers(i, kernel.coordinates);
        let of_hinges = fit.hinges().flat_map(|(in_state, _)| in_state);
        for at in (0..Layout::STATE).chain(of_hinges) {
            state[at] = any[at];
        }
    }
    let mut out = vec![0.0; kernel.outputs];
    time(|i| {
        kernel.evaluate(black_box(&constants), black_box(&coordinates[i]), black_box(&mut out));
    })
    .0
}

fn recursion(dynamics: &mut Recursive<f64>, free: usize) -> f64 {
    let states: Vec<_> = (0..STATES).map(|i| state(i, free)).collect();
    let mut found = Accelerations::for_hinges(free);
    time(|i| {
        let motion =
            Motion { omega_body: states[i].omega, beta: &states[i].beta, tau: &states[i].tau };
        dynamics.accelerations(black_box(&motion), black_box(&mut found));
    })
    .0
}
