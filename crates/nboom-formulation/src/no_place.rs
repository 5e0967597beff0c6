use std::fmt;

use nboom_model::Scene;

use crate::right_side::RightSideLayout;

/// What acts on a satellite that a right side has no place for, by its number in the scene, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPlace {
    /// A coupling that acts on one hinge alone, couples hinges of which neither is next inboard of the other, or
    /// is not the only one of its hinges.
    Coupling {
        /// Its hinges.
        hinges: [usize; 2],
    },
    /// A rotor on a hinged link, or one that changes its speed.
    Rotor {
        /// Which one.
        rotor: usize,
    },
    /// Something from outside that acts on a hinged link, or is not constant along main-body axes.
    External {
        /// Which force or torque.
        external: usize,
    },
    /// A line on a link that has [`RightSideLayout::LINES_OF_LINK`] others.
    Lines {
        /// The hinge of the body that it pushes.
        hinge: usize,
    },
    /// A line that does not transmit all of its moment.
    Withheld {
        /// The hinge of the body that it pushes.
        hinge: usize,
    },
    /// Friction, which acts otherwise when motion turns.
    Friction {
        /// The hinge.
        hinge: usize,
    },
}

impl NoPlace {
    /// Which of the scene it is: its body or hinges, and when it acts.
    pub fn in_scene(self, scene: &Scene) -> String {
        match self {
            Self::Coupling { hinges } => {
                let [first, second] = hinges.map(|hinge| scene.label(hinge));
                format!("coupling of hinges {first} and {second}")
            }
            Self::Rotor { rotor } => {
                format!("rotor on the {}", scene.body_name(scene.rotors[rotor].body))
            }
            Self::External { external } => {
                let external = &scene.externals[external];
                let (kind, body) = (external.kind.name(), scene.body_name(external.body));
                let when = external.course.when(|time| format!("{time:?}"));
                format!("{kind} on the {body} {when}")
            }
            Self::Lines { hinge } | Self::Withheld { hinge } => {
                format!("kick-off spring of hinge {}", scene.label(hinge))
            }
            Self::Friction { hinge } => format!("friction of hinge {}", scene.label(hinge)),
        }
    }
}

impl fmt::Display for NoPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Coupling { .. } => {
                let what = "acts on one hinge alone, or on hinges that do not follow each other";
                write!(f, "a coupling that {what}, or beside another one")
            }
            Self::Rotor { .. } => {
                write!(f, "a rotor on a hinged body, or one that changes its speed")
            }
            Self::External { .. } => {
                write!(
                    f,
                    "a force or torque that is not constant on the main body and along its axes"
                )
            }
            Self::Lines { .. } => {
                let most = RightSideLayout::LINES_OF_LINK;
                write!(f, "more than {most} kick-off springs on bodies that move as one")
            }
            Self::Withheld { .. } => {
                write!(f, "a kick-off spring that does not turn all hinges inboard of it")
            }
            Self::Friction { .. } => {
                write!(f, "friction, which holds and lets go, and acts otherwise when motion turns")
            }
        }
    }
}
