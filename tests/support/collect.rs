//! A recorder that keeps everything a run tells.
#![allow(dead_code, reason = "each test binary uses its own part")]

use std::io;

use nboom::elements::{Kind, LineReading};
use nboom::model::Scene;
use nboom::sim::{
    Detail, Event, EventKind, Failure, Options, Recorder, Snapshot, Summary, simulate,
};

/// A kick-off spring becomes shorter than its limit length.
pub const ENGAGES: EventKind = EventKind::Fall(Kind::KickOff);

/// A kick-off spring grows beyond its limit length.
pub const DISENGAGES: EventKind = EventKind::Rise(Kind::KickOff);

/// Force and length of the line at each of so many hinges; zero where there is none.
pub fn forces_and_lengths(lines: &[LineReading], hinges: usize) -> [Vec<f64>; 2] {
    let mut found = [vec![0.0; hinges], vec![0.0; hinges]];
    for line in lines {
        (found[0][line.hinge], found[1][line.hinge]) = (line.force, line.length);
    }
    found
}

/// Everything a run has told.
#[derive(Default)]
pub struct Collected {
    pub samples: Vec<Snapshot>,
    /// Each event with the motion after its instant.
    pub events: Vec<(Event, Snapshot)>,
}

impl Recorder for Collected {
    fn needs_detail(&self) -> bool {
        true
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.samples.push(snapshot.clone());
        Ok(())
    }

    fn event(&mut self, event: &Event, after: &Snapshot) -> io::Result<()> {
        self.events.push((*event, after.clone()));
        Ok(())
    }
}

impl Collected {
    /// The events without the end of the run, as kind, hinge and time.
    pub fn happenings(&self) -> Vec<(EventKind, Option<usize>, f64)> {
        let inner = self.events.iter().filter(|(event, _)| event.kind != EventKind::End);
        inner.map(|(event, _)| (event.kind, event.hinge, event.time)).collect()
    }

    /// The last sample.
    pub fn last(&self) -> &Snapshot {
        self.samples.last().expect("every run samples its initial time")
    }
}

/// The tolerance at which runs are compared with references, and this many output intervals.
pub fn tight(samples: usize) -> Options {
    Options { samples, rtol: 1e-12, atol: 1e-13, ..Options::default() }
}

/// Runs a scene that must come to its end.
pub fn run(scene: &Scene, options: &Options) -> (Collected, Summary) {
    match try_run(scene, options) {
        (collected, Ok(summary)) => (collected, summary),
        (_, Err(failure)) => panic!("{}: {failure}", scene.name),
    }
}

/// Runs a scene; what it told before a failure is kept.
pub fn try_run(scene: &Scene, options: &Options) -> (Collected, Result<Summary, Failure>) {
    let mut collected = Collected::default();
    let result = simulate(scene, options, &mut collected);
    (collected, result)
}

/// The accelerations and forces of a snapshot.
pub fn detail(snapshot: &Snapshot) -> &Detail {
    snapshot.detail.as_ref().expect("details were asked for")
}
