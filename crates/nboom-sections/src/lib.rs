//! Thin-walled closed cross sections: their properties, and their stresses under a load.
//!
//! A [`Section`] is a circular [`Tube`] or a [`Polygon`] with one cell. From a load, a
//! [`Wrench`](nboom_scalar::Wrench) on the part outboard of the section, follow the normal and shear
//! stress everywhere, the stresses at the four axis points of the report, and the point at which the
//! von Mises stress is largest: the true maximum, from the roots of a derivative. Stresses are those
//! of a beam in Saint-Venant's sense, on the middle line of the walls. Loads are not computed here;
//! solid sections, open ones and those with several cells are not covered, nor are buckling and
//! restrained warping. `docs/sections.md` has the formulas.
//!
//! Axes are those of a segment: ξ and ζ in the plane of the section, η outward from the inboard
//! hinge, which is the origin of ξ and ζ. Units are any consistent set.
//!
//! ```
//! use nboom_scalar::{Vec3, Wrench};
//! use nboom_sections::{Point, Polygon, Section};
//!
//! let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
//! let corners: Vec<Point> = corners.iter().map(|&(xi, zeta)| Point { xi, zeta }).collect();
//! let section = Section::Polygon(Polygon::new(&corners, &[0.02; 4]).map_err(|all| all[0].clone())?);
//! assert!((section.properties().torsion_constant - 0.16).abs() < 1e-15);
//!
//! let torsion = Wrench { force: Vec3::zero(), moment: Vec3::new(0.0, 50.0, 0.0) };
//! // Bredt: the shear stress is M / (2 A t).
//! let shear = section.stresses(&torsion).max_von_mises().stress.shear();
//! assert!((shear - 50.0 / (2.0 * 4.0 * 0.02)).abs() < 1e-10);
//! # Ok::<(), nboom_sections::SectionError>(())
//! ```

mod error;
mod harmonics;
mod max_von_mises;
mod ordinates;
mod outline;
mod point;
mod polygon;
mod polynomial;
mod properties;
pub mod report;
mod section;
mod shear_flow;
mod stress;
mod tube;
mod wall;

pub use error::{SectionError, SectionWarning};
pub use point::Point;
pub use polygon::{Polygon, PolygonStresses};
pub use properties::{Properties, SecondMoments};
pub use section::{AtStation, Section, SectionStresses};
pub use stress::{PointStress, Stress};
pub use tube::{Annulus, Tube, TubeStresses};
pub use wall::{Wall, WallStress};
