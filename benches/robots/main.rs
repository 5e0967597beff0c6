//! Nanoseconds for the accelerations of a robot, its numbers built in: of one state, by code for this processor and
//! by plain code, which takes equal legs and arms one after the other; of each of eight states at once; and of four robots
//! with their derivatives by the angles, rates and torques of all joints. One thread. `./run` prints a line for each, as
//! `pinocchio.cpp` does.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// States that are taken in turns.
const STATES: usize = 64;

/// How long each figure is measured.
const LONG: Duration = Duration::from_millis(800);

/// Samples are about as long.
const SAMPLE: Duration = Duration::from_micros(100);

/// Numbers of a state before the joints: ω, moment, force.
const BEFORE_JOINTS: usize = 9;

fn main() {
    ur5();
    panda();
    anymal();
    go2();
    g1();
    talos();
    humanoid();
}

/// A function for each robot: its crate has types of its own.
macro_rules! robots {
    ($($robot:ident: $routine:ident $(, $by_dual_numbers:ident)?;)*) => {$(
        fn $robot() {
            use ::$robot::nboom_scalar::{Batch, Eight, InstructionSet, Kernel};
            use ::$robot::{$routine as Robot, Routine, parameters};

            let mut constants = vec![0.0; Robot::CONSTANTS];
            Robot::prepare(parameters(), &mut constants);
            let states = states(Robot::COORDINATES);
            let mut found = vec![0.0; Robot::OUTPUTS];
            for (what, instructions) in [
                ("accelerations", InstructionSet::of_this_processor()),
                ("accelerations_plain", InstructionSet::Portable),
            ] {
                let kernel = Kernel::with::<Robot>(instructions).expect("the processor has it");
                let call = |i: usize| {
                    kernel.evaluate(&constants, black_box(&states[i]), black_box(&mut found));
                };
                tell(what, stringify!($robot), time(call));
            }

            let batch = Batch::of::<Robot>();
            let of_eight: Vec<Eight> = constants.iter().map(|&k| Eight::splat(k)).collect();
            let abreast = |i: usize| -> Vec<Eight> {
                let number = |j: usize| {
                    Eight(std::array::from_fn(|lane| states[(i + lane) % STATES][j]))
                };
                (0..Robot::COORDINATES).map(number).collect()
            };
            let abreast: Vec<Vec<Eight>> = (0..STATES).map(abreast).collect();
            let mut all = vec![Eight::default(); Robot::OUTPUTS];
            let times = time(|i| {
                batch.evaluate(&of_eight, black_box(&abreast[i]), black_box(&mut all));
            });
            tell("accelerations_of_eight", stringify!($robot), times.map(|ns| ns / 8.0));

            let by = BEFORE_JOINTS..Robot::COORDINATES;
            let mut derivatives = vec![0.0; Robot::OUTPUTS * by.len()];
            let kernel = Kernel::of::<Robot>();
            let mut tree = ::$robot::derivatives(parameters());
            let call = |i: usize| {
                kernel.evaluate(&constants, black_box(&states[i]), &mut found);
                tree.write(&states[i], &found, by.clone(), black_box(&mut derivatives));
            };
            tell("derivatives", stringify!($robot), time(call));

            $(
                let call = |i: usize| {
                    let (x, to) = (black_box(&states[i]), black_box(&mut derivatives));
                    ::$robot::nboom_scalar::jacobian::<Robot>(&constants, x, by.clone(), &mut found, to);
                };
                tell(stringify!($by_dual_numbers), stringify!($robot), time(call));
            )?
        }
    )*};
}

// The compiler was stopped after four minutes with the derivatives of a humanoid.
robots! {
    ur5: BakedTrrpprr, derivatives_by_dual_numbers;
    panda: BakedTrrrrrrrIsOIsO, derivatives_by_dual_numbers;
    anymal: Baked4xTrrp, derivatives_by_dual_numbers;
    go2: Baked4xTrrp, derivatives_by_dual_numbers;
    g1: BakedTrrrIrrrrrrrOIrrrrrrrO2xTrrrrpr;
    talos: BakedTrrIrrrrrrrrOIrrrrrrrrOIprO2xTrrrppr;
    humanoid: BakedTrrrIrrrrrrrOIrrrrrrrO2xTrrrrpr;
}

fn states(size: usize) -> Vec<Vec<f64>> {
    let number = |i: usize, j: usize| (1.7 * i as f64 + 0.9 * j as f64).sin() * 1.5;
    (0..STATES).map(|i| (0..size).map(|j| number(i, j)).collect()).collect()
}

/// The shortest and the middle sample, for one call each.
fn time(mut call: impl FnMut(usize)) -> [f64; 2] {
    let mut sample = |count: usize| {
        let start = Instant::now();
        (0..count).for_each(|i| call(i % STATES));
        start.elapsed()
    };
    let mut count = STATES;
    while sample(count) < SAMPLE {
        count *= 2;
    }
    let (start, mut samples) = (Instant::now(), Vec::new());
    while start.elapsed() < LONG {
        samples.push(sample(count).as_nanos() as f64 / count as f64);
    }
    samples.sort_by(f64::total_cmp);
    [samples[0], samples[samples.len() / 2]]
}

fn tell(what: &str, robot: &str, [shortest, middle]: [f64; 2]) {
    println!("nboom_{what} {robot} ns_min {shortest:.1} ns_median {middle:.1}");
}
