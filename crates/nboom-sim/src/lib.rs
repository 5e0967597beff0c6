//! Runs a scene: integrates the equations of one mode, finds the next instant at which
//! something changes, changes the mode there, and goes on.
//!
//! Events are located by root finding on the dense output of each step and reached by a step
//! of their own; everything that falls into one instant is taken together, impulses of
//! all lock-ups and then of all stops jointly. The translation of the system mass centre is not integrated but known in
//! closed form, unless the thrust is on.
//!
//! A program may bring a control law that is asked at a sample rate ([`Control`]) and hinge laws of its
//! own ([`OwnLaw`]), and look at the motion of each body ([`Snapshot::bodies`]).
//!
//! Files, clocks and terminals are other crates' business; see [`Recorder`].
//!
//! ```
//! use nboom_model::{MassProperties, Scene, SceneDescription};
//! use nboom_scalar::{Sym3, Vec3};
//! use nboom_sim::{Options, Recorder, Snapshot, simulate};
//!
//! struct LastRate(Vec3<f64>);
//! impl Recorder for LastRate {
//!     fn sample(&mut self, snapshot: &Snapshot) -> std::io::Result<()> {
//!         self.0 = snapshot.omega_body;
//!         Ok(())
//!     }
//! }
//!
//! let top = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 2.0, 2.0));
//! let mut description = SceneDescription::at_rest("a symmetric top", top, 2.0);
//! description.initial.omega_body = Vec3::new(1.0, 0.1, 0.0);
//! let scene = Scene::new(description).expect("a physical body");
//! let mut last = LastRate(Vec3::zero());
//! simulate(&scene, &Options::default(), &mut last)?;
//! // Its transverse rate turns at (1 - 1/2) of the spin, one radian in two time units.
//! assert!((last.0.y - 0.1 * 1.0_f64.cos()).abs() < 1e-9);
//! # Ok::<(), nboom_sim::Failure>(())
//! ```

mod certify;
mod code;
mod equations;
mod error;
mod events;
mod lanes;
mod options;
mod run;

pub use certify::scales::{Scales, natural};
pub use certify::trust::{Digits, EventTrust, Reference, Trust, Witness, differences, trust};
pub use code::closed_form::NotCovered;
pub use code::fit::{Fit, Repertoire, SharedRepertoire};
pub use code::generated::{NoRoutine, Unmet};
pub use code::selection::{CodeOfRun, Selection};
pub use equations::totals::Totals;
pub use error::{Feeds, Runaway, SimError};
pub use events::event::{Event, EventKind, Jump};
pub use events::pieces::{set_pieces_at_motion, set_pieces_at_time};
pub use lanes::{Lanes, Task};
pub use nboom_elements::{Commands, OwnLaw};
pub use nboom_ode::{Bound, Choice, Method, RkamSettings, Tolerance};
pub use options::{Form, IdleChoice, OptionError, Options, Path};
pub use run::account::Account;
pub use run::beforehand::check_start;
pub use run::bodies::BodyMotion;
pub use run::conservation::{Conservation, PoorConservation};
pub use run::control::Control;
pub use run::output_times::OutputTimes;
pub use run::record::{
    Detail, Failure, InstantMotion, Integration, Nobody, Recorder, Side, Snapshot, Summary,
};
pub use run::step_motion::{MotionAt, StepMotion};
pub use run::verdict::{Doubt, HingeImpulse, HingeVerdict, Miss, Verdict};
pub use run::{Simulator, simulate};
