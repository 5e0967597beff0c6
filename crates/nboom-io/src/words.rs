//! Scenes in the words of a program: as in TOML, key by key, with the same names, defaults and checks.
//!
//! A table is a function, a key a method of what it returns; [`SCENE`](crate::SCENE) and `docs/scenes.md` say what
//! each means. Angles and rates are in degrees or radians by the method's ending. Tables all of whose
//! keys must be given, [`Thrust`] and [`KickOff`], are structures.
//!
//! ```
//! use nboom_io::words::{at, body, hinge, main_body, scene, spring};
//!
//! let scene = scene("boom")
//!     .end(10.0)
//!     .main_body(main_body().mass(100.0).inertia([40.0, 30.0, 20.0]))
//!     .body(
//!         body("boom")
//!             .mass(3.0)
//!             .mass_centre([1.0, 0.0, 0.0])
//!             .inertia([0.01, 1.0, 1.0])
//!             .hinge(
//!                 hinge()
//!                     .at([0.5, 0.0, 0.0])
//!                     .axis("z")
//!                     .start_deg(90.0)
//!                     .release(at(1.0))
//!                     .latch_deg(0.0)
//!                     .spring(spring(2.0).rest_deg(-10.0)),
//!             ),
//!     )
//!     .build()?;
//! assert_eq!(scene.name_of(0), Some("boom"));
//! # Ok::<(), nboom_io::words::WordsErrors>(())
//! ```

mod body;
mod coupling;
mod direction;
mod drive;
mod error;
mod external;
mod hinge;
mod laws;
mod release;
mod rotor;
mod scene;
mod slide;
mod surroundings;
mod tables;

pub(crate) use body::tip_of;
pub use body::{BodyWords, KickOff, body};
pub use coupling::{CouplingWords, coupling};
pub use direction::{Axes, Direction};
pub(crate) use drive::along as prescribed;
pub use drive::{DriveWords, drive};
pub use error::{WordsError, WordsErrors};
pub(crate) use external::table as external_table;
pub use external::{ExternalWords, thruster, torque};
pub(crate) use hinge::joint;
pub use hinge::{HingeWords, hinge};
pub use laws::{DamperWords, SpringWords, damper, spring};
pub use release::{After, When, after, at, when};
pub use rotor::{RotorWords, rotor};
pub use scene::{SceneWords, scene};
pub use slide::{SlideWords, slide};
pub use surroundings::{Inertia, InitialWords, MainBodyWords, Thrust, initial, main_body};
