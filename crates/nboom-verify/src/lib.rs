//! Compares and certifies code that computes accelerations, and times whole runs with it.
//!
//! A [`TestCase`] is a scene with all hinges free or some held, and random states of it. [`compare`]
//! takes all code that covers it, the recursion, the factored mass matrix, the closed forms and
//! generated routines, through these states; [`certify`] does so with any one code. Both measure twice: against the recursion in
//! `f64`, and against the recursion in double-double, which has 32 digits and stands for the
//! truth. The latter tells the error of the recursion itself too.
//!
//! Deviations are relative. See [`Quantity`] for what they are relative to.
//!
//! [`WorkPrecision`] runs a scene with all code, all integrators and tolerances, and sets run time
//! against error.
//!
//! ```
//! use nboom_model::{Appendage, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment};
//! use nboom_scalar::{Sym3, Vec3};
//! use nboom_verify::{TestCase, certify, compare};
//!
//! let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
//! let boom = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
//! let mut description = SceneDescription::at_rest("one boom", hub, 10.0);
//! let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }];
//! description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
//! let scene = Scene::new(description).expect("the bodies are physical");
//!
//! let held = TestCase::with_held_hinges(&scene, 10, 1970)?;
//! let test_case = TestCase::new(scene, 20, 1970)?;
//! let comparison = compare(&test_case, &held, &[], &[], 1e-11)?;
//! assert!(comparison.passed());
//!
//! let mut code = test_case.recursion();
//! let certificate = certify(&test_case, |i| code.accelerations(i))?;
//! assert_eq!(certificate.from_recursion, 0.0);
//! assert!(certificate.from_double_double < 1e-13);
//! # Ok::<(), nboom_verify::VerifyError>(())
//! ```

mod certificate;
mod code;
mod comparison;
mod condition;
mod dense;
mod equations;
mod error;
mod floor;
mod label;
mod plot;
mod random;
mod random_state;
mod reference;
mod test_case;
mod work_precision;

pub use certificate::{Certificate, Truth, certify, certify_equations, drives, truth};
pub use code::ComparedCode;
pub use comparison::{Comparison, Row, compare, compare_unless};
pub use dense::Dense;
pub use error::VerifyError;
pub use floor::Floor;
pub use label::{Hinges, Label, Quantity};
pub use random_state::RandomState;
pub use reference::{allowance, of_largest};
pub use test_case::{NotCovered, TestCase};
pub use work_precision::{TimedRun, WorkPrecision};
