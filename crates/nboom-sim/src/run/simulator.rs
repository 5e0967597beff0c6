use std::fmt;
use std::sync::Arc;

use nboom_elements::{Elements, OwnLaw, OwnLaws};
use nboom_model::{Body, Hinge, Scene};
use nboom_ode::Stepper;

use super::Run;
use super::control::Control;
use crate::code::fit::{Repertoire, SharedRepertoire};
use crate::equations::Equations;
use crate::equations::state::State;
use crate::error::SimError;
use crate::events::rest::Rest;
use crate::events::situation::Situation;
use crate::lanes::Lanes;
use crate::options::Options;
use crate::run::record::{Failure, Recorder, Snapshot, Summary};
use crate::run::step_motion::Room;

/// A scene that is prepared to be run as often as wanted.
///
/// Each run prepares the modes that it comes into: the tree of links, the code that computes rates of
/// change and its constants. Later runs find them prepared, and room for all they write: they allocate
/// nothing, but for power series, the inertias of modes whose momenta are integrated, friction or stops that hold a hinge, jumps
/// at lock-ups and impacts that a recorder asks for, and failures. 64 modes are kept; a scene that has more prepares
/// some again. Results do not depend on that.
pub struct Simulator {
    options: Options,
    equations: Equations,
    stepper: Box<dyn Stepper>,
    workspace: Workspace,
}

impl fmt::Debug for Simulator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { options, equations, .. } = self;
        let mut shown = f.debug_struct("Simulator");
        shown.field("scene", &equations.scene.name).field("options", options);
        shown.finish_non_exhaustive()
    }
}

/// What runs write to; nothing in it lasts from one run to the next but its room.
pub(super) struct Workspace {
    pub situation: Situation<f64>,
    pub scratch: State,
    pub shown: State,
    pub seen: Snapshot,
    pub sides: [Snapshot; 2],
    pub variables: Vec<f64>,
    pub room: Room,
    pub rest: Rest,
    pub summary: Summary,
}

impl Workspace {
    fn new(scene: &Scene, elements: &Elements<f64>) -> Self {
        Self {
            situation: Situation::new(scene),
            scratch: State::initial(scene),
            shown: State::initial(scene),
            seen: Snapshot::empty(),
            sides: [Snapshot::empty(), Snapshot::empty()],
            variables: Vec::new(),
            room: Room::new(scene, elements),
            rest: Rest::default(),
            summary: Summary::empty(),
        }
    }
}

impl Simulator {
    /// Prepares `scene` to be run with `options`.
    pub fn new(scene: &Scene, options: Options) -> Self {
        Self::under_laws(scene, options, Vec::new())
    }

    /// Prepares `scene` to be run with `options` under hinge laws of the program's own as well.
    ///
    /// The recursion computes all accelerations, as no other code knows these laws; implicit methods take
    /// differences for derivatives. Runs that demand other code are refused.
    pub fn under_laws(scene: &Scene, options: Options, laws: Vec<OwnLaw>) -> Self {
        Self::under(scene, options, OwnLaws::new(laws), Repertoire::shared(&options))
    }

    /// Prepares `scene` to be run with `options`, whose routines are in a repertoire that other simulators use
    /// too.
    pub fn sharing(scene: &Scene, options: Options, repertoire: SharedRepertoire) -> Self {
        Self::under(scene, options, OwnLaws::default(), repertoire)
    }

    fn under(scene: &Scene, options: Options, own: OwnLaws, repertoire: SharedRepertoire) -> Self {
        let equations = Equations::new(scene, own, repertoire, &options);
        let elements = equations.entered.dynamics.elements();
        let workspace = Workspace::new(scene, elements);
        Self { options, equations, stepper: options.stepper(), workspace }
    }

    /// Takes another scene, under the program's own laws that the simulator has. What was prepared stays if
    /// it differs in its initial state and its times alone. Modes of a satellite that has as many of everything
    /// take the places of those that are prepared, as they come; else all is prepared anew.
    pub fn set_scene(&mut self, scene: &Scene) {
        let Self { options, equations, workspace, .. } = self;
        if is_same_satellite(&equations.scene, scene) {
            return equations.set_scene(scene);
        }
        if is_alike(&equations.scene, scene) {
            return equations.set_satellite(scene);
        }
        let repertoire = Arc::clone(&equations.repertoire);
        *equations = Equations::new(scene, equations.own.clone(), repertoire, options);
        *workspace = Workspace::new(scene, equations.entered.dynamics.elements());
    }

    /// Runs the scene from its initial to its end time and tells `recorder` on the way.
    ///
    /// # Errors
    /// When the motion cannot be followed to the end or the recorder refuses; what was recorded
    /// until then stands, and the failure says how far the run came.
    pub fn run(&mut self, recorder: &mut dyn Recorder) -> Result<&Summary, Failure> {
        let lanes = Lanes::new();
        lanes.finish(self.run_under(None, &lanes, recorder))
    }

    /// Runs the scene as [`run`](Self::run) does, under a control law.
    ///
    /// Integration starts anew at each sample, since commands jump there; in between all is smooth. No
    /// event tells of a sample.
    ///
    /// # Errors
    /// As [`run`](Self::run), and when the period is no time in which the run comes to its end or a
    /// command is not finite.
    pub fn run_controlled(
        &mut self,
        control: Control<'_>,
        recorder: &mut dyn Recorder,
    ) -> Result<&Summary, Failure> {
        let lanes = Lanes::new();
        lanes.finish(self.run_under(Some(control), &lanes, recorder))
    }

    /// Runs the scene as [`run`](Self::run) does, its steps beside those of other runs that meet in `lanes` if
    /// the options say so. Its result does not depend on these.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub async fn run_in(
        &mut self,
        lanes: &Lanes,
        recorder: &mut dyn Recorder,
    ) -> Result<&Summary, Failure> {
        self.run_under(None, lanes, recorder).await
    }

    async fn run_under(
        &mut self,
        control: Option<Control<'_>>,
        lanes: &Lanes,
        recorder: &mut dyn Recorder,
    ) -> Result<&Summary, Failure> {
        let Self { options, equations, stepper, workspace } = self;
        // Shortens the lifetime of the borrowed law to that of the run.
        let control = control.map(|Control { period, law }| Control { period, law });
        let stepper = &mut **stepper;
        let mut run = Run::new(*options, equations, stepper, workspace, control, lanes, recorder);
        let completed = run.complete().await;
        run.sum_up();
        let summary = &mut self.workspace.summary;
        if let Err(SimError::Interrupted { time } | SimError::Record { time, .. }) = completed {
            // An output time within a step, whose end is not the state yet.
            summary.end_time = time;
        }
        match completed {
            Ok(()) => Ok(summary),
            Err(error) => Err(Failure { error, summary: Box::new(summary.clone()) }),
        }
    }
}

/// Whether two scenes have as many of everything, so that what one needs room for the other does, and whether
/// momenta can stand for rates in both.
fn is_alike(a: &Scene, b: &Scene) -> bool {
    let springs = |body: &Body| body.hinge.kick_off.is_some();
    let sticks = |body: &Body| (body.hinge.friction > 0.0, body.hinge.may_stick());
    a.bodies.len() == b.bodies.len()
        && a.bodies.iter().map(springs).eq(b.bodies.iter().map(springs))
        && a.externals.len() == b.externals.len()
        && a.bodies.iter().map(sticks).eq(b.bodies.iter().map(sticks))
        && a.externals_on_hinged().count() == b.externals_on_hinged().count()
        && a.rotors.len() == b.rotors.len()
        && a.base.is_held() == b.base.is_held()
        && a.departures() == b.departures()
}

/// Whether two scenes are of one satellite, on which the same forces can act.
fn is_same_satellite(a: &Scene, b: &Scene) -> bool {
    let are_same = |(a, b): (&Body, &Body)| {
        let hinge = Hinge { start: a.hinge.start, ..b.hinge };
        Body { hinge, ..*b } == *a
    };
    // What holds a main body holds it in its initial attitude.
    let are_held_alike = !a.base.is_held() || a.initial.attitude == b.initial.attitude;
    a.bodies.len() == b.bodies.len()
        && a.bodies.iter().zip(&b.bodies).all(are_same)
        && (a.base == b.base && are_held_alike)
        && a.main_body == b.main_body
        && a.externals == b.externals
        && a.gravity == b.gravity
        && a.torque_tables == b.torque_tables
        && a.couplings == b.couplings
        && a.rotors == b.rotors
        && a.departures() == b.departures()
}
