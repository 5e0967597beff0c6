//! What curves are called and how they are read: in the page as in figures for documents.

use serde::Serialize;

use crate::{Run, SpinAxis};

/// A curve by its name and the column it shows.
pub type Captioned = (&'static str, &'static str);

const ENERGIES: [Captioned; 6] = [
    ("kinetic energy", "kinetic_energy"),
    ("potential energy", "potential_energy"),
    ("work of dashpots and friction", "dashpot_work"),
    ("work of thrust", "thrust_work"),
    ("work of motors", "motor_work"),
    ("taken by lock-ups and impacts", "lock_up_loss"),
];

const LAWS: [Captioned; 3] = [
    ("linear momentum", "residual_linear_momentum"),
    ("angular momentum", "residual_angular_momentum"),
    ("energy", "residual_energy"),
];

/// Captions of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Captions {
    /// The curves of energy, in columns of `ledger.csv`.
    pub energies: [Captioned; 6],
    /// The curves of the conservation laws, likewise.
    pub laws: [Captioned; 3],
    /// Below the energies.
    pub energy: &'static str,
    /// Below the residuals.
    pub residuals: &'static str,
    /// Below the nutation.
    pub nutation: &'static str,
    /// Below the speeds of rotors.
    pub rotor_speeds: &'static str,
    /// Below what is known at output times alone: torques of motors, and what a test rig bears.
    pub on_request: &'static str,
    /// Below the stresses.
    pub stresses: &'static str,
    /// What the dots of a figure of loads are.
    pub dots: &'static str,
}

impl Run {
    /// What its curves are called, and how they are read.
    pub fn captions(&self) -> Captions {
        Captions {
            energies: ENERGIES,
            laws: LAWS,
            energy: "What kinetic and potential energy gain and impulses take is the work done. Lines join output \
                     times.",
            residuals: "What momentum and energy are off by after all impulses and all work, relative. Zeros have no \
                        place.",
            nutation: match self.spin_axis() {
                SpinAxis::X => {
                    "Angle between the angular momentum and the x axis of the main body."
                }
                SpinAxis::Y => {
                    "Angle between the angular momentum and the y axis of the main body; tables have that to x."
                }
                SpinAxis::Z => {
                    "Angle between the angular momentum and the z axis of the main body; tables have that to x."
                }
            },
            rotor_speeds: if self.rotor_speeds.is_some() {
                "Speeds are relative to the bodies, as the scene commands them; a program's control law is not in them."
            } else {
                "Speeds are relative to the bodies, at output times."
            },
            on_request: "At output times; peaks between them are not seen.",
            stresses: "Of the worst station of each segment.",
            dots: if self.has_pulses() {
                "Dots: the largest of the whole motion, with the pulses of latches and stops, which curves do not show."
            } else {
                "Dots: the largest of the whole motion, without pulses of latches and stops, which need pulse_constant of each body they act on."
            },
        }
    }

    /// Whether loads have the pulses of all hinges that latch or have stops, as the summary says.
    fn has_pulses(&self) -> bool {
        self.summary.as_ref().is_none_or(|keys| keys["latch_pulses"] != false)
    }
}
