//! What a run writes, in words.

use nboom_model::{Column, Finding, Scene, WantedTable};

use super::catalog::{ANGLE_UNITS, FILES_ON_REQUEST};
use super::fields::{Fields, Reader};
use super::suggest;
use crate::Sampling;
use crate::deck::shown;
use crate::diagnostic::quoted;
use crate::sampling::MOST_SAMPLES;

impl Reader<'_, '_> {
    /// The output times, if the scene says any.
    pub fn sampling(&mut self, output: &Fields<'_>, scene: &Scene) -> Option<Sampling> {
        let keys = ["samples", "every", "times"];
        let given: Vec<&str> = keys.into_iter().filter(|key| output.has(key)).collect();
        if let [first, second, ..] = given[..] {
            let found = format!("`{second}` beside `{first}`");
            self.error(&output.place(second), second, &found, "one of them");
            return None;
        }
        let span = (scene.initial.time, scene.end_time);
        match given[..] {
            ["samples"] => self.count(output, "samples", MOST_SAMPLES).map(Sampling::Uniform),
            ["every"] => self.every(output, span),
            ["times"] => self.times(output, span).map(Sampling::At),
            _ => None,
        }
    }

    fn every(&mut self, output: &Fields<'_>, (start, end): (f64, f64)) -> Option<Sampling> {
        let every = Sampling::Every(self.number(output, "every")?);
        if let Err(error) = every.times([start, end]) {
            let Finding { found, expected } = error.finding();
            self.error(&output.place("every"), "every", &found, &expected);
            return None;
        }
        Some(every)
    }

    fn times(&mut self, output: &Fields<'_>, (start, end): (f64, f64)) -> Option<Vec<f64>> {
        let times = self.list(output, "times")?;
        let outside = times.iter().find(|time| !(start..=end).contains(time));
        let falls = times.windows(2).find(|pair| pair[1] <= pair[0]);
        let wrong =
            outside.map(|time| (shown(*time), "a time from the start to the end of the run"));
        let wrong = wrong.or_else(|| {
            let found = |pair: &[f64]| format!("{} after {}", shown(pair[1]), shown(pair[0]));
            falls.map(|pair| (found(pair), "ascending times"))
        });
        if let Some((found, expected)) = &wrong {
            self.error(&output.place("times"), "times", found, expected);
        }
        wrong.is_none().then_some(times)
    }

    /// Whether each of [`FILES_ON_REQUEST`] is wanted.
    pub fn files(&mut self, output: &Fields<'_>) -> [bool; FILES_ON_REQUEST.len()] {
        let mut wanted = [false; FILES_ON_REQUEST.len()];
        for (text, at) in self.texts(output, "files") {
            match FILES_ON_REQUEST.iter().position(|file| *file == text) {
                Some(file) => wanted[file] = true,
                None => {
                    let known = FILES_ON_REQUEST.iter().copied();
                    let help = suggest::nearest(text, known).map(suggest::question);
                    let expected = format!("one of {}", FILES_ON_REQUEST.join(", "));
                    let found = quoted(text);
                    self.report.error_with_help(
                        self.sources,
                        &at,
                        "files",
                        &found,
                        &expected,
                        help,
                    );
                }
            }
        }
        wanted
    }

    /// The table of the motion that the scene asks for, if it does.
    pub fn wanted_table(&mut self, output: &Fields<'_>, scene: &Scene) -> Option<WantedTable> {
        let in_degrees = self.choice(output, "angles", ANGLE_UNITS) == Some("degrees");
        if !output.has("columns") {
            let columns = Column::all(scene.bodies.len());
            return in_degrees.then_some(WantedTable { columns, in_degrees });
        }
        self.warn_if_idle(output, "columns", &[]);
        let mut table = WantedTable { columns: Vec::new(), in_degrees };
        for (text, at) in self.texts(output, "columns") {
            match Column::named(text, scene.labels(), scene.rotors.len()) {
                Ok(columns) => {
                    let named = WantedTable { columns, in_degrees };
                    if named.is_of_held_body() && !scene.base.is_held() {
                        let expected = "columns of a main body that moves freely";
                        self.error(&at, "columns", &quoted(text), expected);
                    } else {
                        table.add(named.columns);
                    }
                }
                Err(error) => {
                    let known = error.known.iter().map(String::as_str);
                    let help = suggest::nearest(text, known).map(suggest::question);
                    let (found, expected) = (quoted(text), error.expected);
                    self.report.error_with_help(
                        self.sources,
                        &at,
                        "columns",
                        &found,
                        expected,
                        help,
                    );
                }
            }
        }
        Some(table)
    }
}
