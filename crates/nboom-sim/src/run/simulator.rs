use nboom_model::{Body, Hinge, Scene};

use super::Run;
use crate::equations::Equations;
use crate::options::Options;
use crate::run::record::{Failure, Recorder, Summary};

/// A scene that is prepared to be run as often as wanted.
///
/// Each run prepares the modes that it comes into: the tree of links, the code that computes rates of
/// change and its constants. Later runs find them prepared. Results do not depend on that.
pub struct Simulator {
    scene: Scene,
    options: Options,
    equations: Equations,
}

impl Simulator {
    /// Prepares `scene` to be run with `options`.
    pub fn new(scene: &Scene, options: Options) -> Self {
        let equations = Equations::new(scene, &options);
        Self { scene: scene.clone(), options, equations }
    }

    /// Takes another scene. What was prepared stays if it differs in its initial state and its times
    /// alone; else its modes are prepared as they come.
    pub fn set_scene(&mut self, scene: &Scene) {
        if !is_same_satellite(&self.scene, scene) {
            self.equations = Equations::new(scene, &self.options);
        }
        self.scene.clone_from(scene);
    }

    /// Runs the scene from its initial to its end time and tells `recorder` on the way.
    ///
    /// # Errors
    /// When the motion cannot be followed to the end or the recorder refuses; what was recorded
    /// until then stands, and the failure says how far the run came.
    pub fn run(&mut self, recorder: &mut dyn Recorder) -> Result<Summary, Failure> {
        let mut run = Run::new(&self.scene, self.options, &mut self.equations, recorder);
        match run.complete() {
            Ok(()) => Ok(run.summary()),
            Err(error) => Err(Failure { error, summary: Box::new(run.summary()) }),
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
