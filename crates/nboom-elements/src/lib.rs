//! The forces of Section 6: force elements, one file each, over any scalar.
//!
//! An element turns positions and rates into a torque about a hinge, a force along a line between
//! two bodies ([`Line`]) or a wrench on the main body, and where it is conservative into a potential
//! energy. [`Elements`] has all that act in one mode; whoever computes a motion, its energy or its
//! loads goes through these by what they act on and knows none by name.
//!
//! No law branches on a value: where it has several pieces ([`Switched`]), the one that holds is in
//! [`nboom_model::Mode`], and an element tells where it ends and what that is called ([`Kind`]).
//!
//! ```
//! use nboom_elements::HingeLaw;
//! use nboom_model::{Dashpot, Spring};
//! let spring = Spring { quadratic: 0.0, linear: -0.4, preload_angle: -0.35 };
//! let law = HingeLaw::<f64>::new(&spring, &Dashpot::default());
//! assert!((law.torque(1.57, 0.0) - -0.4 * (1.57 - 0.35)).abs() < 1e-15);
//! ```

mod elements;
mod line;
mod names;
mod switched;

pub use elements::*;
pub use line::{Ends, Line, LineReading, Placed};
pub use names::{EventName, LineNames, Names};
pub use switched::{Coordinate, ElementId, Switched};
