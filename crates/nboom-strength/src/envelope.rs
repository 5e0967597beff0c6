use std::fmt;

use nboom_model::HingeLabel;
use nboom_scalar::{Vec3, Wrench};
use nboom_sections::PointStress;

use crate::formulas::Formulas;

/// What made a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The motion at an output time, or on one side of an instant with events.
    Motion,
    /// A lock-up, of this hinge and maybe others.
    LockUp {
        /// As numbered in the scene.
        hinge: usize,
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

/// The worst that a station has seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// The segment.
    pub segment: HingeLabel,
    /// The station, from 0, outboard ones first.
    pub station: usize,
    /// When.
    pub time: f64,
    /// Why.
    pub cause: Cause,
    /// Force and moment on the part outboard of the station, about the point on the η axis,
    /// segment axes; at a lock-up the sum of what the motion and the pulses make.
    pub load: Wrench<f64>,
    /// Where the von Mises stress is largest, and the stress there.
    pub severest: PointStress,
    /// The component of the load that alone makes the largest von Mises stress at that point.
    pub driver: Component,
    /// Share of the strength that is left there, if a yield stress is known.
    pub margin: Option<f64>,
}

/// The component that alone makes the largest von Mises stress at a point of a section.
pub(crate) fn driver(section: &Formulas, load: &Wrench<f64>, at: &PointStress) -> Component {
    let alone = |component: &Component| section.at(at, &component.of(load)).von_mises();
    let larger = |a: &Component, b: &Component| alone(a).total_cmp(&alone(b));
    Component::ALL.into_iter().max_by(larger).unwrap_or(Component::ForceXi)
}
