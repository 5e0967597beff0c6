use std::{fmt, io};

use nboom_model::HingeLabel;
use nboom_ode::StepError;

use crate::code::CodeError;
use crate::code::closed_form::NotCovered;
use crate::code::generated::NoRoutine;
use crate::options::OptionError;

/// Why a run could not be finished.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SimError {
    /// An option has a value with which nothing can be run.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// No step meets the tolerance.
    #[error("at time {}, {}: the step size fell to {step:e}; the motion may be too stiff or the tolerance too small", moment(.time), place(.hinge))]
    StepUnderflow {
        /// Time reached.
        time: f64,
        /// The step size.
        step: f64,
        /// The hinge with the largest error; `None` is the main body.
        hinge: Option<HingeLabel>,
    },
    /// An acceleration is infinite or not a number.
    #[error("at time {}, {}: the acceleration is not finite; a force or torque has grown beyond all numbers", moment(.time), place(.hinge))]
    NotFinite {
        /// Time reached.
        time: f64,
        /// The first hinge concerned; `None` is the main body.
        hinge: Option<HingeLabel>,
    },
    /// A number of the motion, of its energies and momenta or of its forces is infinite or not a
    /// number.
    #[error("at time {}: {} is not finite; the motion or its units are beyond all numbers", moment(.time), of_hinge(.quantity, .hinge))]
    Overflow {
        /// When.
        time: f64,
        /// What it is of.
        quantity: &'static str,
        /// The first hinge concerned, if it is a quantity of hinges.
        hinge: Option<HingeLabel>,
    },
    /// A body has no inertia about a hinge that is free.
    #[error("at time {}, {}: nothing has inertia {}, so the mass matrix is singular", moment(.time), place(.hinge), freedom(.hinge))]
    SingularMassMatrix {
        /// Time reached.
        time: f64,
        /// The hinge; `None` is the main body.
        hinge: Option<HingeLabel>,
    },
    /// A body has inertia where it is free to move, but in double precision none is left of it.
    #[error(
        "at time {}, {}: its inertia is lost in double precision beside that of the rest; masses and lengths \
         that are less unequal, or smaller, expected",
        moment(.time),
        place(.hinge)
    )]
    LostInertia {
        /// Time reached.
        time: f64,
        /// The hinge; `None` is the main body.
        hinge: Option<HingeLabel>,
    },
    /// The ends of a line along which a force acts are at one point.
    #[error("at time {}, hinge {hinge}: its {element} has no length, so that its force has \
             no direction", moment(.time))]
    NoDirection {
        /// Time reached.
        time: f64,
        /// The hinge of the body on which the force acts.
        hinge: HingeLabel,
        /// What exerts the force.
        element: &'static str,
    },
    /// A generated routine was demanded and none fits.
    #[error("at time {time}: {source}; {}", source.remedy())]
    NoRoutine {
        /// Time from which on.
        time: f64,
        /// Why none fits.
        source: NoRoutine,
    },
    /// A closed form was demanded that does not cover the mode.
    #[error(
        "at time {time}: {source}; symmetric covers any tree of rigid bodies, recursive any scene"
    )]
    NotCovered {
        /// Time from which on.
        time: f64,
        /// What is not covered.
        source: NotCovered,
    },
    /// Code is demanded that does not know the hinge laws of the program's own.
    #[error(
        "{demanded} found, library code of the recursion expected under hinge laws of the program's own"
    )]
    OwnLaws {
        /// What is demanded.
        demanded: &'static str,
    },
    /// A hinge law of the program's own is of a hinge that the scene has not.
    #[error("own hinge law: hinge number {hinge} found, one of the {count} hinges expected")]
    OwnLawHinge {
        /// Number of the hinge, from 1.
        hinge: usize,
        /// How many hinges there are.
        count: usize,
    },
    /// A control law commands hinges and rotors of another scene.
    #[error("at time {}: commands for another scene found, those handed to the control law expected", moment(.time))]
    OtherCommands {
        /// Time reached.
        time: f64,
    },
    /// Which hinges stay at rest or at their stops, and which move, cannot be told.
    #[error("at time {}, {}: whether it stays where it is or moves is lost in rounding; less unequal masses, \
             frictions and torques expected", moment(.time), place(.hinge))]
    Undecided {
        /// Time reached.
        time: f64,
        /// The first hinge concerned.
        hinge: Option<HingeLabel>,
    },
    /// No impulses lock these hinges or turn them back from their stops.
    #[error("at time {}, {}: no impulse stops this hinge; the mass matrix is singular", moment(.time), place(.hinge))]
    Impulse {
        /// Time of the lock-up or the impact.
        time: f64,
        /// The first hinge that locks, else the first that comes to a stop.
        hinge: Option<HingeLabel>,
    },
    /// Newton's method does not find the time of an event in double-double.
    #[error("at time {}, hinge {hinge}: the time of its event cannot be found to all digits of double-double; \
             it changes with the square root of every error", moment(.time))]
    NotLocated {
        /// About where it is.
        time: f64,
        /// The hinge of the event.
        hinge: HingeLabel,
    },
    /// A scene has what no run in double-double follows.
    #[error(
        "found {what} in a run to be certified by double-double, expected none; --certify compares with \
             tighter tolerances"
    )]
    NotReplayed {
        /// What it has.
        what: &'static str,
    },
    /// Something feeds energy without end.
    #[error("at time {}, {runaway}", moment(.time))]
    Runaway {
        /// Time reached.
        time: f64,
        /// What does.
        runaway: Runaway,
    },
    /// The steps that are allowed are used up.
    #[error("at time {}: the {steps} steps that {by} allows are used up", moment(.time))]
    StepsUsedUp {
        /// Time reached.
        time: f64,
        /// How many were allowed.
        steps: usize,
        /// By what: an option, or the symbol of a deck.
        by: &'static str,
    },
    /// The run would take forever at its present pace.
    #[error("at time {}, {}: the last {steps} steps took only {within:e} time units; at this pace \
             the run does not come to its end, which is too far, or the motion is too stiff", moment(.time), place(.hinge))]
    TooManySteps {
        /// Time reached.
        time: f64,
        /// The hinge with the largest error; `None` is the main body.
        hinge: Option<HingeLabel>,
        /// How many steps.
        steps: usize,
        /// The time they took.
        within: f64,
    },
    /// The events that are allowed are used up.
    #[error("at time {}, {}: the {events} events that max_events allows are used up; {cause}, or max_events is too small", moment(.time), place(.hinge))]
    EventsUsedUp {
        /// Time reached.
        time: f64,
        /// The hinge of the last event.
        hinge: Option<HingeLabel>,
        /// What may make more of that kind.
        cause: &'static str,
        /// How many were allowed.
        events: usize,
    },
    /// Events follow one another without the time getting on.
    #[error("at time {}, {}: {events} events within {within:e} time units are too many; {cause}", moment(.time), place(.hinge))]
    Chatter {
        /// Time reached.
        time: f64,
        /// The hinge of the last event.
        hinge: Option<HingeLabel>,
        /// What may make events like the last one again and again, in words.
        cause: &'static str,
        /// How many events.
        events: usize,
        /// The time they took.
        within: f64,
    },
    /// The recorder asked for the end.
    #[error("interrupted at time {}", moment(.time))]
    Interrupted {
        /// Time reached.
        time: f64,
    },
    /// The recorder could not keep something.
    #[error("at time {time}: {source}")]
    Record {
        /// Time reached.
        time: f64,
        /// Why not.
        source: io::Error,
    },
}

/// A motion that something feeds without end.
#[derive(Clone, Debug, PartialEq)]
pub struct Runaway {
    /// The hinge that feeds most.
    pub hinge: HingeLabel,
    /// What of it.
    pub feeds: Feeds,
    /// Kinetic energy in units of what the scene has of energy at the initial time.
    pub growth: f64,
}

impl fmt::Display for Runaway {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { hinge, feeds, growth } = self;
        write!(
            f,
            "hinge {hinge}: the motion runs away, with {growth:.0e} times the energy of its beginning; {feeds}"
        )
    }
}

/// What of a hinge feeds energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feeds {
    /// What depends on its angle: the spring, or the dashpot's terms in the angle.
    Spring,
    /// A torque tabulated over its angle, which goes on straight beyond its points.
    Table,
    /// What depends on its rate.
    Dashpot,
    /// A coupling of it with another hinge.
    Coupling,
}

impl fmt::Display for Feeds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Spring => "its spring feeds it, a coefficient may have the wrong sign",
            Self::Table => {
                "its torque table feeds it, which goes on straight beyond its last points"
            }
            Self::Dashpot => "its dashpot feeds it, a coefficient may have the wrong sign",
            Self::Coupling => "its coupling feeds it, a coefficient may have the wrong sign",
        })
    }
}

impl SimError {
    /// No code for the mode that begins at `time`.
    pub(crate) fn from_code(error: CodeError, time: f64) -> Self {
        match error {
            CodeError::NoRoutine(source) => Self::NoRoutine { time, source },
            CodeError::NotCovered(source) => Self::NotCovered { time, source },
        }
    }

    /// The stepper's refusal, blamed on `hinge`.
    pub(crate) fn from_step(error: StepError, hinge: Option<HingeLabel>) -> Self {
        match error {
            StepError::Underflow { time, step, .. } => Self::StepUnderflow { time, step, hinge },
            StepError::NotFinite { time, .. } => Self::NotFinite { time, hinge },
            StepError::NoSeries { .. } => unreachable!("equations of motion have series"),
        }
    }
}

/// A time in the form that needs fewer digits.
fn moment(time: &f64) -> String {
    let (plain, short) = (time.to_string(), format!("{time:e}"));
    if plain.len() <= short.len() + 4 { plain } else { short }
}

fn place(hinge: &Option<HingeLabel>) -> String {
    hinge.as_ref().map_or_else(|| "main body".to_owned(), |label| format!("hinge {label}"))
}

fn freedom(hinge: &Option<HingeLabel>) -> &'static str {
    if hinge.is_some() { "about this hinge" } else { "in one of its directions" }
}

fn of_hinge(quantity: &str, hinge: &Option<HingeLabel>) -> String {
    hinge
        .as_ref()
        .map_or_else(|| quantity.to_owned(), |label| format!("{quantity} of hinge {label}"))
}
