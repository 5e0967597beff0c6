//! Accelerations by a routine that the build script has generated.
//!
//! ```sh
//! cargo run --release --manifest-path examples/build-script/Cargo.toml
//! ```
//!
//! The routine `Satellite` is made for a topology, a boom of two segments and a paddle; what the
//! segments weigh is said at run time. It runs on one state, and on eight at once. Both are
//! compared with the recursion over any tree, which shares no equation with it; the program ends
//! with an error if they differ.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::{Coordinates, HingeCoordinates, Recognised, Solution, recognise};
use nboom::model::{Appendage, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment};
use nboom::scalar::{Batch, Eight, Kernel, Sym3, Twist, Vec3, Wrench};

mod routines {
    include!(concat!(env!("OUT_DIR"), "/routines.rs"));
}

/// The largest difference that rounding explains, relative to the largest acceleration.
const TOLERANCE: f64 = 1e-12;

fn main() -> Result<(), String> {
    let mut recursion = Recursive::new(&satellite());
    let Recognised { topology, parameters, links, .. } =
        recognise(recursion.tree()).map_err(|_| "a chain and a paddle expected")?;
    let parameters = parameters.write();
    let states: Vec<State> = (0..8).map(State::new).collect();
    let inputs: Vec<Vec<f64>> =
        states.iter().map(|state| state.coordinates(&links).write(&topology)).collect();

    let one = one_by_one(&parameters, &inputs);
    let eight = eight_at_once(&parameters, &inputs);

    println!("state   ω̇ x         ω̇ y         ω̇ z");
    for (i, state) in states.iter().enumerate() {
        let expected = state.accelerations(&mut recursion, &links).write(&topology);
        println!("{i}     {:11.6} {:11.6} {:11.6}", one[i][0], one[i][1], one[i][2]);
        check(&one[i], &expected, "one state")?;
        check(&eight[i], &expected, "eight states")?;
    }
    println!("generated code and the recursion agree");
    Ok(())
}

/// A hub with a boom on one side and a paddle on the other; hinges turn freely.
fn satellite() -> Scene {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let segment = |mass: f64| Segment {
        length: 2.0,
        mass_properties: MassProperties::new(
            mass,
            Vec3::new(0.0, 1.0, 0.1),
            Sym3::diagonal(1.5, 0.2, 1.5) * mass,
        ),
        hinge: Hinge::free(),
    };
    let mut description = SceneDescription::at_rest("a boom and a paddle", hub, 1.0);
    description.attach(&Appendage::Regular {
        mount: Mount::at(Vec3::new(0.0, 0.5, 0.1)),
        segments: vec![segment(3.0), segment(2.0)],
    });
    description.attach(&Appendage::Paddle {
        mount: Mount::at(Vec3::new(0.2, 0.0, -0.5)),
        arm: segment(1.0),
        paddle: segment(4.0),
    });
    Scene::new(description).expect("the bodies are physical")
}

/// Rates of the hub, angles and rates of the four hinges.
struct State {
    omega: Vec3<f64>,
    beta: [f64; 4],
    tau: [f64; 4],
}

impl State {
    fn new(number: usize) -> Self {
        let wave = |i: usize| (1.3 * i as f64 + 0.7 * number as f64).sin();
        Self {
            omega: Vec3::new(wave(1), wave(2), wave(3)),
            beta: [4, 5, 6, 7].map(|i| 3.0 * wave(i)),
            tau: [8, 9, 10, 11].map(wave),
        }
    }

    /// What the routine takes, its hinges in the order of `links`.
    fn coordinates(&self, links: &[usize]) -> Coordinates<f64> {
        let hinge = |&link: &usize| HingeCoordinates {
            beta: self.beta[link],
            tau: self.tau[link],
            torque: 0.0,
        };
        let hinges = links.iter().map(hinge).collect();
        Coordinates { omega: self.omega, external: Wrench::zero(), hinges }
    }

    /// What the recursion finds, hinges in the order of `links`.
    fn accelerations(&self, recursion: &mut Recursive<f64>, links: &[usize]) -> Solution<f64> {
        let mut found = Accelerations::for_hinges(self.beta.len());
        let motion = Motion { omega_body: self.omega, beta: &self.beta, tau: &self.tau };
        recursion.accelerations(&motion, &mut found);
        Solution {
            main: Twist { angular: found.omega_dot_body, linear: found.origin_body },
            tau_dot: links.iter().map(|&link| found.tau_dot[link]).collect(),
        }
    }
}

fn one_by_one(parameters: &[f64], states: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let kernel = Kernel::of::<routines::Satellite>();
    println!("topology {}, {} code", kernel.topology, kernel.instructions);
    let mut constants = vec![0.0; kernel.constants];
    kernel.prepare(parameters, &mut constants);
    let accelerations = |state: &Vec<f64>| {
        let mut found = vec![0.0; kernel.outputs];
        kernel.evaluate(&constants, state, &mut found);
        found
    };
    states.iter().map(accelerations).collect()
}

fn eight_at_once(parameters: &[f64], states: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let batch = Batch::of::<routines::Satellite>();
    let parameters: Vec<Eight> = parameters.iter().map(|&value| Eight::splat(value)).collect();
    let mut constants = vec![Eight::default(); batch.constants];
    batch.prepare(&parameters, &mut constants);
    let side_by_side = |i: usize| Eight(std::array::from_fn(|state| states[state][i]));
    let coordinates: Vec<Eight> = (0..batch.coordinates).map(side_by_side).collect();
    let mut found = vec![Eight::default(); batch.outputs];
    batch.evaluate(&constants, &coordinates, &mut found);
    (0..8).map(|state| found.iter().map(|number| number.0[state]).collect()).collect()
}

fn check(found: &[f64], expected: &[f64], what: &str) -> Result<(), String> {
    let largest = expected.iter().fold(0.0_f64, |largest, e| largest.max(e.abs()));
    let near = |(f, e): (&f64, &f64)| (f - e).abs() <= TOLERANCE * largest;
    let agree = found.len() == expected.len() && found.iter().zip(expected).all(near);
    if agree { Ok(()) } else { Err(format!("{what}: {found:?} found, {expected:?} expected")) }
}
