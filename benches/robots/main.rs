//! Nanoseconds for the accelerations of a robot: of one state, by code for this processor and by plain code, which
//! takes equal legs one after the other; of each of eight states at once; and with their derivatives by the
//! angles, rates and torques of all joints. One thread. `cargo run --release` here prints a line for each, as
//! `pinocchio.cpp` does.

use std::hint::black_box;
use std::time::{Duration, Instant};

use nboom_dynamics::Recursive;
use nboom_formulation::{Layout, recognise};
use nboom_io::read_scene;
use nboom_scalar::{Batch, Eight, InstructionSet, Kernel, Routine, jacobian};

/// States that are taken in turns.
const STATES: usize = 64;

/// How long each figure is measured.
const LONG: Duration = Duration::from_millis(800);

/// Samples are about as long.
const SAMPLE: Duration = Duration::from_micros(100);

macro_rules! robots {
    ($($robot:ident: $routine:ident,)*) => {
        $(mod $robot {
            include!(concat!(env!("OUT_DIR"), "/", stringify!($robot), ".rs"));
        })*

        fn main() {
            $(measure::<$robot::$routine>(stringify!($robot));)*
        }
    };
}

robots! {
    ur5: BakedTrrpprr,
    panda: BakedTrrrrrrrIsOIsO,
    anymal: Baked4xTrrp,
    go2: Baked4xTrrp,
}

fn measure<T: Routine>(robot: &str) {
    let path = format!("{}/../../tests/data/robots/{robot}.urdf", env!("CARGO_MANIFEST_DIR"));
    let scene = read_scene(path.as_ref()).expect("the robot is in the clone").scene;
    let recognised = recognise(Recursive::<f64>::new(&scene).tree()).expect("rigid bodies");
    let kernel = Kernel::of::<T>();
    let mut constants = vec![0.0; T::CONSTANTS];
    kernel.prepare(&recognised.parameters.write(), &mut constants);
    let number = |i: usize, j: usize| (1.7 * i as f64 + 0.9 * j as f64).sin() * 1.5;
    let state = |i: usize| (0..T::COORDINATES).map(|j| number(i, j)).collect::<Vec<f64>>();
    let states: Vec<Vec<f64>> = (0..STATES).map(state).collect();
    let mut found = vec![0.0; T::OUTPUTS];
    let plain = Kernel::with::<T>(InstructionSet::Portable).expect("every processor has it");
    for (what, kernel) in [("accelerations", kernel), ("accelerations_plain", plain)] {
        tell(
            what,
            robot,
            time(|i| {
                kernel.evaluate(&constants, black_box(&states[i]), black_box(&mut found));
            }),
        );
    }
    let (batch, spread) = (Batch::of::<T>(), |&number: &f64| Eight::splat(number));
    let of_eight: Vec<Eight> = constants.iter().map(spread).collect();
    let abreast: Vec<Vec<Eight>> = (0..STATES)
        .map(|i| {
            let number = |j: usize| Eight(std::array::from_fn(|k| states[(i + k) % STATES][j]));
            (0..T::COORDINATES).map(number).collect()
        })
        .collect();
    let mut all = vec![Eight::default(); T::OUTPUTS];
    let times = time(|i| {
        batch.evaluate(&of_eight, black_box(&abreast[i]), black_box(&mut all));
    });
    tell("accelerations_of_eight", robot, times.map(|ns| ns / 8.0));
    let by = Layout::STATE..T::COORDINATES;
    let mut derivatives = vec![0.0; T::OUTPUTS * by.len()];
    tell(
        "derivatives",
        robot,
        time(|i| {
            let x = black_box(&states[i]);
            jacobian::<T>(&constants, x, by.clone(), &mut found, black_box(&mut derivatives));
        }),
    );
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
