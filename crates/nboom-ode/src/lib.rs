//! Integration of ordinary differential equations with dense output and root finding.
//!
//! A [`Stepper`] takes one step at a time and hands out, for each variable, the polynomial that
//! represents it within the step; [`Bernstein`] finds the first place where such a polynomial
//! changes sign, however often it does. A step can be taken again to any shorter length, so
//! that an event is reached by a step of its own and not by interpolation.
//!
//! This crate knows no bodies. A step allocates nothing.
//!
//! ```
//! use nboom_ode::{RungeKutta, Stepper, System, Tolerance};
//!
//! struct Oscillator;
//! impl System for Oscillator {
//!     fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
//!         (dy[0], dy[1]) = (y[1], -y[0]);
//!     }
//! }
//!
//! let mut stepper = RungeKutta::dop853(Tolerance { relative: 1e-12, absolute: 1e-12 });
//! stepper.start(&mut Oscillator, 0.0, &[1.0, 0.0], 2);
//! while stepper.window().time < 10.0 {
//!     stepper.step(&mut Oscillator, 10.0)?;
//!     stepper.advance();
//! }
//! assert!((stepper.window().state[0] - 10.0_f64.cos()).abs() < 1e-10);
//! # Ok::<(), nboom_ode::StepError>(())
//! ```

mod adams;
mod automatic;
mod bernstein;
mod error;
mod first_step;
mod gauss;
mod gauss_lanes;
mod interpolation;
mod legendre;
mod linear;
mod method;
mod radau;
mod rkam;
mod runge_kutta;
mod side_by_side;
mod stepper;
mod system;
mod tableau;
mod taylor;
mod weighted_sum;

pub use adams::Adams;
pub use automatic::Automatic;
pub use bernstein::Bernstein;
pub use error::StepError;
pub use gauss::Gauss;
pub use gauss_lanes::GaussLanes;
pub use interpolation::Interpolation;
pub use method::Method;
pub use radau::Radau;
pub use rkam::{Bound, Rkam, RkamSettings};
pub use runge_kutta::{EightSteps, RungeKutta};
pub use stepper::{Choice, Stepper, Window};
pub use system::{Counts, Pace, System, Tolerance};
pub use taylor::Taylor;
