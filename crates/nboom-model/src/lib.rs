//! What the user described: a rooted tree of rigid bodies joined by one-axis hinges.
//!
//! A [`SceneDescription`] is plain data; [`Scene::new`] checks it and is the only way to a
//! [`Scene`], so whatever holds a scene need not check it again. The report's regular and
//! paddle appendages ([`Appendage`]) are two ways to write bodies of such a tree.
//!
//! A [`Structure`] says where along the bodies loads are wanted, and of what sections they are.
//!
//! Angles are radians; every other unit is the scene's own consistent set. This crate reads
//! no files and solves no equations.
//!
//! ```
//! use nboom_model::{Appendage, Hinge, MassProperties, Mount, SceneDescription, Scene, Segment};
//! use nboom_scalar::{Sym3, Vec3};
//!
//! let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
//! let boom = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
//! let mut description = SceneDescription::at_rest("one boom", hub, 10.0);
//! description.attach(&Appendage::Regular {
//!     mount: Mount::at(Vec3::new(0.0, 0.5, 0.1)),
//!     segments: vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }],
//! });
//! let scene = Scene::new(description).expect("the bodies are physical");
//! assert_eq!(scene.degrees_of_freedom(), 7);
//! ```

mod appendage;
mod base;
mod check;
mod column;
mod coupling;
mod departures;
mod draft;
mod environment;
mod error;
mod errors;
mod external;
mod finding;
mod hinge;
mod joint;
mod label;
mod limb;
mod mass;
mod material;
mod mode;
mod over_time;
mod posture;
mod quantity;
mod rotor;
mod scene;
mod shape;
mod shown;
mod skipped;
mod stops;
mod structure;
mod structure_error;
mod topology;
mod torque_table;
mod units;
mod visible;
mod warning;
mod welded;

pub use appendage::{Appendage, Segment};
pub use base::{Base, Drive, DrivePoint};
pub use column::{Column, UnknownColumn, WantedTable};
pub use coupling::Coupling;
pub use departures::{Departures, TurnOrder, TurnedInertia, Withheld};
pub use draft::{
    BodyDraft, CouplingDraft, DraftDefect, DraftError, MAIN_BODY_NAMES, MOST_BODIES, ReleaseDraft,
    Repeat, Resolved, SceneDraft,
};
pub use environment::{Gravity, InitialMotion};
pub use error::{BaseQuantity, BodyName, HingeQuantity, ModelError, SceneQuantity, UnitQuantity};
pub use errors::Errors;
pub use external::{Course, External, ExternalAxes, ExternalKind, ExternalPart};
pub use finding::Finding;
pub use hinge::{
    Dashpot, Hinge, HingeStart, HingeState, KickOffSpring, Mount, Release, SAME_ANGLE, Spring,
};
pub use joint::Joint;
pub use label::HingeLabel;
pub use limb::{EqualParts, Limb, LimbJoint, LimbLink};
pub use mass::{MassDefect, MassProperties, TRIANGLE_TOLERANCE};
pub use material::{Material, MaterialDefect};
pub use mode::Mode;
pub use posture::{HingePlace, Posture};
pub use quantity::Quantity;
pub use rotor::{Rotor, RotorMotion, RotorPart, RotorSpeed, Spin};
pub use scene::*;
pub use shape::{BodyShape, Shapes, Solid};
pub use shown::shown;
pub use skipped::skipped;
pub use stops::{Stop, Stops};
pub use structure::{SLICE_TOLERANCE, SectionShape, SegmentStructure, Station, Structure, Vertex};
pub use structure_error::{StructureDefect, StructureError, StructurePlace};
pub use topology::{Shape, Topology, TopologyError};
pub use torque_table::TorqueTable;
pub use units::UnitSystem;
pub use visible::{steers, visible};
pub use warning::ModelWarning;
pub use welded::{Link, LinkRotor, Member, WeldedTree};
