//! How far the time of an event may be off: derived from what each step may err by, and from how the
//! motion carries that on.
//!
//! Step control holds its estimate of a step's error e to Σ (eᵢ/sᵢ)² ≤ n over the n variables that
//! decide on steps, with sᵢ = atol · sizeᵢ + rtol · |yᵢ|. An error e at time t moves a later event by
//! g·e, with g the gradient of its time with respect to the state at t, so by √n |s∘g| at most
//! (Cauchy and Schwarz). The bound is the sum over all steps before the event. Gradients are
//! differences of runs that go on from the beginning of a step.

use std::io;

use nboom::model::{HingeState, Scene, SceneDescription};
use nboom::scalar::Vec3;
use nboom::sim::{Options, Recorder, StepMotion, simulate};

use crate::collect::run;
use crate::sampled::Happening;

/// The motion where a step begins.
#[derive(Clone, Debug)]
struct Start {
    time: f64,
    hinges: Vec<HingeState>,
    omega: Vec3<f64>,
    beta: Vec<f64>,
    tau: Vec<f64>,
}

/// Where the steps of a run began.
#[derive(Default)]
struct Steps(Vec<Start>);

impl Recorder for Steps {
    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        let [time, _] = step.span();
        let motion = step.at(time);
        self.0.push(Start {
            time,
            hinges: motion.hinges.to_vec(),
            omega: motion.omega_body,
            beta: motion.beta.to_vec(),
            tau: motion.tau.to_vec(),
        });
        Ok(())
    }
}

/// Change of a variable by which gradients are taken, in units of its size: far above the errors of
/// the runs that are compared, far below what bends event times.
const SHIFT: f64 = 1e-7;

/// Options of these runs.
fn accurate() -> Options {
    Options { samples: 1, rtol: 1e-12, atol: 1e-14, ..Options::default() }
}

impl Start {
    /// Largest rate, as the natural size of rates.
    fn fastest(&self) -> f64 {
        let rates = self.omega.to_array().into_iter().chain(self.tau.iter().copied());
        rates.fold(0.0, |largest, rate| largest.max(rate.abs()))
    }

    fn is_free(&self, hinge: usize) -> bool {
        self.hinges[hinge] == HingeState::Free
    }

    /// ω, then β and τ of the free hinges: value and natural size.
    fn variables(&self) -> Vec<(f64, f64)> {
        let rate = self.fastest();
        let free = |all: &[f64], size: f64| -> Vec<(f64, f64)> {
            let free = all.iter().enumerate().filter(|(i, _)| self.is_free(*i));
            free.map(|(_, &value)| (value, size)).collect()
        };
        let omega = self.omega.to_array().map(|value| (value, rate));
        [omega.to_vec(), free(&self.beta, 1.0), free(&self.tau, rate)].concat()
    }

    /// With one of the variables changed.
    fn shifted(&self, variable: usize, by: f64) -> Self {
        let mut start = self.clone();
        let free: Vec<usize> = (0..self.beta.len()).filter(|&i| self.is_free(i)).collect();
        match variable {
            0 => start.omega.x += by,
            1 => start.omega.y += by,
            2 => start.omega.z += by,
            i if i < 3 + free.len() => start.beta[free[i - 3]] += by,
            i => start.tau[free[i - 3 - free.len()]] += by,
        }
        start
    }

    /// The events of `scene` from here on.
    fn events(&self, scene: &SceneDescription) -> Vec<Happening> {
        let mut scene = scene.clone();
        scene.initial.time = self.time;
        scene.initial.omega_body = self.omega;
        for (i, body) in scene.bodies.iter_mut().enumerate() {
            let start = &mut body.hinge.start;
            (start.angle, start.rate, start.state) = (self.beta[i], self.tau[i], self.hinges[i]);
        }
        let scene = Scene::new(scene).expect("the motion of a scene");
        run(&scene, &accurate()).0.happenings()
    }
}

/// The largest difference of times, `off`, of the events `happened` in a run, in units of as much of the
/// bound as had to be computed, and how many steps that was.
///
/// The bound is a sum of terms none of which is negative, so it is summed until it suffices.
pub fn largest_share(
    scene: &SceneDescription,
    options: &Options,
    happened: &[Happening],
    off: &[f64],
) -> (f64, usize) {
    let mut steps = Steps::default();
    let checked = Scene::new(scene.clone()).expect("a physical scene");
    simulate(&checked, options, &mut steps).expect("it has been run before");
    // Times are rounded, scheduled ones too.
    let mut bound = vec![1e-14; off.len()];
    let names = |events: &[Happening]| -> Vec<_> { events.iter().map(|e| (e.0, e.1)).collect() };
    let share = |bound: &[f64]| off.iter().zip(bound).map(|(off, b)| off / b).fold(0.0, f64::max);
    for (k, start) in steps.0.iter().enumerate() {
        if share(&bound) <= 1.0 {
            return (share(&bound), k);
        }
        let expected = start.events(scene);
        // What happens just where the step begins may happen again; then less is allowed.
        let Some(later) = happened.len().checked_sub(expected.len()) else { continue };
        if names(&happened[later..]) != names(&expected) {
            continue;
        }
        let variables = start.variables();
        let ends = steps.0.get(k + 1).map(Start::variables).filter(|e| e.len() == variables.len());
        let mut squares = vec![0.0; expected.len()];
        for (i, &(value, size)) in variables.iter().enumerate() {
            let by = SHIFT * size;
            let found = start.shifted(i, by).events(scene);
            // Where the change makes other events, this variable is left out, so that less is allowed.
            if names(&found) == names(&expected) {
                let value =
                    ends.as_ref().map_or(value.abs(), |end| value.abs().max(end[i].0.abs()));
                let allowed = options.atol * size + options.rtol * value;
                for (square, (a, b)) in squares.iter_mut().zip(found.iter().zip(&expected)) {
                    *square += ((a.2 - b.2) / by * allowed).powi(2);
                }
            }
        }
        // The attitude is a variable, too, on which no event depends.
        let count = (4 + variables.len()) as f64;
        for (bound, square) in bound[later..].iter_mut().zip(squares) {
            *bound += (count * square).sqrt();
        }
    }
    (share(&bound), steps.0.len())
}
