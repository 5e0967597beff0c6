use std::fmt;

use nboom_model::HingeLabel;
use nboom_scalar::{Vec3, Wrench};
use nboom_sections::PointStress;
use nboom_sim::EventKind;

use crate::Margins;
use crate::formulas::Formulas;

/// What causes a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// The motion alone.
    Motion,
    /// Pulses of latches and stops, in addition to the motion.
    Pulse {
        /// The hinge whose pulse has the largest share, as numbered in the scene.
        hinge: usize,
        /// A lock-up or an impact.
        kind: EventKind,
        /// Its share: the component along the total of the stress or load of its pulse, over the
        /// total. The shares of all pulses and of the motion add up to 1.
        share: f64,
    },
}

/// A component of the load on the part outboard of a station, segment axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// P_ξ.
    ForceXi,
    /// P_η.
    ForceEta,
    /// P_ζ.
    ForceZeta,
    /// Q_ξ.
    MomentXi,
    /// Q_η.
    MomentEta,
    /// Q_ζ.
    MomentZeta,
}

impl Component {
    const ALL: [Self; 6] = [
        Self::ForceXi,
        Self::ForceEta,
        Self::ForceZeta,
        Self::MomentXi,
        Self::MomentEta,
        Self::MomentZeta,
    ];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::ForceXi => "p_xi",
            Self::ForceEta => "p_eta",
            Self::ForceZeta => "p_zeta",
            Self::MomentXi => "q_xi",
            Self::MomentEta => "q_eta",
            Self::MomentZeta => "q_zeta",
        }
    }

    /// This component of a load alone.
    fn of(self, load: &Wrench<f64>) -> Wrench<f64> {
        let Wrench { force: p, moment: q } = *load;
        let zero = Vec3::zero();
        let (force, moment) = match self {
            Self::ForceXi => (Vec3::unit_x() * p.x, zero),
            Self::ForceEta => (Vec3::unit_y() * p.y, zero),
            Self::ForceZeta => (Vec3::unit_z() * p.z, zero),
            Self::MomentXi => (zero, Vec3::unit_x() * q.x),
            Self::MomentEta => (zero, Vec3::unit_y() * q.y),
            Self::MomentZeta => (zero, Vec3::unit_z() * q.z),
        };
        Wrench { force, moment }
    }
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The worst stress of a station.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// The segment.
    pub segment: HingeLabel,
    /// The station, from 0, outboard ones first.
    pub station: usize,
    /// When.
    pub time: f64,
    /// Why.
    pub cause: Cause,
    /// Force and moment on the part outboard of the station, about the point on the η axis, segment
    /// axes; while pulses last the sum over the motion and the pulses.
    pub load: Wrench<f64>,
    /// Where the von Mises stress is largest, and the stress there.
    pub max_von_mises: PointStress,
    /// The component of the load that alone makes the largest von Mises stress at that point;
    /// `None` for a station without load, whose stress is at most the rounding of the worst one.
    pub driver: Option<Component>,
    /// What is left of the strength there; nothing for a station without load.
    pub margins: Margins,
}

/// The largest force or moment of a hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct WorstHingeLoad {
    /// The hinge.
    pub hinge: HingeLabel,
    /// The quantity whose magnitude is largest.
    pub quantity: HingeQuantity,
    /// When.
    pub time: f64,
    /// Why.
    pub cause: Cause,
    /// Force and moment that the hinge then exerts on its outboard body, about the hinge point,
    /// segment axes.
    pub load: Wrench<f64>,
}

impl WorstHingeLoad {
    /// The magnitude of the force or moment.
    pub fn magnitude(&self) -> f64 {
        match self.quantity {
            HingeQuantity::Force => self.load.force.norm(),
            HingeQuantity::Moment => self.load.moment.norm(),
        }
    }
}

/// Force or moment of a hinge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HingeQuantity {
    /// P.
    Force,
    /// Q.
    Moment,
}

impl HingeQuantity {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Force, Self::Moment];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Force => "force",
            Self::Moment => "moment",
        }
    }
}

/// Impulses that all hinges transmit when one of them locks or presses against its stop.
#[derive(Clone, Debug, PartialEq)]
pub struct LatchImpulses {
    /// The hinge with the latch or the stop, as numbered in the scene.
    pub hinge: usize,
    /// For each hinge, force and moment on its outboard body, integrated over the pulse, about the
    /// hinge point, segment axes \[FT, FLT\].
    pub hinges: Vec<Wrench<f64>>,
}

/// The component that alone makes the largest von Mises stress at a point of a section.
pub(crate) fn driver(section: &Formulas, load: &Wrench<f64>, at: &PointStress) -> Component {
    let alone = |component: &Component| section.at(at, &component.of(load)).von_mises();
    let larger = |a: &Component, b: &Component| alone(a).total_cmp(&alone(b));
    Component::ALL.into_iter().max_by(larger).unwrap_or(Component::ForceXi)
}
