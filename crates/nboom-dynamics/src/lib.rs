//! Equations of motion of any tree, by recursion over its bodies.
//!
//! [`Recursive`] gives accelerations (articulated bodies), the mass matrix (composite bodies)
//! and bias, momenta and their rates, the velocity jump of lock-ups and impacts, and the conserved
//! quantities. Hinges that are held are not in the computation at all: when the mode is set, the
//! bodies they join are merged into one.
//!
//! All vectors are along the main-body axes. The motion of O never enters: accelerations are
//! those of a scene whose O is at rest at the inertial origin, without gravity, and uniform
//! gravity only shifts the acceleration of O. See `docs/equations.md`.
//!
//! ```
//! use nboom_dynamics::{Accelerations, Motion, Recursive};
//! use nboom_model::{Appendage, Hinge, MassProperties, Mode, Mount, Scene, SceneDescription, Segment};
//! use nboom_scalar::{Sym3, Vec3};
//!
//! let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
//! let boom = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
//! let mut description = SceneDescription::at_rest("one boom", hub, 10.0);
//! let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }];
//! description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
//! let scene = Scene::new(description).expect("the bodies are physical");
//!
//! let mut dynamics = Recursive::<f64>::new(&scene);
//! dynamics.set_mode(&Mode::at_start(&scene), &[0.3]);
//! let mut found = Accelerations::for_hinges(1);
//! let motion = Motion { omega_body: Vec3::new(2.0, 0.1, 0.0), beta: &[0.3], tau: &[-0.5] };
//! dynamics.accelerations(&motion, &mut found);
//! assert!(found.tau_dot[0].is_finite());
//! ```

mod articulated_body;
mod base;
mod composite_body;
mod impulse;
mod invariants;
mod ldl;
mod momenta;
mod outside;
mod pose;
mod reaction;
mod recursive;
mod rotors;
mod singularity;

pub use impulse::{ImpulseError, Impulses, Struck, VelocityJump};
pub use invariants::{Invariants, LineCircle, LineLength};
pub use momenta::{EffectiveInertias, Momenta};
pub use outside::FromOutside;
pub use recursive::{Accelerations, Motion, Recursive};
pub use singularity::Singularity;
