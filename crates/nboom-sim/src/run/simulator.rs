use nboom_elements::Elements;
use nboom_model::{Body, Hinge, Scene};
use nboom_ode::Stepper;

use super::Run;
use crate::equations::Equations;
use crate::equations::state::State;
use crate::events::situation::Situation;
use crate::options::Options;
use crate::run::record::{Failure, Recorder, Snapshot, Summary};
use crate::run::step_motion::Room;

/// A scene that is prepared to be run as often as wanted.
///
/// Each run prepares the modes that it comes into: the tree of links, the code that computes rates of
/// change and its constants. Later runs find them prepared, and room for all they write: they allocate
/// nothing, but for power series, the inertias of modes whose momenta are integrated, instants that a recorder
/// asks for, and failures. Results do not depend on that.
pub struct Simulator {
    options: Options,
    equations: Equations,
    workspace: Workspace,
}

/// What runs write to; nothing in it lasts from one run to the next but its room.
pub(super) struct Workspace {
    pub situation: Situation<f64>,
    pub scratch: State,
    pub shown: State,
    pub seen: Snapshot,
    pub stepper: Box<dyn Stepper>,
    pub variables: Vec<f64>,
    pub room: Room,
    pub summary: Summary,
}

impl Workspace {
    fn new(scene: &Scene, elements: &Elements<f64>, options: &Options) -> Self {
        Self {
            situation: Situation::new(scene),
            scratch: State::initial(scene),
            shown: State::initial(scene),
            seen: Snapshot::empty(),
            stepper: options.stepper(),
            variables: Vec::new(),
            room: Room::new(scene, elements),
            summary: Summary::empty(),
        }
    }
}

impl Simulator {
    /// Prepares `scene` to be run with `options`.
    pub fn new(scene: &Scene, options: Options) -> Self {
        let equations = Equations::new(scene, &options);
        let elements = equations.entered.dynamics.elements();
        let workspace = Workspace::new(scene, elements, &options);
        Self { options, equations, workspace }
    }

    /// Takes another scene. What was prepared stays if it differs in its initial state and its times
    /// alone; else its modes are prepared as they come.
    pub fn set_scene(&mut self, scene: &Scene) {
        if is_same_satellite(&self.equations.scene, scene) {
            self.equations.set_scene(scene);
        } else {
            *self = Self::new(scene, self.options);
        }
    }

    /// Runs the scene from its initial to its end time and tells `recorder` on the way.
    ///
    /// # Errors
    /// When the motion cannot be followed to the end or the recorder refuses; what was recorded
    /// until then stands, and the failure says how far the run came.
    pub fn run(&mut self, recorder: &mut dyn Recorder) -> Result<&Summary, Failure> {
        let Self { options, equations, workspace } = self;
        let mut run = Run::new(*options, equations, workspace, recorder);
        let completed = run.complete();
        run.sum_up();
        let summary = &self.workspace.summary;
        match completed {
            Ok(()) => Ok(summary),
            Err(error) => Err(Failure { error, summary: Box::new(summary.clone()) }),
        }
    }
}

/// Whether two scenes are of one satellite, on which the same forces can act.
fn is_same_satellite(a: &Scene, b: &Scene) -> bool {
    let are_same = |(a, b): (&Body, &Body)| {
        let hinge = Hinge { start: a.hinge.start, ..b.hinge };
        Body { hinge, ..*b } == *a
    };
    a.bodies.len() == b.bodies.len()
        && a.bodies.iter().zip(&b.bodies).all(are_same)
        && a.main_body == b.main_body
        && a.thrust == b.thrust
        && a.gravity == b.gravity
        && a.torque_tables == b.torque_tables
        && a.departures() == b.departures()
}
