//! The NAMELIST deck: text to tokens to values to a scene.

mod assignment;
mod builder;
mod group;
mod hinges;
mod ignored;
mod layout;
mod lexer;
mod model_error;
mod motion;
mod names;
mod number;
mod required;
mod section;
mod settings;
mod stress;
mod symbols;
mod values;
mod write;

use nboom_model::{Scene, Structure};

use crate::diagnostic::Report;
use crate::source::sha256;
use crate::{Format, InputError, SceneFile, SceneSettings};
use builder::Builder;
use values::{Sizes, Values};

pub use hinges::NEVER;
pub(crate) use nboom_model::shown;
pub use symbols::{Absent, Extent, Group, NumberKind, Numbering, SYMBOLS, Symbol};
pub use values::LARGEST_COUNT;
pub use write::{DeckDefect, DeckObstacle, WrittenDeck, write_deck};

/// Reads the text of a deck, Table 16.1 and Section 17.
///
/// `file` is the file's name for messages, `name` becomes the name of the scene. [`SYMBOLS`] has
/// the symbols, and what their absence means; angles become radians.
///
/// # Errors
/// [`InputError::Content`] with everything that is wrong, in the order of the lines.
pub fn parse_deck(file: &str, text: &str, name: &str) -> Result<SceneFile, InputError> {
    let mut report = Report::new(file);
    let sha256 = sha256(text.as_bytes());
    // Old machines end cards in a carriage return alone.
    let text = &text.replace("\r\n", "\n").replace('\r', "\n");
    let values = group::read(text, &mut report);
    required::check(&values, &mut report);
    let parts = values.sizes.and_then(|sizes| assemble(name, &values, sizes, &mut report));
    report.sort();
    report.add_excerpts(text);
    match parts {
        Some((scene, legacy, structure)) if report.errors.is_empty() => Ok(SceneFile {
            scene,
            warnings: report.warnings,
            legacy,
            structure,
            format: Format::Nml,
            settings: SceneSettings::default(),
            included: Vec::new(),
            sha256,
        }),
        _ => Err(InputError::Content(report.errors)),
    }
}

type Parts = (Scene, crate::LegacySettings, Option<Structure>);

/// The parts of a scene. Wrong parts are reported; stand-ins allow checks of the rest.
fn assemble(name: &str, values: &Values, sizes: Sizes, report: &mut Report<'_>) -> Option<Parts> {
    let mut builder = Builder { values, sizes, report, structures: None };
    let legacy = builder.settings();
    builder.structures = builder.stress();
    let description = builder.description(name);
    builder.warn_ignored_of_hinges();
    match Scene::new(description) {
        Ok(scene) => {
            let structure = builder.structure(&scene);
            Some((scene, legacy, structure))
        }
        Err(errors) => {
            model_error::report(&errors, &mut builder);
            None
        }
    }
}
