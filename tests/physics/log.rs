//! Runs that must come to their end, from descriptions.
#![allow(dead_code, reason = "each test binary uses its own part")]

use nboom::model::{Scene, SceneDescription};
use nboom::sim::{Event, EventKind, Options, Snapshot, Summary};

use super::collect;

/// Everything a run has told.
pub struct Log {
    pub samples: Vec<Snapshot>,
    /// Each event with the motion after its instant.
    pub events: Vec<(Event, Snapshot)>,
    pub summary: Summary,
}

impl Log {
    pub fn last(&self) -> &Snapshot {
        self.samples.last().expect("every run samples its initial time")
    }

    /// Every event of this kind.
    pub fn of_kind(&self, kind: EventKind) -> Vec<&(Event, Snapshot)> {
        self.events.iter().filter(|(event, _)| event.kind == kind).collect()
    }
}

/// Runs a scene that is expected to be valid and to come to its end.
pub fn run(description: &SceneDescription, options: &Options) -> Log {
    let scene = Scene::new(description.clone()).expect("a valid scene");
    let (collected, summary) = collect::run(&scene, options);
    Log { samples: collected.samples, events: collected.events, summary }
}

/// Options with this many output intervals and this relative tolerance; the absolute one is
/// far below.
pub fn options(samples: usize, rtol: f64) -> Options {
    Options { samples, rtol, atol: 1e-3 * rtol, ..Options::default() }
}
