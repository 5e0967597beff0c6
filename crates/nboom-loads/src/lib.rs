//! Section loads of hinged bodies from their rigid motion, Section 10 of the report, corrected.
//!
//! [`Loads`] finds the force and moment on whatever is outboard of a station or hinge: the rates
//! of change of its momenta less the other forces on it. It takes the motion as it is given and
//! solves no equations. A lock-up or an impact is the same with jumps of velocity in place of accelerations.
//!
//! Everything is along segment axes (ξ, η, ζ): those of the body the station or hinge belongs
//! to. See `docs/loads.md`.
//!
//! ```
//! use nboom_loads::{Loads, SceneMotion, VelocityChange};
//! use nboom_model::{Appendage, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment};
//! use nboom_scalar::{Sym3, Vec3};
//!
//! let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
//! let boom = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
//! let mut description = SceneDescription::at_rest("one boom", hub, 10.0);
//! let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }];
//! description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
//! let scene = Scene::new(description).expect("the bodies are physical");
//!
//! let mut loads = Loads::new(&scene, None);
//! let mut found = loads.load_set();
//! let steady = VelocityChange { origin_body: Vec3::zero(), omega_body: Vec3::zero(), tau: &[0.0] };
//! let spin = SceneMotion {
//!     omega_body: Vec3::unit_z() * 2.0,
//!     beta: &[0.0],
//!     tau: &[0.0],
//!     acceleration: steady,
//!     force_densities: &[0.0],
//!     outside: &[],
//!     rotors: &[],
//! };
//! loads.continuous(&spin, &mut found);
//! // The hinge pulls the boom, whose mass centre turns at a radius of 2, inward: m ω² r.
//! assert_eq!(found.hinge(0).force.to_array(), [0.0, -3.0 * 4.0 * 2.0, 0.0]);
//! ```

mod equations;
mod generated;
mod handed_on;
mod load_set;
mod loads;
mod motion;
mod segment;

pub use equations::LoadEquations;
pub use generated::RESULT;
pub use load_set::LoadSet;
pub use loads::Loads;
pub use motion::{LockUpShare, MotionSize, SceneMotion, VelocityChange};
pub use segment::Influence;
