//! Force laws of Section 6, one file each, over any scalar.
//!
//! A law turns positions and rates into a force or torque and, where it is conservative, into
//! a potential energy. Whether it acts is a bit of [`nboom_model::Mode`], never an `if` here.
//!
//! ```
//! use nboom_elements::HingeLaw;
//! use nboom_model::{Dashpot, Spring};
//! let spring = Spring { quadratic: 0.0, linear: -0.4, preload_angle: -0.35 };
//! let law = HingeLaw::<f64>::new(&spring, &Dashpot::default());
//! assert!((law.torque(1.57, 0.0) - -0.4 * (1.57 - 0.35)).abs() < 1e-15);
//! ```

mod hinge_law;
mod kick_off;

pub use hinge_law::HingeLaw;
pub use kick_off::KickOffLaw;
