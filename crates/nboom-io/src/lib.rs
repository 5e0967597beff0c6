//! Reads scenes in TOML, the decks of the 1970 program and robots in URDF into a checked [`Scene`].
//!
//! A scene in TOML says everything by name; [`SCENE`] lists its tables and keys. A deck is text in the
//! five groups of Table 16.1; [`SYMBOLS`] lists what may stand in them. A robot is links and joints in
//! XML, see [`parse_robot`]. Everything is checked before a scene is made, and all errors are reported at
//! once, each with file, line, column, the file's own name of the value and its line. A program says a
//! scene in the same [`words`]. Degrees end here: a scene has radians. This crate does not simulate, does
//! not write results, and computes no stresses; what stresses need is read into a [`Structure`].
//!
//! ```
//! let text = r#"
//! [run]
//! end = 10.0
//!
//! [main_body]
//! mass = 100.0
//! inertia = [40.0, 30.0, 20.0]
//!
//! [[body]]
//! name = "boom"
//! mass = 3.0
//! mass_centre = [1.0, 0.0, 0.0]
//! inertia = [0.1, 1.0, 1.0]
//!
//! [body.hinge]
//! at = [0.5, 0.0, 0.1]
//! axis = "z"
//! start_deg = 90.0
//! latch_deg = 0.0
//! spring = { stiffness = 2.0 }
//! "#;
//! let options = nboom_io::ReadOptions::default();
//! let file = nboom_io::parse_scene("boom.toml", text, "boom", None, &options)?;
//! assert_eq!(file.scene.degrees_of_freedom(), 7);
//! assert_eq!(file.scene.name_of(0), Some("boom"));
//!
//! let wrong = text.replace("stiffness", "stifness");
//! let error = nboom_io::parse_scene("boom.toml", &wrong, "boom", None, &options).unwrap_err();
//! assert!(error.to_string().contains("did you mean `stiffness`?"));
//! # Ok::<(), nboom_io::InputError>(())
//! ```
//!
//! A deck:
//!
//! ```
//! let deck = "
//!  &DIM
//!  NA=1, NP=0, IXK=1, IAB=0,
//!  &END
//!  &NXPUT
//!  EMM=100.0, HM=40.0,3*0.0,30.0,3*0.0,20.0,
//!  NK=1, DBK=0.0,0.5,0.1, FTSIK=0.0,90.0,0.0,
//!  ELIK=2.0, EMIK=3.0, HIIK=1.0,3*0.0,0.1,3*0.0,1.0, CNIK(1,2)=1.0,
//!  BETAIK=90.0, BSIK=0.0, EKNIK(1,2)=-2.0,   ! a spring closes the hinge, a latch holds it
//!  &END
//!  &ROCK
//!  TF=10.0,
//!  &END
//! ";
//! let file = nboom_io::parse_deck("boom.nml", deck, "one boom")?;
//! assert_eq!(file.scene.degrees_of_freedom(), 7);
//! assert_eq!(file.scene.bodies[0].hinge.start.angle, 90.0_f64.to_radians());
//!
//! let wrong = deck.replace("EMIK=3.0", "EMIK=-3.0");
//! let error = nboom_io::parse_deck("boom.nml", &wrong, "one boom").unwrap_err();
//! let message = "boom.nml:8:17: EMIK(1): found mass -3, expected a positive finite mass";
//! assert!(error.to_string().starts_with(message));
//! # Ok::<(), nboom_io::InputError>(())
//! ```

mod angles;
mod axes;
mod deck;
mod diagnostic;
mod error;
mod legacy;
mod responsible;
mod sampling;
mod scene;
mod source;
mod urdf;
pub mod words;

use std::io::Read;
use std::path::{Path, PathBuf};

use nboom_model::{Base, Scene, Structure, UnitSystem, WantedTable};

pub use deck::{
    Absent, DeckDefect, DeckObstacle, Extent, Group, LARGEST_COUNT, NEVER, NumberKind, Numbering,
    SYMBOLS, Symbol, WrittenDeck, parse_deck, write_deck,
};
pub use diagnostic::{Diagnostic, Excerpt};
pub use error::{BadFile, InputError};
pub use legacy::LegacySettings;
pub use sampling::{MOST_SAMPLES, Sampling, TooManyTimes};
pub use scene::suggest::nearest;
pub use scene::{
    Holds, Key, ReadOptions, SCENE, SceneDocument, ScenePart, Slot, TableKind, UnknownPath,
    all_tables, check_folder_name, folder_name, parse_scene, schema, write_scene,
};
pub use source::{Format, read_text, sha256, sha256_of};
pub use urdf::parse_robot;

/// What a file contains.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene, checked.
    pub scene: Scene,
    /// Warnings, in the order of the lines.
    pub warnings: Vec<Diagnostic>,
    /// Settings of the original's printing and integration.
    pub legacy: LegacySettings,
    /// What stresses need, when the file asks for stresses: a deck by `INSTR` above zero and its stress
    /// groups, a scene by stations.
    pub structure: Option<Structure>,
    /// What it is written in.
    pub format: Format,
    /// What a scene says about its results and parameters.
    pub settings: SceneSettings,
    /// Files that a scene includes.
    pub included: Vec<PathBuf>,
    /// SHA-256 of what was read, in hexadecimal digits.
    pub sha256: String,
}

/// What a scene in TOML says beside its motion; nothing of a deck.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneSettings {
    /// Units of its numbers.
    pub units: Option<UnitSystem>,
    /// Output times.
    pub sampling: Option<Sampling>,
    /// A table of the motion beside that of states.
    pub table: Option<WantedTable>,
    /// Whether loads of hinges are wanted.
    pub hinge_loads: bool,
    /// Whether the printout is wanted.
    pub listing: bool,
    /// Parameters with their values, by name.
    pub parameters: Vec<(String, f64)>,
}

/// Reads a scene from a file `NAME.toml`, a deck `NAME.nml` or a robot `NAME.urdf`. A deck, and a scene or
/// robot that does not say its name, is named NAME, with U+FFFD for control characters, which a terminal would obey.
///
/// Files of at most 16 MiB are read, in UTF-8; bytes that are not may occur in comments of decks only.
///
/// # Errors
/// When the file cannot be read, is neither by its name, is too long or is not text; and all errors of
/// its content, as [`parse_scene`], [`parse_deck`] and [`parse_robot`] return them.
pub fn read_scene(path: &Path) -> Result<SceneFile, InputError> {
    read_scene_with(path, &ReadOptions::default())
}

/// As [`read_scene`]; decks and robots have no parameters, and only the base of a robot can be fixed.
///
/// # Errors
/// Those of [`read_scene`], parameters that the scene does not have, and a fixed base of what is no robot.
pub fn read_scene_with(path: &Path, options: &ReadOptions) -> Result<SceneFile, InputError> {
    let (format, text, sha256) = source::read_file(path)?;
    let name = source::scene_name(path);
    let (file, folder) = (path.display().to_string(), source::folder(path));
    let scene = parse(format, (&file, &text), &name, Some(folder), options)?;
    // Of a deck with bytes that are not UTF-8 too.
    Ok(if format == Format::Nml { SceneFile { sha256, ..scene } } else { scene })
}

/// Reads a scene that is not a file; `name` is the scene's and stands for the file in messages. The
/// limit of length is that of files.
///
/// # Errors
/// Those of [`read_scene_with`] but for the name.
pub fn read_scene_from(
    reader: impl Read,
    format: Format,
    name: &str,
    options: &ReadOptions,
) -> Result<SceneFile, InputError> {
    let (text, sha256) = source::read_stream(Path::new(name), format, reader)?;
    let scene = parse(format, (name, &text), name, None, options)?;
    Ok(if format == Format::Nml { SceneFile { sha256, ..scene } } else { scene })
}

/// Reads the text of a scene, a deck or a robot. Files that a scene includes lie in `folder`.
///
/// # Errors
/// Those of [`parse_scene`], [`parse_deck`] and [`parse_robot`], parameters that are given for one of the two latter, and
/// a fixed base of one of the two former.
pub fn parse(
    format: Format,
    (file, text): (&str, &str),
    name: &str,
    folder: Option<&Path>,
    options: &ReadOptions,
) -> Result<SceneFile, InputError> {
    match format {
        Format::Toml | Format::Nml if options.fixed_base => {
            Err(InputError::NoRobot { file: file.to_owned() })
        }
        Format::Toml => parse_scene(file, text, name, folder, options),
        Format::Nml | Format::Urdf if !options.set.is_empty() => {
            Err(InputError::NoParameters { file: file.to_owned() })
        }
        Format::Nml => parse_deck(file, text, name),
        Format::Urdf => {
            let base = if options.fixed_base { Base::Fixed } else { Base::Free };
            parse_robot(file, text, name, base)
        }
    }
}
