//! Runs that are made and seen without any code of studies.

use std::io;

use nboom_io::{Sampling, SceneFile};
use nboom_results::{RunDescription, SummaryFile, WantedOutput, WorstLoads};
use nboom_sim::{
    Event, InstantMotion, Options, OutputTimes, Recorder, Snapshot, StepMotion, Summary, simulate,
};
use nboom_strength::{Settings, StressAnalysis};

/// All that a run tells.
pub struct Witness {
    times: Option<OutputTimes>,
    analysis: Option<StressAnalysis>,
    pub samples: Vec<Snapshot>,
    /// Both sides of instants.
    pub sides: Vec<Snapshot>,
    pub events: Vec<Event>,
}

impl Recorder for Witness {
    fn output_times(&self) -> Option<&OutputTimes> {
        self.times.as_ref()
    }

    fn needs_detail(&self) -> bool {
        true
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.samples.push(snapshot.clone());
        Ok(())
    }

    fn event(&mut self, event: &Event, _after: &Snapshot) -> io::Result<()> {
        self.events.push(*event);
        Ok(())
    }

    fn needs_instants(&self) -> bool {
        true
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.sides.extend(instant.sides().map(|side| side.snapshot.clone()));
        self.analysis.as_mut().map_or(Ok(()), |of| of.instant(instant).map_err(io::Error::other))
    }

    fn needs_steps(&self) -> bool {
        self.analysis.is_some()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.analysis.as_mut().map_or(Ok(()), |of| of.step(step).map_err(io::Error::other))
    }
}

/// A run of a scene with its output times and stresses, the worst loads, and its summary as JSON.
pub fn run(
    file: &SceneFile,
    options: Options,
) -> (Witness, Summary, WorstLoads, serde_json::Value) {
    let scene = &file.scene;
    let mut options = options;
    let times = match &file.settings.sampling {
        Some(Sampling::Uniform(samples)) => {
            options.samples = *samples;
            None
        }
        Some(every) => every.times([scene.initial.time, scene.end_time]).expect("few"),
        None => None,
    };
    let times = times.map(OutputTimes::at);
    let analysis = file.structure.as_ref().map(|structure| {
        StressAnalysis::new(scene, structure, Settings::default()).expect("sections")
    });
    let (samples, sides, events) = (Vec::new(), Vec::new(), Vec::new());
    let mut witness = Witness { times: times.clone(), analysis, samples, sides, events };
    let summary = simulate(scene, &options, &mut witness).expect("a run");
    let worst = witness.analysis.as_mut().map(|analysis| {
        analysis.finish().expect("finite");
        WorstLoads::of(analysis)
    });
    let worst = worst.unwrap_or_default();
    let units = file.settings.units.clone().unwrap_or_default();
    let description = RunDescription {
        parameters: file.settings.parameters.clone(),
        output: WantedOutput { times, ..WantedOutput::default() },
        ..RunDescription::new(scene, &options, units)
    };
    let keys = SummaryFile::ended(&description, &summary, &worst, 1.5, None, Vec::new());
    let keys = serde_json::from_slice(&keys.text()).expect("JSON");
    (witness, summary, worst, keys)
}
