//! `STUDY.toml`: text to a checked study.

mod effect;
mod faults;
mod keys;
mod overlap;
mod reader;
mod relevant;
mod requirements;
mod run;
mod situations;
mod vary;

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

use nboom_io::{
    BadFile, Diagnostic, Format, InputError, ReadOptions, SceneDocument, SceneFile,
    check_folder_name, folder_name, read_text,
};
use nboom_results::with_causes;
use toml::de::DeTable;

use crate::directory::SWEPT_SCENE_FILE;
use crate::plan::{Case, Plan, PlanError};
use crate::study::{Fault, Method, RunSettings, Study, Variable};
use crate::wanted::{UnknownResult, Wanted};
use keys::STUDY;
pub use keys::schema;
use reader::{Fields, Reader, quoted};

/// The longest study that is read \[bytes\].
const LONGEST: u64 = 16 << 20;

impl Study {
    /// Reads a study, and the scene that it varies.
    ///
    /// # Errors
    /// When a file cannot be read or the scene is wrong; and all that is wrong in the study, with its lines.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        Self::read_with(path, &ReadOptions::default())
    }

    /// As [`Self::read`], with a scene that is read with these options.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_with(path: &Path, options: &ReadOptions) -> Result<Self, InputError> {
        if Format::of(path).is_some_and(|format| format != Format::Toml) {
            return Err(InputError::NotAStudy { path: path.to_owned() });
        }
        let text = read_text(path, LONGEST)?;
        let file = path.display().to_string();
        let mut reader = Reader::new(&file, &text);
        let (table, errors) = DeTable::parse_recoverable(&text);
        if let Some(error) = errors.iter().min_by_key(|error| error.span().map(|at| at.start)) {
            let place = error.span().unwrap_or(text.len()..text.len());
            let message = error.message().lines().next().unwrap_or_default();
            let (found, expected) = message.split_once(", expected ").unwrap_or((message, "TOML"));
            reader.error(&place, "study", found, expected);
            return Err(InputError::Content(reader.errors));
        }
        let key = |name: &str| table.get_ref().iter().find(|(key, _)| key.get_ref() == name);
        if let (None, Some((main_body, _))) = (key("scene"), key("main_body")) {
            let expected = "a study, which names a scene; nboom run runs a scene";
            reader.error(&main_body.span(), "study", "a scene", expected);
            return Err(InputError::Content(reader.errors));
        }
        let root = reader.fields(table.get_ref(), &STUDY, 0..0);
        let study = reader.study(&root, (path, &text), options);
        reader.errors.sort_by_key(|error| (error.line, error.column));
        match study {
            Ok(Some(study)) if reader.errors.is_empty() => Ok(study),
            Ok(_) => Err(InputError::Content(reader.errors)),
            Err(of_scene) => Err(InputError::Content([reader.errors, of_scene].concat())),
        }
    }

    /// How many cases there are.
    pub fn cases(&self) -> u64 {
        self.plan.cases()
    }

    /// What is drawn for the case with this number, from 1.
    pub fn case(&self, number: u64) -> Case {
        self.plan.case(number)
    }
}

impl<'t> Reader<'t> {
    /// The study, or nothing if too much is wrong; errors are those of the scene.
    fn study(
        &mut self,
        root: &Fields<'t>,
        (path, text): (&Path, &str),
        options: &ReadOptions,
    ) -> Result<Option<Study>, Vec<Diagnostic>> {
        let name = self.name(root, path);
        let seed = self.whole(root, "seed").map_or(1, |seed| seed.value);
        let method = self.choice(root, "method").map_or(Method::MonteCarlo, |found| {
            let named = Method::ALL.into_iter().find(|method| method.name() == found.value);
            named.unwrap_or(Method::MonteCarlo)
        });
        let draws = self.draws(root, method);
        let trajectories = self.flag(root, "trajectories").unwrap_or(false);
        let of_run = self.table(root, "run");
        let run = self.run_settings(of_run.as_ref());
        let Some((document, nominal)) = self.scene(root, path, options)? else { return Ok(None) };
        self.check_run(of_run.as_ref(), &run, &nominal);
        let varied = self.tables(root, "vary");
        let variables: Vec<_> = varied
            .iter()
            .map(|of| (self.variable(of, &document, method), of.place_of("name")))
            .collect();
        self.check_overlaps(&varied, &variables, &document);
        let names: Vec<String> =
            variables.iter().flat_map(|(of, _)| of).map(|of| of.name.clone()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let pairs = self.tables(root, "correlation");
        let correlations = self.correlations(&pairs, method, &names);
        let tables = self.tables(root, "fault");
        let mut fault = |of: &Fields<'t>| {
            self.fault(of, &document, &nominal).map(|fault| (fault, of.place_of("name")))
        };
        let faults: Vec<_> = tables.iter().filter_map(&mut fault).collect();
        let wanted = self.wanted(root, &nominal, &run);
        let requirements = self.requirements(root, &wanted);
        self.check_columns(root, &variables, &faults, &wanted);
        if variables.is_empty() && tables.is_empty() {
            self.error(&root.place(), "vary", "nothing that varies", "a table vary or fault");
        } else if variables.is_empty() && draws > 1 {
            let found = format!("{draws} draws of nothing that varies");
            self.error(&root.place_of("draws"), "draws", found, "1, or a table vary");
        }
        if !self.errors.is_empty() {
            return Ok(None);
        }
        let variables: Vec<Variable> = variables.into_iter().filter_map(|(of, _)| of).collect();
        let faults: Vec<Fault> = faults.into_iter().map(|(fault, _)| fault).collect();
        let of_runs = (&document, &nominal, &run);
        self.check_effects([&varied, &tables], (&variables, &faults), of_runs);
        if !self.errors.is_empty() {
            return Ok(None);
        }
        let plan = Plan::new(method, seed, draws, &variables, &correlations, faults.len());
        let Some(plan) = self.feasible(plan, root, &pairs) else { return Ok(None) };
        let draws = plan.draws();
        Ok(Some(Study {
            name,
            text: text.to_owned(),
            document,
            nominal,
            seed,
            method,
            draws,
            variables,
            correlations,
            faults,
            wanted,
            requirements,
            run,
            trajectories,
            plan,
        }))
    }

    /// The scene with its text, or nothing if there is none; errors are those of the scene.
    fn scene(
        &mut self,
        root: &Fields<'t>,
        path: &Path,
        options: &ReadOptions,
    ) -> Result<Option<(SceneDocument, SceneFile)>, Vec<Diagnostic>> {
        let expanded = self.flag(root, "expanded").unwrap_or(false);
        let Some(scene) = self.text(root, "scene") else { return Ok(None) };
        let read = || -> Result<_, InputError> {
            let folder = path.parent().unwrap_or(Path::new(""));
            let document = SceneDocument::read(&folder.join(scene.value), options)?;
            let document = if expanded { document.expanded()? } else { document };
            // Lines in the table of cases are those of the scene beside it.
            let document = document.alone(SWEPT_SCENE_FILE)?;
            let nominal = document.scene(&[])?;
            Ok((document, nominal))
        };
        match read() {
            Ok(found) => Ok(Some(found)),
            Err(InputError::Content(errors)) => Err(errors),
            Err(error) => {
                let (found, expected) = match error.bad_file() {
                    Some(BadFile { place, found, expected }) => {
                        (format!("{}, {found}", quoted(&place)), expected)
                    }
                    None => (with_causes(&error), "the file of a scene"),
                };
                self.error(&scene.place, "scene", found, expected);
                Ok(None)
            }
        }
    }

    /// The plan, or nothing if its draws cannot be made; `pairs` are the tables of correlations.
    fn feasible(
        &mut self,
        plan: Result<Plan, PlanError>,
        root: &Fields<'t>,
        pairs: &[Fields<'t>],
    ) -> Option<Plan> {
        let error = match plan {
            Ok(plan) => return Some(plan),
            Err(error) => error,
        };
        let (key, found, expected) = error.told();
        let place = match pairs.first().filter(|_| key == "correlation") {
            Some(pair) => pair.place(),
            None => root.place_of(key),
        };
        self.error(&place, key, found, expected);
        None
    }

    /// The study's name, which becomes that of a folder.
    fn name(&mut self, root: &Fields<'t>, path: &Path) -> String {
        let of_file = || folder_name(&path.file_stem().unwrap_or_default().to_string_lossy());
        let Some(name) = self.text(root, "name") else { return of_file() };
        if let Err((found, expected)) = check_folder_name(name.value) {
            self.error(&name.place, "name", found, expected);
        }
        name.value.to_owned()
    }

    fn draws(&mut self, root: &Fields<'t>, method: Method) -> u64 {
        let draws = self.whole(root, "draws").map(|draws| draws.value);
        let is_grid = method == Method::Grid;
        if is_grid && root.has("draws") {
            let expected = "none of a grid, which has as many as its points make";
            self.error(&root.place_of("draws"), "draws", "a number of draws", expected);
        } else if !is_grid && !root.has("draws") {
            let expected = "how many draws there are, which all methods but a grid need";
            self.error(&root.place(), "draws", "nothing", expected);
        }
        draws.unwrap_or(1)
    }

    fn wanted(&mut self, root: &Fields<'t>, nominal: &SceneFile, run: &RunSettings) -> Vec<Wanted> {
        let loads = run.wanted_loads(nominal, &nominal.scene).loads();
        if !root.has("results") {
            return Wanted::defaults(nominal, loads);
        }
        let texts = self.texts(root, "results").unwrap_or_default();
        let mut all = Vec::new();
        for text in &texts {
            match Wanted::named(text.value, nominal, loads) {
                Ok(wanted) => all.push(wanted),
                Err(UnknownResult { found, expected, nearest }) => {
                    let found = quoted(&found);
                    self.error_like(&text.place, "results", found, expected, nearest.as_deref());
                }
            }
        }
        all
    }

    /// Reports columns and faults with the same name.
    fn check_columns(
        &mut self,
        root: &Fields<'t>,
        variables: &[(Option<Variable>, Range<usize>)],
        faults: &[(Fault, Range<usize>)],
        wanted: &[Wanted],
    ) {
        let mut names: BTreeSet<&str> = vary::RESERVED.into();
        for (variable, place) in variables {
            let Some(variable) = variable else { continue };
            if !names.insert(&variable.name) && !vary::RESERVED.contains(&&variable.name[..]) {
                self.error(
                    place,
                    "name",
                    quoted(&variable.name),
                    "a name that no other column has",
                );
            }
        }
        for result in wanted {
            if !names.insert(&result.column().name) {
                let found =
                    format!("{}, twice or the name of a variable", quoted(&result.column().name));
                let expected = "each column once; hinges whose names are too alike by their numbers, as `lock_time of 1,2` or `final beta_1_2`";
                self.error(&root.place_of("results"), "results", found, expected);
            }
        }
        let mut names = BTreeSet::new();
        for (fault, place) in faults {
            if !names.insert(&fault.name) {
                let found = format!("{}, the name of a fault before", quoted(&fault.name));
                self.error(place, "name", found, "each name once");
            }
        }
    }
}
