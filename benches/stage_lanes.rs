//! Whole runs of T1_smooth by `gauss_lanes` and `dop853`, taking turns, with the generated routine that a
//! run would take and its form for eight states at once.
//!
//! `cargo bench --bench stage_lanes` prints a line for each tolerance and method: microseconds (shortest and
//! median), error at the end and largest error at 200 times between, both relative to what a variable
//! reaches, steps, refused steps, and states evaluated. `_dense` prepares dense output for every
//! step, as runs with guards do.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use nboom::dynamics::{Motion, Recursive};
use nboom::formulation::recognise;
use nboom::model::{HingeState, Mode, Scene};
use nboom::ode::{Counts, GaussLanes, RungeKutta, Stepper, System, Tolerance};
use nboom::scalar::{Batch, Eight, Kernel, Vec3};
use nboom::sim::{Options, Repertoire};

/// Four free hinges on a main body: attitude, ω, β, τ.
const HINGES: usize = 4;
const ATTITUDE: usize = 4;
const OMEGA: usize = 4;
const BETA: usize = 7;
const TAU: usize = BETA + HINGES;
const SIZE: usize = TAU + HINGES;

struct Satellite {
    kernel: Kernel,
    batch: Batch,
    constants: Vec<f64>,
    batch_constants: Vec<Eight>,
    coordinates: Vec<f64>,
    batch_coordinates: Vec<Eight>,
    outputs: Vec<f64>,
    batch_outputs: Vec<Eight>,
    /// For each hinge, places of β, τ and torque in the coordinates and of τ̇ in the outputs.
    places: Vec<([usize; 3], usize)>,
    /// Torque of each hinge at rest, per angle and per rate.
    torques: [[f64; 3]; HINGES],
    has_lanes: bool,
}

impl Satellite {
    fn new(scene: &Scene) -> (Self, [f64; SIZE]) {
        let mode = Mode { hinges: vec![HingeState::Free; HINGES], ..Mode::at_start(scene) };
        let beta: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
        let mut dynamics = Recursive::<f64>::new(scene);
        dynamics.set_mode(&mode, &beta);
        let recognised = recognise(dynamics.tree()).expect("booms and a paddle");
        let options = Options { kernels: nboom_routines::all(), ..Options::default() };
        let fit = Repertoire::new(&options).best(&recognised, false).expect("a stock routine");
        let kernel = fit.kernel;
        let mut batches = nboom_routines::batches().iter();
        let batch = *batches.find(|batch| batch.topology == kernel.topology).expect("its batch");
        assert_eq!(batch.coordinates, kernel.coordinates);
        let splat: Vec<Eight> = fit.parameters.iter().map(|&p| Eight::splat(p)).collect();
        let mut batch_constants = vec![Eight::default(); batch.constants];
        batch.prepare(&splat, &mut batch_constants);
        let mut places = vec![([0; 3], 0); HINGES];
        for (&link, place) in recognised.links.iter().zip(fit.hinges()) {
            places[link] = place;
        }
        let mut y = [0.0; SIZE];
        y[0] = 1.0;
        y[OMEGA] = 10.0;
        y[BETA..TAU].copy_from_slice(&beta);
        let satellite = Self {
            constants: fit.constants(),
            batch_constants,
            coordinates: vec![0.0; kernel.coordinates],
            batch_coordinates: vec![Eight::default(); batch.coordinates],
            outputs: vec![0.0; kernel.outputs],
            batch_outputs: vec![Eight::default(); batch.outputs],
            places,
            torques: torques(&mut dynamics),
            kernel,
            batch,
            has_lanes: true,
        };
        (satellite, y)
    }
}

/// The torques, which are linear in angles and rates.
fn torques(dynamics: &mut Recursive<f64>) -> [[f64; 3]; HINGES] {
    let mut at = |beta: f64, tau: f64| {
        let (beta, tau, mut found) = ([beta; HINGES], [tau; HINGES], [0.0; HINGES]);
        let motion = Motion { omega_body: Vec3::zero(), beta: &beta, tau: &tau };
        dynamics.hinge_forces(&motion, &mut found);
        found
    };
    let (rest, turned, turning) = (at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0));
    std::array::from_fn(|i| [rest[i], turned[i] - rest[i], turning[i] - rest[i]])
}

fn attitude_rate(y: [f64; 7]) -> [f64; 4] {
    let [s, x, y, z, p, q, r] = y;
    [
        -0.5 * (x * p + y * q + z * r),
        0.5 * (s * p + y * r - z * q),
        0.5 * (s * q + z * p - x * r),
        0.5 * (s * r + x * q - y * p),
    ]
}

impl System for Satellite {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let x = &mut self.coordinates;
        x[..3].copy_from_slice(&y[OMEGA..BETA]);
        for (j, &([beta, tau, torque], _)) in self.places.iter().enumerate() {
            (x[beta], x[tau]) = (y[BETA + j], y[TAU + j]);
            let [rest, spring, dashpot] = self.torques[j];
            x[torque] = rest + spring * x[beta] + dashpot * x[tau];
        }
        self.kernel.evaluate(&self.constants, x, &mut self.outputs);
        dy[..ATTITUDE].copy_from_slice(&attitude_rate(std::array::from_fn(|i| y[i])));
        dy[OMEGA..BETA].copy_from_slice(&self.outputs[..3]);
        dy[BETA..TAU].copy_from_slice(&y[TAU..]);
        for (j, &(_, at)) in self.places.iter().enumerate() {
            dy[TAU + j] = self.outputs[at];
        }
    }

    fn derivatives(&mut self, _t: &Eight, y: &[Eight], dy: &mut [Eight]) -> bool {
        if !self.has_lanes {
            return false;
        }
        for lane in 0..8 {
            let rates = attitude_rate(std::array::from_fn(|i| y[i].0[lane]));
            for (rate, dy) in rates.into_iter().zip(&mut dy[..ATTITUDE]) {
                dy.0[lane] = rate;
            }
        }
        let x = &mut self.batch_coordinates;
        x[..3].copy_from_slice(&y[OMEGA..BETA]);
        for (j, &([beta, tau, torque], _)) in self.places.iter().enumerate() {
            (x[beta], x[tau]) = (y[BETA + j], y[TAU + j]);
            let [rest, spring, dashpot] = self.torques[j];
            for lane in 0..8 {
                x[torque].0[lane] = rest + spring * x[beta].0[lane] + dashpot * x[tau].0[lane];
            }
        }
        self.batch.evaluate(&self.batch_constants, x, &mut self.batch_outputs);
        dy[OMEGA..BETA].copy_from_slice(&self.batch_outputs[..3]);
        for (j, &(_, at)) in self.places.iter().enumerate() {
            dy[TAU + j] = self.batch_outputs[at];
        }
        true
    }

    fn rate_of(&self, i: usize) -> Option<usize> {
        (BETA..TAU).contains(&i).then_some(i + HINGES)
    }

    fn sizes(&mut self, _y: &[f64], sizes: &mut [f64]) {
        sizes.fill(1.0);
        sizes[OMEGA..BETA].fill(10.0);
        sizes[TAU..].fill(10.0);
    }
}

const END: f64 = 1.0;
const SAMPLES: usize = 200;
const ROUNDS: usize = 300;

type Samples = Vec<[f64; SIZE]>;

fn run(
    stepper: &mut dyn Stepper,
    satellite: &mut Satellite,
    y: &[f64],
    dense: bool,
) -> (Samples, Counts) {
    let (mut samples, mut counts) = (Vec::new(), stepper.window().counts);
    let before = counts;
    stepper.start(satellite, 0.0, y, SIZE);
    while stepper.window().time < END {
        stepper.step(satellite, END).expect("a smooth motion");
        if dense {
            stepper.prepare_dense(satellite);
            let window = stepper.window();
            let (start, length) = (window.time, window.length());
            let time = |i: usize| END * i as f64 / SAMPLES as f64;
            while samples.len() < SAMPLES && time(samples.len()) < start + length {
                let mut sample = [0.0; SIZE];
                stepper.interpolate((time(samples.len()) - start) / length, &mut sample);
                samples.push(sample);
            }
        }
        stepper.advance();
    }
    let mut end = [0.0; SIZE];
    end.copy_from_slice(&stepper.window().state);
    samples.push(end);
    counts = stepper.window().counts;
    counts.accepted -= before.accepted;
    counts.rejected -= before.rejected;
    counts.evaluations -= before.evaluations;
    (samples, counts)
}

/// Largest difference, of rates in units of ten.
fn difference(a: &[f64; SIZE], b: &[f64; SIZE]) -> f64 {
    let unit = |i: usize| if (OMEGA..BETA).contains(&i) || i >= TAU { 10.0 } else { 1.0 };
    (0..SIZE).map(|i| (a[i] - b[i]).abs() / unit(i)).fold(0.0, f64::max)
}

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/scenes/T1_smooth.nml");
    let scene = nboom::io::read_scene(&path).expect("the scene is in the clone").scene;
    let (mut satellite, start) = Satellite::new(&scene);
    let mut finest = GaussLanes::new(Tolerance { relative: 1e-15, absolute: 1e-15 });
    finest.limit_steps(END / SAMPLES as f64);
    let (exact, _) = run(&mut finest, &mut satellite, &start, true);
    for relative in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let tolerance = Tolerance { relative, absolute: relative };
        let explicit = || -> Box<dyn Stepper> { Box::new(RungeKutta::dop853(tolerance)) };
        let lanes = || -> Box<dyn Stepper> { Box::new(GaussLanes::new(tolerance)) };
        let mut methods = [
            ("dop853", explicit(), false, false),
            ("dop853_dense", explicit(), true, false),
            ("gauss_lanes", lanes(), false, true),
            ("gauss_lanes_dense", lanes(), true, true),
            ("gauss_lanes_scalar", lanes(), false, false),
        ];
        let mut times = [const { Vec::new() }; 5];
        for _ in 0..ROUNDS {
            for ((_, stepper, dense, has_lanes), times) in methods.iter_mut().zip(&mut times) {
                satellite.has_lanes = *has_lanes;
                let before = Instant::now();
                black_box(run(&mut **stepper, &mut satellite, black_box(&start), *dense));
                times.push(before.elapsed().as_secs_f64() * 1e6);
            }
        }
        for ((name, stepper, dense, has_lanes), times) in methods.iter_mut().zip(&mut times) {
            times.sort_by(f64::total_cmp);
            satellite.has_lanes = *has_lanes;
            let (found, counts) = run(&mut **stepper, &mut satellite, &start, *dense);
            let end = difference(&found[found.len() - 1], &exact[SAMPLES]);
            let inside = found[..found.len() - 1].iter().zip(&exact);
            let inside = inside.map(|(a, b)| difference(a, b)).fold(0.0, f64::max);
            let Counts { accepted, rejected, evaluations, .. } = counts;
            println!(
                "{relative:e} {name} us_min {:.1} us_median {:.1} end {end:.1e} inside {inside:.1e} \
                 steps {accepted} refused {rejected} states {evaluations}",
                times[0],
                times[times.len() / 2]
            );
        }
    }
}
