use std::collections::BTreeMap;
use std::path::PathBuf;

use nboom_io::{Sampling, SceneFile};
use nboom_results::Maker;
use nboom_scalar::{Batch, Kernel};
use toml::Spanned;
use toml::de::DeTable;

use crate::description::{Description, Source};
use crate::directory::SWEPT_SCENE_FILE;
use crate::gathering::Gathering;
use crate::selected::FirstSelected;
use crate::task::{Report, Task};
use crate::{Shard, Study, StudyError, Watcher, columns, trajectory_columns};

/// All cases of a study, or a part of them, run into a directory.
#[derive(Clone, Debug)]
pub struct Sweep<'s> {
    /// What is swept.
    pub study: &'s Study,
    /// Where its files are.
    pub directory: PathBuf,
    /// Threads.
    pub jobs: usize,
    /// Whether a sweep that was begun is continued.
    pub resume: bool,
    /// Which part is run; none if it is all.
    pub shard: Option<Shard>,
    /// Whether tables are in CSV too.
    pub csv: bool,
    /// Whether a sweep that another program or machine has begun is continued.
    pub accept_difference: bool,
    /// Generated routines that may compute accelerations.
    pub kernels: &'static [Kernel],
    /// Generated right sides.
    pub right_sides: &'static [Batch],
}

impl Sweep<'_> {
    /// Makes the sweep or continues it.
    ///
    /// Its tables do not depend on threads, on how often it was interrupted, or on shards.
    ///
    /// # Errors
    /// When the directory or tables of a shard are refused, and when the sweep could not be finished. What is done stays, and can be
    /// continued.
    pub fn run(&self, watcher: &dyn Watcher) -> Result<Report, StudyError> {
        self.require_tables()?;
        let (study, selected) = (self.study, FirstSelected::default());
        let worker = || study.worker(self.kernels, self.right_sides, &selected);
        let report = self.task(self.jobs, |task| task.run(&worker, watcher))?;
        Ok(Report { selected: selected.taken(), ..report })
    }

    /// Begins the sweep or continues it for cases that run elsewhere.
    ///
    /// # Errors
    /// When the directory or tables of a shard are refused.
    pub fn gather(&self) -> Result<Gathering, StudyError> {
        self.require_tables()?;
        let begin = self.task(0, |task| task.begin())?;
        Ok(Gathering::new(begin, &self.directory, self.accept_difference))
    }

    /// # Errors
    /// When tables are asked for that a shard does not have.
    fn require_tables(&self) -> Result<(), StudyError> {
        let shard = self.shard.filter(|_| self.csv);
        shard.map_or(Ok(()), |shard| Err(StudyError::TablesOfShard { shard }))
    }

    /// What is done with the task whose cases run in so many threads.
    fn task<T>(&self, jobs: usize, make: impl FnOnce(&Task<'_>) -> T) -> T {
        let study = self.study;
        let (text, scene) = (study.beside_its_scene(), study.document.text());
        make(&Task {
            directory: &self.directory,
            description: self.description(&text, &scene),
            study: &text,
            scene: &scene,
            samples: samples(study),
            jobs,
            resume: self.resume,
            accept_difference: self.accept_difference,
        })
    }

    /// What it is, of which these are the files.
    fn description(&self, text: &str, scene: &str) -> Description {
        let study = self.study;
        let states = study.trajectories.then(|| trajectory_columns(study));
        Description {
            version: Description::VERSION,
            name: study.name.clone(),
            made_by: Maker::current(),
            also_made_by: Vec::new(),
            study: Source::of(text),
            study_but_draws: Some(Source::of(&with(text, "draws", &0.into()))),
            scene: Source::of(scene),
            seed: study.seed,
            method: study.method.name().to_owned(),
            draws: study.draws,
            cases: study.cases(),
            shard: self.shard,
            rtol: study.run.options().rtol,
            columns: columns(study),
            vary_together: study.vary_together(),
            trajectory_columns: states.unwrap_or_default(),
            results: study.wanted.iter().map(|wanted| wanted.text().to_owned()).collect(),
            requirements: study.requirements.clone(),
            complete: false,
            csv: self.csv,
            tables: BTreeMap::new(),
            sums: BTreeMap::new(),
            counts: None,
        }
    }
}

impl Study {
    /// Its text as it stands beside its scene, `scene.toml`, in a sweep's directory. It has the name that the name of
    /// its file would no longer give it.
    pub fn beside_its_scene(&self) -> String {
        let text = with(&self.text, "scene", &SWEPT_SCENE_FILE.into());
        let (keys, _) = DeTable::parse_recoverable(&text);
        let place = |key: &str| keys.get_ref().keys().find(|of| *of.get_ref() == key);
        match (place("name"), place("scene")) {
            (None, Some(scene)) => {
                let name = toml::Value::from(self.name.as_str());
                let (before, after) = text.split_at(scene.span().start);
                format!("{before}name = {name}\n{after}")
            }
            _ => text,
        }
    }
}

/// A text in TOML with another value of a key of its root, if it has that key.
fn with(text: &str, key: &str, value: &toml::Value) -> String {
    let (keys, _) = DeTable::parse_recoverable(text);
    match keys.get_ref().get(key).map(Spanned::span) {
        Some(place) => [&text[..place.start], &value.to_string(), &text[place.end..]].concat(),
        None => text.to_owned(),
    }
}

/// About how many output times a case has.
fn samples(study: &Study) -> u64 {
    let SceneFile { scene, settings, .. } = &study.nominal;
    let span = [scene.initial.time, study.run.end_time.unwrap_or(scene.end_time)];
    // Those of a case that has too many are refused, case by case.
    let listed = |of: &Sampling| of.times(span).ok().flatten().map(|times| times.len() + 1);
    let sampling = settings.sampling_of_run(study.run.samples);
    let samples = sampling.and_then(|of| of.samples().or_else(|| listed(&of)));
    samples.unwrap_or(study.run.options().samples) as u64 + 1
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    #[test]
    fn rows_of_a_trajectory_are_those_that_the_scene_asks_for() {
        let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
        let scene = fs::read_to_string(examples.join("cubesat.toml")).expect("an example");
        let place = tempfile::tempdir().expect("a directory");
        let study = place.path().join("study.toml");
        let study_text =
            "scene = 'scene.toml'\ndraws = 1\n[[vary]]\npath = 'main_body.mass'\nvalues = [4]\n";
        fs::write(&study, study_text).expect("writable");
        let rows = |output: &str, run: &str| {
            assert!(scene.contains("every = 0.01"));
            let scene = scene.replace("every = 0.01", output);
            fs::write(place.path().join("scene.toml"), scene).expect("writable");
            fs::write(&study, format!("{study_text}[run]\n{run}\n")).expect("writable");
            samples(&Study::read(&study).expect("a study"))
        };
        assert_eq!(rows("", "end_time = 5.0"), 201);
        assert_eq!(rows("every = 0.001", "end_time = 5.0"), 5001);
        assert_eq!(rows("every = 0.001", "samples = 10"), 11);
        assert_eq!(rows("times = [1.0, 2.0]", ""), 4);
    }
}
