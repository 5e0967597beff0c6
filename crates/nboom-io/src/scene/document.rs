//! A scene whose text is read once and whose numbers can be set.

mod part;
mod path;
mod text;

use std::path::Path;
use std::sync::Arc;

use super::expression;
use super::include::Parts;
use super::memory::Memory;
use super::parameters::Parameters;
use super::tree::Value;
use super::{Found, ReadOptions, Sources, assemble, idle, write_scene};
use crate::diagnostic::Report;
use crate::source::{self, sha256};
use crate::{Format, InputError, LegacySettings, SceneFile};
pub use part::ScenePart;
pub use path::{Slot, UnknownPath};
use path::{Step, child, child_mut, step};

/// What messages add to the name of a file that is not read as it stands.
const IN_TOML: &str = " in TOML";

/// A scene that is read once and then made as often as wanted, each time with other numbers.
///
/// Numbers are set in the tree of its text, so that expressions follow parameters, and what is wrong is
/// told at its place. A deck or a robot becomes a scene in TOML first.
///
/// ```
/// # let path = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/cubesat.toml"));
/// let document = nboom_io::SceneDocument::read(path, &nboom_io::ReadOptions::default())?;
/// let stiffness = document.slot("parameters.stiffness")?;
/// let of_a_panel = document.slot("body.x panel.hinge.spring.stiffness")?;
/// assert_eq!([&stiffness, &of_a_panel].map(|slot| document.number(slot)), [0.02; 2]);
/// let file = document.scene(&[(&stiffness, 0.03)])?;
/// assert_eq!(file.scene.bodies[0].hinge.spring.linear, -0.03);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneDocument {
    /// The file's name for messages.
    file: String,
    /// What the scene is called if it does not say.
    name: String,
    parts: Parts,
    sources: Arc<Sources>,
    options: ReadOptions,
    sha256: String,
    /// Whether its text says something else.
    is_changed: bool,
    /// What scenes that differ in numbers have in common, once the document is known to be right.
    memory: Option<Arc<Memory>>,
    /// The scene before it became another text.
    as_read: Option<Arc<SceneFile>>,
}

impl SceneDocument {
    /// Reads a scene `NAME.toml` with all that it includes, a deck `NAME.nml` or a robot `NAME.urdf`.
    ///
    /// # Errors
    /// Those of [`read_scene_with`](crate::read_scene_with).
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, InputError> {
        let (format, text, sha256) = source::read_file(path)?;
        let (file, name) = (path.display().to_string(), source::scene_name(path));
        let folder = Some(source::folder(path));
        let read = Self::of_text(format, (&file, &text), &name, folder, options)?;
        Ok(if format == Format::Toml { read } else { Self { sha256, ..read } })
    }

    /// Reads the text of a scene, a deck or a robot. Files that a scene includes lie in `folder`.
    ///
    /// # Errors
    /// Those of [`parse`](crate::parse()).
    pub fn of_text(
        format: Format,
        (file, text): (&str, &str),
        name: &str,
        folder: Option<&Path>,
        options: &ReadOptions,
    ) -> Result<Self, InputError> {
        if format != Format::Toml {
            let scene = crate::parse(format, (file, text), name, None, options)?;
            let (sha256, document) = (scene.sha256.clone(), Self::converted(file, &scene)?);
            return Ok(Self { sha256, as_read: Some(Arc::new(scene)), ..document });
        }
        let read = Self::parse((file, text), name, folder, options)?;
        let as_read = Some(Arc::new(read.scene(&[])?));
        Ok(Self { as_read, ..read.merged().with_memory() })
    }

    /// The document of the text that a scene is written as.
    fn converted(file: &str, scene: &SceneFile) -> Result<Self, InputError> {
        let (name, text) = (&scene.scene.name, write_scene(scene));
        let file = format!("{}{IN_TOML}", file.trim_end_matches(IN_TOML));
        let read = Self::parse((&file, &text), name, None, &ReadOptions::default())?;
        read.scene(&[])?;
        Ok(read.with_memory())
    }

    /// A text of a scene, of which only its TOML has been checked.
    pub(super) fn parse(
        (file, text): (&str, &str),
        name: &str,
        folder: Option<&Path>,
        options: &ReadOptions,
    ) -> Result<Self, InputError> {
        let mut sources = Sources::default();
        let mut report = Report::new(file);
        let parts = Parts::read((file, text), folder, options, &mut sources, &mut report);
        // What follows from half of a text would only confuse.
        if !report.errors.is_empty() {
            report.sort();
            return Err(InputError::Content(report.errors));
        }
        Ok(Self {
            file: file.to_owned(),
            name: name.to_owned(),
            sha256: sha256(parts.all_text(&sources).as_bytes()),
            parts,
            sources: Arc::new(sources),
            options: options.clone(),
            is_changed: false,
            memory: None,
            as_read: None,
        })
    }

    /// All files in one tree, in which the parameters of the options are set.
    fn merged(self) -> Self {
        let is_changed = !self.parts.included.is_empty() || !self.options.set.is_empty();
        let mut parts = self.parts.merged();
        for (name, value) in &self.options.set {
            let steps = ["parameters", name].map(|key| Step::Key(key.to_owned()));
            if let Some(slot) = path::find(parts.root(), &steps) {
                *child_mut(parts.root_mut(), &slot) = Value::Number(*value);
            }
        }
        let options = ReadOptions { set: Vec::new(), ..self.options };
        Self { parts, options, is_changed, ..self }
    }

    /// One that reads once what its scenes have in common; it is in one file and right.
    fn with_memory(self) -> Self {
        let memory = Memory::of(self.parts.root(), self.parameters());
        Self { memory: Some(Arc::new(memory)), ..self }
    }

    /// The document of the scene as it stands: each body that `repeat` makes has a table of its own, and all
    /// expressions are numbers.
    ///
    /// # Errors
    /// None are to be expected.
    pub fn expanded(self) -> Result<Self, InputError> {
        let expanded = Self::converted(&self.file, &self.scene(&[])?)?;
        Ok(Self { sha256: self.sha256, as_read: self.as_read, ..expanded })
    }

    /// The document of its text that stands alone, which messages call `file`.
    ///
    /// # Errors
    /// None are to be expected.
    pub fn alone(self, file: &str) -> Result<Self, InputError> {
        let read = Self::parse((file, &self.text()), &self.name, None, &ReadOptions::default())?;
        read.scene(&[])?;
        let (sha256, as_read) = (self.sha256, self.as_read);
        let mut alone = Self { sha256, as_read, ..read }.with_memory();
        alone.parts.included = self.parts.included;
        Ok(alone)
    }

    /// The place of a number, or of an expression that gives one: keys with dots between them, as in TOML.
    /// A table in a list goes by its name or by its number, from 1; elements of lists go by numbers:
    /// `body.left panel.mass_centre[2]`, `main_body.force[1].from`. A part in quotes may have dots.
    ///
    /// # Errors
    /// When the scene has no number there.
    pub fn slot(&self, path: &str) -> Result<Slot, UnknownPath> {
        let unknown = |expected, nearest| {
            let found = path.to_owned();
            UnknownPath { found, expected, nearest }
        };
        let steps = path::steps(path).ok_or_else(|| unknown(path::NO_PATH, None))?;
        let root = self.parts.root();
        let is_number = |slot: &Slot| self.is_number(slot);
        if let Some(slot) = path::find(root, &steps).filter(is_number) {
            return Ok(slot);
        }
        if self.is_made_by_repeat(&steps) {
            return Err(unknown(path::REPEATED, None));
        }
        if steps[0] == Step::Key("parameters".to_owned()) && root.get("parameters").is_none() {
            return Err(unknown(path::NO_PARAMETERS, None));
        }
        let nearest = path::nearest(root, &steps, &is_number)
            .or_else(|| path::within(root, &steps, &is_number));
        let is_as_read = self.as_read().is_none_or(|file| file.format == Format::Toml);
        let expected = if is_as_read { path::NO_NUMBER } else { path::NO_NUMBER_OF_ITS_SCENE };
        Err(unknown(expected, nearest.map(|slot| path::text(root, &slot))))
    }

    /// The path of a place of this document.
    ///
    /// # Panics
    /// As [`Self::number`].
    pub fn path(&self, slot: &Slot) -> String {
        path::text(self.parts.root(), slot)
    }

    /// The unit of the number at a place of this document, with T for that of times, where its key says it: that of
    /// angles and their rates.
    ///
    /// # Panics
    /// As [`Self::number`].
    pub fn unit(&self, slot: &Slot) -> Option<&'static str> {
        path::unit(self.parts.root(), slot)
    }

    /// Whether a number may stand there.
    fn is_number(&self, slot: &Slot) -> bool {
        match child(self.parts.root(), slot) {
            Value::Number(_) => true,
            // A name may look like an expression.
            Value::Text(_) => {
                let number = self.number(slot);
                number.is_finite() && self.scene(&[(slot, number)]).is_ok()
            }
            _ => false,
        }
    }

    /// Whether a path begins with a body that only the finished scene has.
    fn is_made_by_repeat(&self, steps: &[Step]) -> bool {
        let [Step::Key(bodies), Step::Key(name), ..] = steps else { return false };
        let is_written = || step(self.parts.root(), &steps[..2]).is_some();
        let has = |file: SceneFile| {
            file.scene.labels().iter().any(|label| label.name.as_deref() == Some(name))
        };
        bodies == "body" && !is_written() && self.scene(&[]).is_ok_and(has)
    }

    /// What the scene says at a place of this document, in the units of its key.
    ///
    /// # Panics
    /// When the place is of another document and this one has none such.
    pub fn number(&self, slot: &Slot) -> f64 {
        match child(self.parts.root(), slot) {
            Value::Number(number) => *number,
            Value::Text(text) => {
                let parameters = self.parameters();
                let found = expression::evaluate(text, &mut |name| {
                    parameters.get(name).ok_or_else(|| parameters.unknown(name))
                });
                found.unwrap_or(f64::NAN)
            }
            _ => f64::NAN,
        }
    }

    fn parameters(&self) -> Parameters {
        let entries: Vec<_> = self.parts.entries("parameters").collect();
        Parameters::read(&entries, &self.options.set, &self.sources, &mut Report::new(&self.file))
    }

    /// The same with these numbers in their places, of which the last one counts where several are for one.
    ///
    /// # Panics
    /// As [`Self::number`].
    #[must_use]
    pub fn with(&self, values: &[(&Slot, f64)]) -> Self {
        Self { is_changed: true, parts: self.parts_with(values), ..self.clone() }
    }

    fn parts_with(&self, values: &[(&Slot, f64)]) -> Parts {
        let mut parts = self.parts.clone();
        for (slot, value) in values {
            *child_mut(parts.root_mut(), slot) = Value::Number(*value);
        }
        parts
    }

    /// The scene with these numbers in their places.
    ///
    /// # Errors
    /// [`InputError::Content`] with all that is wrong.
    ///
    /// # Panics
    /// As [`Self::number`].
    pub fn scene(&self, values: &[(&Slot, f64)]) -> Result<SceneFile, InputError> {
        let (parts, memory) = (self.parts_with(values), self.memory.as_deref());
        let mut report = Report::new(&self.file);
        let found = assemble(&parts, memory, &self.name, &self.options, &self.sources, &mut report);
        // Where a number stands for an expression, the text does not say what uses what.
        if memory.is_none() && !self.is_changed {
            idle::check_use(&parts, &self.options.set, &self.sources, &mut report);
        }
        report.sort();
        match found {
            Some(Found { scene, structure, settings, stress_interval })
                if report.errors.is_empty() =>
            {
                Ok(SceneFile {
                    scene,
                    warnings: report.warnings,
                    legacy: LegacySettings { stress_interval, ..LegacySettings::default() },
                    structure,
                    format: Format::Toml,
                    settings,
                    included: self.parts.included.clone(),
                    sha256: self.sha256.clone(),
                })
            }
            _ => Err(InputError::Content(report.errors)),
        }
    }

    /// A text of the scene that stands alone; its own, unless it includes others or numbers are set.
    pub fn text(&self) -> String {
        if self.is_changed { text::of(self.parts.root()) } else { self.sources.text(0).to_owned() }
    }

    /// The text that [`write_scene`] makes of the scene with these numbers.
    ///
    /// # Errors
    /// As [`Self::scene`].
    pub fn text_with(&self, values: &[(&Slot, f64)]) -> Result<String, InputError> {
        Ok(write_scene(&self.scene(values)?))
    }

    /// The scene as it was read, with the warnings of its file: of a deck also with what a scene in TOML does not
    /// say. None of a document that was not read by [`Self::read`] or [`Self::of_text`].
    pub fn as_read(&self) -> Option<&SceneFile> {
        self.as_read.as_deref()
    }

    /// SHA-256 of all texts that were read, in hexadecimal digits.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }
}

#[cfg(test)]
mod tests;
