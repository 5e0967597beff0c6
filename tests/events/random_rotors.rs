//! Random coaxial rotors without torques against a simulation in closed form: between events all
//! hinges turn uniformly, and an event only shares out angular momentum about one axis.

use nboom::model::{Hinge, HingeState, Release};
use nboom::sim::EventKind;

use crate::collect::{run, tight};
use crate::random_scene::Rng;
use crate::rotors::{BOOM, HUB, free, locking_at, scene, waiting};

const END: f64 = 4.0;

/// Hinges of which some turn, some wait for a time, an angle, a lock angle or a lock-up of an earlier one.
fn hinges(dice: &mut Rng) -> Vec<Hinge> {
    let mut hinges: Vec<Hinge> = Vec::new();
    for i in 0..6 {
        let hinge = match (i, dice.between(0.0, 1.0)) {
            (0 | 1, _) => free(dice.between(-1.0, 1.0), dice.between(-2.0, 2.0)),
            (_, roll) if roll < 0.3 => waiting(Release::Time(dice.between(0.0, END))),
            (_, roll) if roll > 0.8 => {
                let delay = if dice.chance(0.3) { 0.0 } else { dice.between(0.0, 1.0) };
                waiting(Release::AfterLock { hinge: dice.below(i), delay })
            }
            (_, roll) => {
                let trigger = dice.below(i);
                let lock = hinges[trigger].lock_angle.filter(|_| roll < 0.6);
                let angle = lock.unwrap_or(dice.between(-1.5, 1.5));
                waiting(Release::Angle { hinge: trigger, angle })
            }
        };
        let locks = dice.chance(0.7);
        let angle = dice.between(-1.5, 1.5);
        hinges.push(if locks { locking_at(hinge, angle) } else { hinge });
    }
    hinges
}

/// The closed form.
struct Exact<'a> {
    hinges: &'a [Hinge],
    time: f64,
    hub_rate: f64,
    beta: Vec<f64>,
    tau: Vec<f64>,
    states: Vec<HingeState>,
    locked_at: Vec<f64>,
    events: Vec<(EventKind, Option<usize>, f64)>,
}

impl<'a> Exact<'a> {
    fn new(hinges: &'a [Hinge]) -> Self {
        let start = |value: fn(&Hinge) -> f64| hinges.iter().map(value).collect();
        Self {
            hinges,
            time: 0.0,
            hub_rate: 0.0,
            beta: start(|hinge| hinge.start.angle),
            tau: start(|hinge| hinge.start.rate),
            states: hinges.iter().map(|hinge| hinge.start.state).collect(),
            locked_at: vec![f64::INFINITY; hinges.len()],
            events: Vec::new(),
        }
    }

    /// When hinge `i` reaches `angle`, going on as it does; infinite if it never does.
    fn reaches(&self, i: usize, angle: f64) -> f64 {
        let wait = (angle - self.beta[i]) / self.tau[i];
        if self.states[i] == HingeState::Free && wait > 1e-12 {
            self.time + wait
        } else {
            f64::INFINITY
        }
    }

    fn lock_time(&self, i: usize) -> f64 {
        self.hinges[i].lock_angle.map_or(f64::INFINITY, |angle| self.reaches(i, angle))
    }

    fn release_time(&self, i: usize) -> f64 {
        match self.hinges[i].release {
            _ if self.states[i] != HingeState::Unreleased => f64::INFINITY,
            Release::Time(at) => at,
            Release::Angle { hinge, angle } => self.reaches(hinge, angle),
            Release::AfterLock { hinge, delay } => self.locked_at[hinge] + delay,
            Release::Never => f64::INFINITY,
        }
    }

    fn run(&mut self) {
        let all = 0..self.hinges.len();
        loop {
            let locks: Vec<f64> = all.clone().map(|i| self.lock_time(i)).collect();
            let releases: Vec<f64> = all.clone().map(|i| self.release_time(i)).collect();
            let next = locks.iter().chain(&releases).fold(f64::INFINITY, |a, &b| a.min(b));
            if next >= END {
                return self.advance(END);
            }
            self.advance(next);
            let due = |times: &[f64]| -> Vec<usize> {
                all.clone().filter(|&i| times[i] - next < 1e-11).collect()
            };
            self.lock(&due(&locks));
            let follows = |i: usize| match self.hinges[i].release {
                Release::AfterLock { .. } => self.release_time(i),
                _ => releases[i],
            };
            let releases: Vec<f64> = all.clone().map(follows).collect();
            for i in due(&releases) {
                self.states[i] = HingeState::Free;
                self.events.push((EventKind::Release, Some(i), next));
            }
        }
    }

    fn advance(&mut self, time: f64) {
        for (beta, tau) in self.beta.iter_mut().zip(&self.tau) {
            *beta += tau * (time - self.time);
        }
        self.time = time;
    }

    /// The hub takes the booms in; the others keep their absolute rates.
    fn lock(&mut self, locking: &[usize]) {
        let held = self.states.iter().filter(|state| **state != HingeState::Free).count();
        let mut moment = HUB + BOOM * held as f64;
        let mut momentum = moment * self.hub_rate;
        for &i in locking {
            moment += BOOM;
            momentum += BOOM * (self.hub_rate + self.tau[i]);
            self.states[i] = HingeState::Locked;
            self.locked_at[i] = self.time;
            self.events.push((EventKind::LockUp, Some(i), self.time));
        }
        let change = momentum / moment - self.hub_rate;
        self.hub_rate += change;
        for (tau, state) in self.tau.iter_mut().zip(&self.states) {
            *tau = if *state == HingeState::Free { *tau - change } else { 0.0 };
        }
        for &i in locking {
            self.beta[i] = self.hinges[i].lock_angle.expect("it locks");
        }
    }
}

#[test]
fn random_rotors_have_the_events_of_the_closed_form() {
    let mut dice = Rng::new(1970);
    let (mut locks, mut releases, mut followers, mut joint) = (0, 0, 0, 0);
    for case in 0..400 {
        let hinges = hinges(&mut dice);
        let mut exact = Exact::new(&hinges);
        exact.run();
        let (found, _) = run(&scene(&hinges, END), &tight(1));
        let events = found.happenings();
        let names = |events: &[(EventKind, Option<usize>, f64)]| -> Vec<_> {
            events.iter().map(|event| (event.0, event.1)).collect()
        };
        assert_eq!(names(&events), names(&exact.events), "case {case}: {hinges:?}");
        for (found, exact) in events.iter().zip(&exact.events) {
            // Rounding, which slow crossings (rates down to some thousandths) magnify.
            assert!((found.2 - exact.2).abs() < 1e-11, "case {case}: {found:?}, {exact:?}");
        }
        let last = found.last();
        assert_eq!(last.hinges, exact.states, "case {case}");
        assert!((last.omega_body.x - exact.hub_rate).abs() < 1e-13, "case {case}");
        for (found, exact) in last.beta.iter().zip(&exact.beta) {
            assert!((found - exact).abs() < 1e-11, "case {case}: {found}, {exact}");
        }
        locks += events.iter().filter(|event| event.0 == EventKind::LockUp).count();
        releases += events.iter().filter(|event| event.0 == EventKind::Release).count();
        let follows = |event: &&(EventKind, Option<usize>, f64)| {
            let by = event.1.map(|i| hinges[i].release);
            event.0 == EventKind::Release && matches!(by, Some(Release::AfterLock { .. }))
        };
        followers += events.iter().filter(follows).count();
        joint += events.windows(2).filter(|pair| pair[0].2 == pair[1].2).count();
    }
    println!("{locks} lock-ups, {releases} releases, {joint} in one instant with another event");
    assert!(locks > 200 && releases > 300 && joint > 30, "{locks}, {releases}, {joint}");
    assert!(followers > 50, "{followers} after a lock-up");
}
