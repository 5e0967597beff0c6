use nboom_model::Scene;

/// Why a deck cannot say a scene: one body, and what about it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{body}: {key}: {defect}")]
pub struct DeckObstacle {
    /// The body, by its name in backquotes or by the numbers of its segment.
    pub body: String,
    /// Which key of a scene says it, with its table.
    pub key: &'static str,
    /// What about it.
    pub defect: DeckDefect,
}

/// What a deck cannot say.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DeckDefect {
    /// Several bodies hang on one that is not the main body.
    #[error("found {0} on it, expected one body; appendages of a deck do not branch")]
    Branches(String),
    /// More bodies than a deck has.
    #[error("found {0} hinged bodies, expected at most {most} in a deck", most = super::super::LARGEST_COUNT)]
    Bodies(usize),
    /// Axes of an appendage that are neither those of a chain nor of a paddle.
    #[error("found an axis at {degrees} deg to that of the inboard hinge, expected {expected}")]
    Axis {
        /// The angle between the axes.
        degrees: f64,
        /// What would have been right.
        expected: &'static str,
    },
    /// A hinge of a chain that is displaced along its axis.
    #[error(
        "found it {0} along the hinge axis, expected 0: an appendage of a deck lies in one plane"
    )]
    Aside(f64),
    /// A hinge of a chain that is not straight ahead at angle zero.
    #[error(
        "found the way to it at {0} deg to the body inboard at angle zero, expected 0: angles of a deck \
         count from the straight appendage"
    )]
    Bent(f64),
    /// A paddle whose axis does not go through its arm's hinge.
    #[error(
        "found it off the line along its axis outward from the arm's hinge, expected it there: a paddle \
         of a deck turns about its arm"
    )]
    OffArm,
    /// A joint that slides.
    #[error("found a joint that slides, expected hinges only")]
    Slides,
    /// A main body that is held.
    #[error("found a main body that is held, expected a free one")]
    Held,
    /// A rotor.
    #[error("found a rotor, expected none")]
    Rotor,
    /// A second thrust, or one that is not fixed in the main body or goes by a table.
    #[error(
        "found {0}, expected at most one force, fixed in the main body and constant while it is on"
    )]
    External(String),
    /// A spring or damper between two hinges.
    #[error("found a spring or damper between two hinges, expected none")]
    Coupling,
    /// A torque over the angle.
    #[error("found a torque over the angle, expected springs and dampers only")]
    Torque,
    /// Friction of a hinge.
    #[error("found friction, expected none")]
    Friction,
    /// Stops of a hinge.
    #[error("found stops, expected none")]
    Stops,
    /// A release that waits for a lock-up.
    #[error(
        "found a release after a lock-up, expected one at a time or by an angle, such as the angle at \
         which that hinge latches"
    )]
    AfterLock,
    /// A number so large that a deck takes it for never.
    #[error("found {0}, expected less than 1e6, which in a deck means never")]
    Never(f64),
    /// Stations of a body whose axes are not those of a segment.
    #[error(
        "found stations on a body with other axes than a segment of a deck, expected x along its hinge \
         axis and y to the next hinge or the outer end"
    )]
    StationAxes,
    /// Too few or too many stations.
    #[error("found {0} stations, expected 1 to 5 for every body of a deck with stresses")]
    Stations(usize),
    /// Sections of two kinds.
    #[error("found tubes and polygons on one body, expected one kind")]
    Sections,
    /// A section with too many corners.
    #[error("found a section of {0} corners, expected at most 6")]
    Corners(usize),
}

/// Obstacles found so far in a scene.
pub(super) struct Obstacles<'s> {
    pub scene: &'s Scene,
    pub found: Vec<DeckObstacle>,
}

impl Obstacles<'_> {
    pub fn add(&mut self, body: usize, key: &'static str, defect: DeckDefect) {
        let body = self.name(body);
        self.found.push(DeckObstacle { body, key, defect });
    }

    /// Adds one about the main body.
    pub fn add_to_main_body(&mut self, key: &'static str, defect: DeckDefect) {
        self.found.push(DeckObstacle { body: "main_body".to_owned(), key, defect });
    }

    /// What messages call a body.
    pub fn name(&self, body: usize) -> String {
        let numbered = || format!("segment {}", self.scene.label(body));
        self.scene.name_of(body).map_or_else(numbered, |name| format!("`{name}`"))
    }
}
