//! Events found in another way, to compare those of a run with: steps of fixed length of the
//! classical Runge-Kutta method, the guards looked at after each, and a change of sign closed in on
//! by taking the step again. Of the run's own code it shares accelerations and impulses alone.

use nboom::dynamics::{Accelerations, Impulses, Motion, Recursive, Struck};
use nboom::model::{Course, External, Hinge, HingeState, Mode, Release, Scene};
use nboom::scalar::Vec3;
use nboom::sim::EventKind;

use crate::collect::{DISENGAGES, ENGAGES};
use crate::random_scene::spring;

/// Crossings closer than this are one instant; angles closer than 1e-12 are one angle.
const ONE_INSTANT: f64 = 1e-11;

/// Kind, hinge and time.
pub type Happening = (EventKind, Option<usize>, f64);

/// A quantity whose change of sign is an event.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Guard {
    Lock(usize),
    Trigger { hinge: usize, trigger: usize, angle: f64 },
    Spring(usize),
}

pub struct Sampled<'a> {
    scene: &'a Scene,
    dynamics: Recursive<f64>,
    mode: Mode,
    time: f64,
    omega: Vec3<f64>,
    beta: Vec<f64>,
    tau: Vec<f64>,
    /// When each hinge locked; infinite of one that has not.
    locked_at: Vec<f64>,
    /// Guards of the mode with the sign each has; zero until it has left zero.
    guards: Vec<(Guard, f64)>,
    pub events: Vec<Happening>,
}

impl<'a> Sampled<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let start = |value: fn(&Hinge) -> f64| -> Vec<f64> {
            scene.bodies.iter().map(|body| value(&body.hinge)).collect()
        };
        let mut found = Self {
            scene,
            dynamics: Recursive::new(scene),
            mode: Mode::at_start(scene),
            time: scene.initial.time,
            omega: scene.initial.omega_body,
            beta: start(|hinge| hinge.start.angle),
            tau: start(|hinge| hinge.start.rate),
            locked_at: vec![f64::INFINITY; scene.bodies.len()],
            guards: Vec::new(),
            events: Vec::new(),
        };
        found.mode.externals = found.externals();
        found.enter(&[]);
        for i in 0..scene.bodies.len() {
            if scene.bodies[i].hinge.kick_off.is_some() {
                let acts = found.value(Guard::Spring(i), &found.variables()) <= 0.0;
                found.mode.pieces[spring(&scene.bodies, i)] = usize::from(!acts);
            }
        }
        found.release(&[], &[]);
        found.enter(&[]);
        found
    }

    /// Goes on to the end in steps no longer than `length`.
    pub fn run(&mut self, length: f64) {
        while self.time < self.scene.end_time {
            let start = self.variables();
            let step = length.min(self.next_scheduled() - self.time);
            let end = self.stepped(&start, step);
            let values: Vec<f64> =
                self.guards.clone().iter().map(|&(guard, _)| self.value(guard, &end)).collect();
            let crossed = |i: &usize| self.guards[*i].1 * values[*i] < 0.0;
            let crossed: Vec<usize> = (0..values.len()).filter(crossed).collect();
            let times: Vec<f64> =
                crossed.iter().map(|&i| self.close_in(self.guards[i], &start, step)).collect();
            let first = times.iter().fold(f64::INFINITY, |a, &b| a.min(b));
            if first < step {
                let together =
                    crossed.iter().zip(&times).filter(|(_, t)| **t - first < ONE_INSTANT);
                let guards: Vec<Guard> = together.map(|(&i, _)| self.guards[i].0).collect();
                self.go_to(&start, first);
                self.pass(&guards);
                continue;
            }
            self.go_to(&start, step);
            for ((_, side), value) in self.guards.iter_mut().zip(values) {
                *side = if *side == 0.0 { value.signum() } else { *side };
            }
            self.pass(&[]);
        }
    }

    /// ω, then β and τ of the free hinges.
    fn variables(&self) -> Vec<f64> {
        let free = self.dynamics.free_hinges();
        let of_free = |all: &[f64]| free.iter().map(|&i| all[i]).collect::<Vec<f64>>();
        [self.omega.to_array().to_vec(), of_free(&self.beta), of_free(&self.tau)].concat()
    }

    fn go_to(&mut self, start: &[f64], step: f64) {
        let end = self.stepped(start, step);
        let motion = split(&end);
        self.omega = motion.omega_body;
        for (j, &i) in self.dynamics.free_hinges().iter().enumerate() {
            (self.beta[i], self.tau[i]) = (motion.beta[j], motion.tau[j]);
        }
        self.time += step;
    }

    fn stepped(&mut self, start: &[f64], step: f64) -> Vec<f64> {
        let mut end = start.to_vec();
        let mut slope = vec![0.0; start.len()];
        for (fraction, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            let at: Vec<f64> =
                start.iter().zip(&slope).map(|(y, f)| y + fraction * step * f).collect();
            slope = self.slope(&at);
            for (end, f) in end.iter_mut().zip(&slope) {
                *end += step / 6.0 * weight * f;
            }
        }
        end
    }

    fn slope(&mut self, variables: &[f64]) -> Vec<f64> {
        let motion = split(variables);
        let mut found = Accelerations::for_hinges(motion.beta.len());
        self.dynamics.accelerations(&motion, &mut found);
        [found.omega_dot_body.to_array().to_vec(), motion.tau.to_vec(), found.tau_dot].concat()
    }

    fn value(&mut self, guard: Guard, variables: &[f64]) -> f64 {
        let motion = split(variables);
        let beta = |hinge: usize| {
            let position = self.dynamics.free_hinges().iter().position(|&i| i == hinge);
            position.map_or(self.beta[hinge], |j| motion.beta[j])
        };
        match guard {
            Guard::Lock(hinge) => beta(hinge) - self.lock_angle(hinge),
            Guard::Trigger { trigger, angle, .. } => beta(trigger) - angle,
            Guard::Spring(hinge) => {
                let limit = self.scene.bodies[hinge].hinge.kick_off.map_or(0.0, |k| k.limit_length);
                let line = spring(&self.scene.bodies, hinge);
                self.dynamics.line_length(line, |j| [motion.beta[j], motion.tau[j]]).squared.sqrt()
                    - limit
            }
        }
    }

    /// How far into a step of this length a guard changes sign (bisection).
    fn close_in(&mut self, (guard, side): (Guard, f64), start: &[f64], step: f64) -> f64 {
        let (mut low, mut high) = (0.0, step);
        while high - low > 1e-15 * self.time.abs().max(1.0) {
            let middle = 0.5 * (low + high);
            let state = self.stepped(start, middle);
            let beyond = self.value(guard, &state) * side < 0.0;
            (low, high) = if beyond { (low, middle) } else { (middle, high) };
        }
        high
    }

    /// Lock-ups together, then releases, springs and thrust; then the guards anew.
    fn pass(&mut self, crossed: &[Guard]) {
        let of = |kind: fn(&Guard) -> Option<usize>| crossed.iter().filter_map(kind).collect();
        let locks: Vec<usize> = of(|g| if let Guard::Lock(i) = g { Some(*i) } else { None });
        let springs: Vec<usize> = of(|g| if let Guard::Spring(i) = g { Some(*i) } else { None });
        self.lock(&locks);
        let released = self.release(crossed, &locks);
        for &i in &springs {
            let piece = &mut self.mode.pieces[spring(&self.scene.bodies, i)];
            *piece = 1 - *piece;
            let kind = if *piece == 0 { ENGAGES } else { DISENGAGES };
            self.events.push((kind, Some(i), self.time));
        }
        let externals = self.externals();
        if externals != self.mode.externals {
            let pieces = externals.iter().zip(&self.mode.externals);
            for (external, (&after, &before)) in self.scene.externals.iter().zip(pieces) {
                // Pulses act in their second piece.
                if (after == 1) != (before == 1) {
                    let is_on = after == 1;
                    let kind = if is_on { EventKind::ThrustOn } else { EventKind::ThrustOff };
                    self.events.push((kind, external.body, self.time));
                }
            }
            self.mode.externals = externals;
        } else if locks.is_empty() && springs.is_empty() && !released {
            return;
        }
        self.enter(&springs);
    }

    fn lock(&mut self, locks: &[usize]) {
        let free = self.dynamics.free_hinges().to_vec();
        let motion = self.variables();
        let motion = split(&motion);
        let position = |i: &usize| free.iter().position(|j| j == i).expect("only free hinges lock");
        let struck: Vec<_> = locks.iter().map(|i| Struck::locks(position(i))).collect();
        let mut change = Impulses::of_none();
        let locked = self.dynamics.strike(motion.beta, motion.tau, &struck, &mut change);
        assert_eq!(locked, Ok(()), "no impulse locks {locks:?}");
        self.omega += change.delta_omega_body;
        for (&i, change) in free.iter().zip(&change.delta_tau) {
            self.tau[i] += change;
        }
        for &i in locks {
            (self.beta[i], self.tau[i]) = (self.lock_angle(i), 0.0);
            self.mode.hinges[i] = HingeState::Locked;
            self.locked_at[i] = self.time;
            self.events.push((EventKind::LockUp, Some(i), self.time));
        }
    }

    /// Releases what is due; whether there was anything.
    fn release(&mut self, crossed: &[Guard], locks: &[usize]) -> bool {
        let at_start = self.time == self.scene.initial.time;
        let now = self.time + ONE_INSTANT;
        let due = |i: &usize| match self.scene.bodies[*i].hinge.release {
            _ if self.mode.hinges[*i] != HingeState::Unreleased => false,
            Release::Time(at) => at <= now,
            Release::Angle { hinge, angle } => {
                let passed = |g: &Guard| matches!(g, Guard::Trigger { hinge, .. } if hinge == i);
                let holds = (self.beta[hinge] - angle).abs() < 1e-12;
                crossed.iter().any(passed) || (holds && (at_start || locks.contains(&hinge)))
            }
            Release::AfterLock { hinge, delay } => self.locked_at[hinge] + delay <= now,
            Release::Never => false,
        };
        let due: Vec<usize> = (0..self.beta.len()).filter(due).collect();
        for &i in &due {
            self.mode.hinges[i] = HingeState::Free;
            self.events.push((EventKind::Release, Some(i), self.time));
        }
        !due.is_empty()
    }

    /// The pieces of pulses.
    fn externals(&self) -> Vec<usize> {
        let now = self.time + ONE_INSTANT;
        let passed = |times: [f64; 2]| times.iter().filter(|&&at| at <= now).count();
        self.scene.externals.iter().map(|external| passed(times(external))).collect()
    }

    fn next_scheduled(&self) -> f64 {
        let releases =
            (0..self.beta.len()).filter_map(|i| match self.scene.bodies[i].hinge.release {
                _ if self.mode.hinges[i] != HingeState::Unreleased => None,
                Release::Time(at) => Some(at),
                Release::AfterLock { hinge, delay } => Some(self.locked_at[hinge] + delay),
                _ => None,
            });
        let thrust = self.scene.externals.iter().flat_map(times);
        let later = |at: &f64| *at > self.time + ONE_INSTANT;
        releases.chain(thrust).filter(later).fold(self.scene.end_time, f64::min)
    }

    /// Makes the equations those of the mode; `toggled` springs have just changed sign.
    fn enter(&mut self, toggled: &[usize]) {
        let before = std::mem::take(&mut self.guards);
        self.dynamics.set_mode(&self.mode, &self.beta);
        let state = self.variables();
        for i in 0..self.beta.len() {
            let hinge = self.scene.bodies[i].hinge;
            if self.mode.is_free(i) && hinge.lock_angle.is_some() {
                // The side is that on which the hinge became free.
                let known = before.iter().find(|(guard, _)| *guard == Guard::Lock(i));
                let side = known.map_or_else(|| sign(self.value(Guard::Lock(i), &state)), |k| k.1);
                self.guards.push((Guard::Lock(i), side));
            }
            if let Release::Angle { hinge: trigger, angle } = hinge.release
                && self.mode.hinges[i] == HingeState::Unreleased
                && self.mode.is_free(trigger)
            {
                let guard = Guard::Trigger { hinge: i, trigger, angle };
                let side = sign(self.value(guard, &state));
                self.guards.push((guard, side));
            }
            if hinge.kick_off.is_some() {
                let side = if toggled.contains(&i) {
                    if self.mode.pieces[spring(&self.scene.bodies, i)] == 0 { -1.0 } else { 1.0 }
                } else {
                    sign(self.value(Guard::Spring(i), &state))
                };
                self.guards.push((Guard::Spring(i), side));
            }
        }
    }

    fn lock_angle(&self, hinge: usize) -> f64 {
        self.scene.bodies[hinge].hinge.lock_angle.expect("only latches lock")
    }
}

/// Zero for zero.
fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

fn split(variables: &[f64]) -> Motion<'_, f64> {
    let (omega, hinges) = variables.split_at(3);
    let (beta, tau) = hinges.split_at(hinges.len() / 2);
    Motion { omega_body: Vec3::new(omega[0], omega[1], omega[2]), beta, tau }
}

/// When a pulse starts and stops.
fn times(external: &External) -> [f64; 2] {
    match external.course {
        Course::Pulse { on, off } => [on, off],
        Course::Table(_) => panic!("a pulse"),
    }
}
