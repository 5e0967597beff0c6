//! One case: its scene, its run, its row.

use std::sync::Arc;

use nboom_io::{Sampling, SceneFile};
use nboom_model::Scene;
use nboom_results::{RunDescription, SummaryFile, WantedOutput, WorstLoads, with_causes};
use nboom_scalar::{Batch, Kernel};
use nboom_sim::{
    Lanes, Options, OutputTimes, Path, Repertoire, SharedRepertoire, SimError, Simulator, Summary,
};
use nboom_strength::{StrengthError, StressAnalysis};

use crate::observer::Observer;
use crate::plan::Case;
use crate::rejection::{Rejection, in_one_line};
use crate::row::{Row, Status, Value};
use crate::selected::FirstSelected;
use crate::study::{Change, Fault, Relation, RunSettings, Study};
use crate::table::units;
use crate::wanted::{Extreme, Found, Happened, Wanted};

impl Relation {
    /// What becomes of the number that is there.
    pub(crate) fn applied(self, number: f64, there: impl FnOnce() -> f64) -> f64 {
        match self {
            Self::Value => number,
            Self::Factor => there() * number,
            Self::Offset => there() + number,
        }
    }
}

impl Study {
    /// Whether the loads of its cases are without the pulses of hinges that latch, as their constants are not known.
    pub fn leaves_pulses_out(&self) -> bool {
        let analysis = self.analysis((&self.nominal, &self.nominal.scene), &[]);
        analysis.is_ok_and(|found| found.is_some_and(|found| !found.has_pulses()))
    }

    /// The segments that margins of its cases leave out, in words, if they leave out some.
    pub fn without_margins(&self) -> Option<String> {
        let analysis = self.analysis((&self.nominal, &self.nominal.scene), &[]);
        analysis.ok().flatten()?.without_margins()
    }

    /// What finds the loads of a run of this scene, if its file has them and a result depends on them.
    fn analysis(
        &self,
        (file, scene): (&SceneFile, &Scene),
        kernels: &[Kernel],
    ) -> Result<Option<StressAnalysis>, StrengthError> {
        if !self.wanted.iter().any(Wanted::depends_on_loads) {
            return Ok(None);
        }
        self.run.wanted_loads(file, scene).analysis(kernels)
    }

    /// The scene of a case, with its fault; it ends when the scene says.
    ///
    /// # Errors
    /// When what is drawn makes no scene.
    pub fn scene_of(&self, case: &Case) -> Result<SceneFile, Rejection> {
        let mut values = Vec::new();
        for (variable, &drawn) in self.variables.iter().zip(&case.values) {
            let value = |slot| variable.relation.applied(drawn, || self.document.number(slot));
            values.extend(variable.slots.iter().map(|slot| (slot, value(slot))));
        }
        let Some(fault) = case.fault.map(|fault| &self.faults[fault]) else {
            return self.as_large(self.document.scene(&values)?);
        };
        // What a fault changes is what was drawn.
        let drawn = self.document.with(&values);
        let changes = fault.changes.iter().map(|Change { slot, relation, number }| {
            (slot, relation.applied(*number, || drawn.number(slot)))
        });
        broken(self.as_large(drawn.scene(&changes.collect::<Vec<_>>())?)?, fault)
    }

    /// A scene with as many hinges as all, which results and faults count.
    fn as_large(&self, file: SceneFile) -> Result<SceneFile, Rejection> {
        let [found, expected] = [&file, &self.nominal].map(|file| file.scene.bodies.len());
        if found == expected {
            return Ok(file);
        }
        Err(Rejection::of_count(found, expected))
    }
}

/// The scene with a fault of its hinges.
pub(crate) fn broken(file: SceneFile, fault: &Fault) -> Result<SceneFile, Rejection> {
    let mut description = (*file.scene).clone();
    fault.apply(&mut description)?;
    let scene = file.scene.with_description(description)?;
    Ok(SceneFile { scene, ..file })
}

impl RunSettings {
    /// The output times of a run of this scene; `None` for uniform ones, of which there are as many as the
    /// second says.
    fn output(
        &self,
        file: &SceneFile,
        scene: &Scene,
    ) -> Result<(Option<OutputTimes>, usize), Rejection> {
        let sampling = file.settings.sampling_of_run(self.samples);
        let samples = sampling.as_ref().and_then(Sampling::samples);
        let times =
            sampling.map_or(Ok(None), |of| of.times([scene.initial.time, scene.end_time]))?;
        Ok((times.map(OutputTimes::at), samples.unwrap_or(self.options().samples)))
    }
}

/// Why a case has no results.
enum Stop {
    Interrupted,
    Rejected(Rejection),
    Failed(String),
}

impl From<Rejection> for Stop {
    fn from(rejection: Rejection) -> Self {
        Self::Rejected(rejection)
    }
}

/// The results of a case.
struct Results {
    values: Vec<Value>,
    /// Its trajectory.
    states: Vec<Vec<f64>>,
    /// What is wrong with them, if anything is.
    status: Status,
}

/// Runs cases of a study one after the other. What it finds for a case does not depend on those before.
#[derive(Debug)]
pub struct Runner<'s> {
    study: &'s Study,
    options: Options,
    repertoire: SharedRepertoire,
    /// With the options that it was made for.
    simulator: Option<(usize, Simulator)>,
    wanted: Vec<Extreme>,
    columns: Vec<nboom_model::Column>,
    /// Who hears which code computed a case, if the study asks for a formulation.
    selected: Option<&'s FirstSelected>,
}

impl<'s> Runner<'s> {
    /// A runner of cases of `study`, which may use this generated code.
    pub fn new(
        study: &'s Study,
        kernels: &'static [Kernel],
        right_sides: &'static [Batch],
    ) -> Self {
        let options = Options { kernels, batches: right_sides, ..study.run.options() };
        Self::sharing(study, options, Repertoire::shared(&options))
    }

    /// This one, which tells which code computed its cases.
    pub(crate) fn telling(self, selected: &'s FirstSelected) -> Self {
        Self { selected: Some(selected), ..self }
    }

    /// Another runner, which has the routines of this one.
    pub(crate) fn beside(&self) -> Self {
        let beside = Self::sharing(self.study, self.options, Arc::clone(&self.repertoire));
        Self { selected: self.selected, ..beside }
    }

    fn sharing(study: &'s Study, options: Options, repertoire: SharedRepertoire) -> Self {
        let wanted = study.wanted.iter().filter_map(Wanted::extreme).collect();
        let hinges = study.nominal.scene.bodies.len();
        let columns =
            if study.trajectories { nboom_model::Column::all(hinges) } else { Vec::new() };
        let (simulator, selected) = (None, None);
        Self { study, options, repertoire, simulator, wanted, columns, selected }
    }

    /// The row of a case; `None` if it was interrupted.
    pub fn run(&mut self, case: &Case, interrupted: &dyn Fn() -> bool) -> Option<Row> {
        let lanes = Lanes::new();
        lanes.finish(self.run_in(&lanes, case, interrupted))
    }

    /// The row of a case whose steps are taken beside those of others that meet in `lanes`, if the study does not
    /// say otherwise; `None` if it was interrupted.
    pub async fn run_in(
        &mut self,
        lanes: &Lanes,
        case: &Case,
        interrupted: &dyn Fn() -> bool,
    ) -> Option<Row> {
        let without = |status| {
            let values = vec![Value::Empty; self.study.wanted.len()];
            Results { values, states: Vec::new(), status }
        };
        let found = match self.results(lanes, case, interrupted).await {
            Ok(found) => found,
            Err(Stop::Interrupted) => return None,
            Err(Stop::Rejected(why)) => without(Status::Rejected(why.to_string())),
            Err(Stop::Failed(why)) => without(Status::Failed(why)),
        };
        let Results { values, states, status } = found;
        let whole = |number: u64| Value::Integer(number as i64);
        let mut cells = vec![whole(case.number), whole(case.seed)];
        if !self.study.faults.is_empty() {
            let name = |fault: usize| Value::Text(self.study.faults[fault].name.clone());
            cells.push(case.fault.map_or(Value::Empty, name));
        }
        cells.extend(case.values.iter().map(|&value| Value::number(value)));
        cells.extend(values);
        cells.push(Value::Text(status.to_string()));
        Some(Row { cells, states, outcome: status.outcome() })
    }

    async fn results(
        &mut self,
        lanes: &Lanes,
        case: &Case,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<Results, Stop> {
        let prepared = self.prepare(case)?;
        let scene = &prepared.scene;
        let mut observer = Observer {
            times: prepared.times,
            interrupted,
            analysis: prepared.analysis,
            hinges: vec![Happened::default(); scene.bodies.len()],
            wanted: &self.wanted,
            extremes: vec![f64::NAN; self.wanted.len()],
            columns: &self.columns,
            states: Vec::new(),
        };
        let simulator = ready(&mut self.simulator, scene, prepared.options, &self.repertoire);
        let ran = simulator.run_in(lanes, &mut observer).await;
        let summary = ran.map_err(|failure| match failure.error {
            SimError::Interrupted { .. } => Stop::Interrupted,
            error => Stop::Failed(in_one_line(&with_causes(&error))),
        })?;
        if let Some((selected, formulation)) = self.selected.zip(prepared.options.formulation) {
            selected.note(case.number, formulation, &summary.selections);
        }
        let rtol = prepared.options.rtol;
        let status = if summary.runaway.is_some() {
            Status::Runaway
        } else if summary.conservation.poor(rtol).next().is_some() {
            Status::Poor
        } else if summary.verdict.doubts(scene, rtol).next().is_some() {
            Status::Doubtful
        } else {
            Status::Ok
        };
        let of_run = (&prepared.file, scene, &prepared.options);
        let values = values(&self.study.wanted, of_run, summary, &mut observer)?;
        Ok(Results { values, states: observer.states, status })
    }

    fn prepare(&self, case: &Case) -> Result<Prepared, Rejection> {
        let run = &self.study.run;
        let file = self.study.scene_of(case)?;
        let kernels = if self.options.path == Path::Generic { &[] } else { self.options.kernels };
        let scene = run.scene(&file)?;
        let analysis = self.study.analysis((&file, &scene), kernels)?;
        let (times, samples) = run.output(&file, &scene)?;
        Ok(Prepared { file, scene, analysis, times, options: Options { samples, ..self.options } })
    }
}

/// A case before its run.
struct Prepared {
    file: SceneFile,
    /// With the end of the run.
    scene: Scene,
    analysis: Option<StressAnalysis>,
    times: Option<OutputTimes>,
    options: Options,
}

/// The simulator of a scene; the one at hand if it has the same options.
fn ready<'s>(
    simulator: &'s mut Option<(usize, Simulator)>,
    scene: &Scene,
    options: Options,
    repertoire: &SharedRepertoire,
) -> &'s mut Simulator {
    let known = simulator.take().filter(|(samples, _)| *samples == options.samples);
    let ready = match known {
        Some((_, mut known)) => {
            known.set_scene(scene);
            known
        }
        None => Simulator::sharing(scene, options, Arc::clone(repertoire)),
    };
    &mut simulator.insert((options.samples, ready)).1
}

/// What a run has found of the wanted results.
fn values(
    wanted: &[Wanted],
    (file, scene, options): (&SceneFile, &Scene, &Options),
    summary: &Summary,
    observer: &mut Observer<'_>,
) -> Result<Vec<Value>, Stop> {
    let mut worst = WorstLoads::default();
    if let Some(analysis) = &mut observer.analysis {
        analysis.finish().map_err(|error| Stop::Failed(in_one_line(&error.to_string())))?;
        worst = WorstLoads::of(analysis);
    }
    let run = wanted.iter().any(Wanted::of_summary).then(|| {
        let output = WantedOutput { times: observer.times.take(), ..WantedOutput::default() };
        let parameters = file.settings.parameters.clone();
        let run = RunDescription::new(scene, options, units(file));
        RunDescription { parameters, output, ..run }
    });
    let ended = |run| SummaryFile::ended(run, summary, &worst, 0.0, None, Vec::new());
    let keys = run.as_ref().map(ended);
    let (hinges, extremes) = (&observer.hinges, &observer.extremes);
    let labels = scene.labels();
    let found = Found { labels, hinges, extremes, summary, worst: &worst, keys: keys.as_ref() };
    Ok(Wanted::values(wanted, &found))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn loads_are_found_where_a_result_depends_on_them() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let scene = root.join("examples/n-boom-1970.nml");
        let place = tempfile::tempdir().expect("a directory");
        let path = place.path().join("study.toml");
        for (result, is_of_loads) in [
            ("lock_time of 1,1", false),
            ("final nutation", false),
            ("conservation.energy", false),
            ("steps_accepted", false),
            ("evaluations", true),
            ("selections[1].evaluations", true),
            ("peak_moment of 1,1", true),
            ("verdict.largest_hinge_force_at.time", true),
            ("verdict.worst_load", true),
        ] {
            let vary = "[[vary]]\npath = 'main_body.mass'\nas = 'factor'\nvalues = [1.0]\n";
            let results = format!("method = 'grid'\nresults = ['final omega_x', '{result}']\n");
            let text = format!("scene = {scene:?}\n{results}{vary}");
            std::fs::write(&path, text).expect("writable");
            let study = Study::read(&path).unwrap_or_else(|error| panic!("{error}"));
            let of_scene = (&study.nominal, &study.nominal.scene);
            let found = study.analysis(of_scene, &[]).expect("sections are sections");
            assert_eq!(found.is_some(), is_of_loads, "{result}");
        }
    }
}
