//! Scenes in TOML: text to a tree to words to a scene.

mod axes;
mod bodies;
mod catalog;
mod couplings;
mod document;
mod drive;
mod expression;
mod externals;
mod fields;
mod given_keys;
mod hinges;
mod idle;
mod include;
mod keys;
mod lists;
mod memory;
mod model_error;
mod names;
mod output;
mod parameters;
mod rotors;
mod schema;
mod sections;
mod shapes;
mod sources;
mod stations;
pub(crate) mod suggest;
mod surroundings;
mod tree;
mod vectors;
mod write;

use std::path::Path;

use nboom_model::{MassProperties, Scene, SceneDraft, Shapes, Structure};
use nboom_scalar::{Sym3, Vec3};

use crate::diagnostic::Report;
use crate::sampling::MOST_SAMPLES;
use crate::{InputError, SceneFile, SceneSettings};
pub use catalog::SCENE;
pub use document::{SceneDocument, ScenePart, Slot, UnknownPath};
use fields::{Fields, Reader};
use include::Parts;
pub use keys::{Holds, Key, TableKind, all_tables};
use memory::Memory;
use model_error::Responsible;
pub(crate) use names::check_body_name;
pub use names::{check_folder_name, folder_name};
use parameters::Parameters;
pub use schema::schema;
pub(crate) use sources::{Place, Sources};
pub use write::write_scene;

/// How a scene is read.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// Parameters that take the place of the scene's own values.
    pub set: Vec<(String, f64)>,
    /// Whether included files may lie outside of the scene's folder.
    pub includes_from_anywhere: bool,
    /// Whether the main body of a robot is fixed to the ground.
    pub fixed_base: bool,
}

/// Reads the text of a scene in TOML. [`SCENE`] has its tables and keys.
///
/// `file` is the file's name for messages; the scene is called `name` unless it says otherwise. Files that
/// it includes lie in `folder`; without a folder it may include none. Degrees end here: a scene has
/// radians.
///
/// # Errors
/// [`InputError::Content`] with everything that is wrong, in the order of the lines.
pub fn parse_scene(
    file: &str,
    text: &str,
    name: &str,
    folder: Option<&Path>,
    options: &ReadOptions,
) -> Result<SceneFile, InputError> {
    SceneDocument::parse((file, text), name, folder, options)?.scene(&[])
}

struct Found {
    scene: Scene,
    structure: Option<Structure>,
    settings: SceneSettings,
    /// Output times from one computation of stresses to the next.
    stress_interval: usize,
}

/// The parts of a scene, of which some may be in a memory. Wrong parts are reported; stand-ins allow checks of
/// the rest.
fn assemble(
    parts: &Parts,
    memory: Option<&Memory>,
    name: &str,
    options: &ReadOptions,
    sources: &Sources,
    report: &mut Report<'_>,
) -> Option<Found> {
    let entries: Vec<_> = parts.entries("parameters").collect();
    let parameters = Parameters::read(&entries, &options.set, sources, report);
    let are_keys_right = memory.is_some();
    let mut reader = Reader { sources, report, parameters: &parameters, are_keys_right };
    let recalled = memory.map(|memory| memory.recall(parts.root(), &parameters));
    let recalled = recalled.unwrap_or_default();
    let roots: Vec<Fields<'_>> =
        parts.iter().map(|(kind, table, at)| reader.fields(kind, table, at)).collect();
    let root = &roots[0];
    for root in &roots {
        reader.named(root, "parameters");
    }
    reader.check_set(root, &options.set);
    let name = reader.scene_name(root).unwrap_or(name);
    let (mut settings, stress_interval) = reader.settings(root);
    let scene = reader.surroundings(root, name);
    let main_body =
        root.inner("main_body").and_then(|fields| reader.shape(&fields, &scene.main_body));
    let mut materials = stations::Materials::new();
    roots.iter().for_each(|root| reader.materials(root, &mut materials));
    let tables: Vec<Fields<'_>> =
        roots.iter().flat_map(|root| reader.unchecked(root, "body")).collect();
    let body = |(i, fields): (usize, &Fields<'_>)| {
        reader.once(recalled.body(i), |reader| reader.body(fields, &materials))
    };
    let bodies = tables.iter().enumerate().map(body).collect();
    let draft = SceneDraft { scene, bodies };
    let mut responsible = Responsible { root, bodies: &tables, of_draft: Vec::new() };
    let resolved = match draft.resolve() {
        Ok(resolved) => resolved,
        Err(errors) => {
            errors.iter().for_each(|error| responsible.report_draft(&mut reader, &draft, error));
            return None;
        }
    };
    responsible.of_draft = resolved.of_draft;
    // Stand-ins for what is wrong may be wrong themselves.
    if !reader.report.errors.is_empty() {
        return None;
    }
    let shapes = Shapes { main_body, bodies: resolved.shapes };
    let description = resolved.description.clone();
    let scene = match Scene::new(description) {
        Ok(scene) => scene.with_names(resolved.names).with_shapes(shapes),
        Err(errors) => {
            let description = &resolved.description;
            errors.iter().for_each(|error| responsible.report(&mut reader, description, error));
            return None;
        }
    };
    if let Some(output) = root.inner("output") {
        settings.sampling = reader.sampling(&output, &scene);
        settings.table = reader.wanted_table(&output, &scene);
    }
    let structure = reader.once(recalled.structure, |reader| {
        responsible.structure(reader, &scene, resolved.structures)
    });
    Some(Found { scene, structure, settings, stress_interval })
}

impl Reader<'_, '_> {
    /// The scene's own name, which becomes that of a folder.
    fn scene_name<'t>(&mut self, root: &Fields<'t>) -> Option<&'t str> {
        let name = self.text(root, "name")?;
        if let Err((found, expected)) = check_folder_name(name) {
            self.error(&root.place("name"), "name", &found, expected);
        }
        Some(name)
    }

    /// What the scene says about its results, and at how many output times stresses are computed once.
    fn settings(&mut self, root: &Fields<'_>) -> (SceneSettings, usize) {
        let (units, parameters) = (self.units(root), self.parameters.all());
        let mut settings = SceneSettings { units, parameters, ..SceneSettings::default() };
        let Some(output) = self.table(root, "output") else { return (settings, 1) };
        [settings.hinge_loads, settings.listing] = self.files(&output);
        let stress_every = self.count(&output, "stress_every", MOST_SAMPLES);
        (settings, stress_every.unwrap_or(1))
    }

    /// Reports parameters on the command line that the scene does not have.
    fn check_set(&mut self, root: &Fields<'_>, set: &[(String, f64)]) {
        let at = root.place("parameters");
        for (name, value) in set {
            if self.parameters.get(name).is_none() {
                let (found, expected) = self.parameters.unknown(name);
                self.error(&at, "--set", &found, &expected);
            } else if !value.is_finite() {
                let found = format!("{name} = {value}");
                self.error(&at, "--set", &found, "a finite number");
            }
        }
    }
}

/// A body that stands for one of which something is missing.
fn any_body() -> MassProperties {
    MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0))
}
