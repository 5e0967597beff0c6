//! Reads the input of the 1970 program, its NAMELIST decks, into a checked [`Scene`].
//!
//! A deck is text in the five groups of Table 16.1; [`SYMBOLS`] lists what may stand in them.
//! Everything is checked before a scene is made, and all errors are reported at once, each with
//! file, line, column and the deck's own symbol. Degrees end here: a scene has radians. This crate
//! does not simulate, does not write results, and computes no stresses; the stress groups are read
//! into a [`Structure`].
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
//! assert_eq!(
//!     error.to_string(),
//!     "boom.nml:8:17: EMIK(1): found mass -3, expected a positive finite mass"
//! );
//! # Ok::<(), nboom_io::InputError>(())
//! ```

mod deck;
mod diagnostic;
mod error;
mod legacy;
mod source;

use std::io::Read;
use std::path::Path;

use nboom_model::{Scene, Structure};

pub use deck::{
    Absent, Extent, Group, LARGEST_COUNT, NEVER, NumberKind, Numbering, SYMBOLS, Symbol, parse_deck,
};
pub use diagnostic::Diagnostic;
pub use error::InputError;
pub use legacy::LegacySettings;
pub use source::read_text;

/// What a file contains.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene, checked.
    pub scene: Scene,
    /// Warnings, in the order of the lines.
    pub warnings: Vec<Diagnostic>,
    /// Settings of the original's printing and integration.
    pub legacy: LegacySettings,
    /// What the stress groups say, when the deck asks for stresses (`INSTR` above zero) and has
    /// the groups.
    pub structure: Option<Structure>,
    /// SHA-256 of what was read, in hexadecimal digits.
    pub sha256: String,
}

/// Reads a scene from a deck `NAME.nml`; the scene is named NAME, with U+FFFD for control
/// characters, which a terminal would obey.
///
/// Files of at most 16 MiB are read; bytes that are not UTF-8 may occur in comments only.
///
/// # Errors
/// When the file cannot be read, is not a deck by its name, is too long or is not text; and all
/// errors of the deck itself, as [`parse_deck`] returns them.
pub fn read_scene(path: &Path) -> Result<SceneFile, InputError> {
    let (text, sha256) = source::read_deck(path)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = name.replace(char::is_control, "\u{fffd}");
    Ok(SceneFile { sha256, ..parse_deck(&path.display().to_string(), &text, &name)? })
}

/// Reads a scene from a deck that is not a file; `name` is the scene's and stands for the file in
/// messages. The limit of length is that of files.
///
/// # Errors
/// Those of [`read_scene`] but for the name.
pub fn read_scene_from(reader: impl Read, name: &str) -> Result<SceneFile, InputError> {
    let (text, sha256) = source::read_stream(Path::new(name), reader)?;
    Ok(SceneFile { sha256, ..parse_deck(name, &text, name)? })
}
