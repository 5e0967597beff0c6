//! Numbers and 3-vectors that every equation of nboom is written over.
//!
//! An equation is written once over [`Real`] and then runs on `f64`, or on any other scalar
//! that implements the trait. The operations of [`Vec3`], [`Mat3`] and [`Sym3`] are spelled
//! out in one fixed order, so that the same source gives the same roundings wherever it runs.
//!
//! This crate knows no scenes and no units.
//!
//! ```
//! use nboom_scalar::{Mat3, Vec3};
//! let quarter_turn = Mat3::about_x(std::f64::consts::FRAC_PI_2);
//! let turned = quarter_turn * Vec3::new(0.0, 1.0, 0.0);
//! assert!((turned - Vec3::new(0.0, 0.0, 1.0)).norm() < 1e-15);
//! ```

mod batch;
mod code;
mod compiled;
mod derivatives;
mod double_double;
mod dual;
mod foreign;
#[cfg(target_arch = "x86_64")]
mod fused;
mod instructions;
mod isa;
mod jacobian;
mod kernel;
mod lanes;
mod matrix;
mod pair;
mod quaternion;
mod real;
mod routine;
mod sine;
mod spatial;
mod symmetric;
mod vector;
#[cfg(target_arch = "x86_64")]
mod wide;

pub use batch::{Batch, Eight};
pub use compiled::{
    Compiled, EightNumbers, EightStates, OneState, Work, WorkOnEight, in_registers,
    in_vector_registers, vectorised,
};
pub use derivatives::{Derivatives, TreeJoint, TreeLink, TreeMount};
pub use double_double::DoubleDouble;
pub use dual::Dual;
pub use foreign::{ForeignError, ForeignTable};
#[cfg(target_arch = "x86_64")]
pub(crate) use fused::Fused;
pub use instructions::InstructionSet;
pub use isa::Isa;
#[cfg(target_arch = "x86_64")]
pub(crate) use isa::{Avx2, Avx512};
pub use jacobian::jacobian;
pub use kernel::{Kernel, Numbers, RoutineOn};
pub use lanes::{Pack, Several};
pub use matrix::Mat3;
pub(crate) use pair::Pair;
pub use quaternion::Quaternion;
pub use real::{Number, Real};
pub use routine::{CONTRACT, Routine, assumed};
pub use spatial::{ArticulatedInertia, RigidInertia, Twist, Wrench};
pub use symmetric::Sym3;
pub use vector::Vec3;
#[cfg(target_arch = "x86_64")]
pub(crate) use wide::{Avx4, Avx8, AvxHalf, TwoAvx4};
