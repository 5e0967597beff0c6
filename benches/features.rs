//! What the features of a scene cost: the report's case with thrust, gravity and bodies of any
//! shape added, and the same with one feature left out.
//!
//! `cargo bench --bench features` prints a line for each: the shortest of many runs in microseconds,
//! its ratio to that of the full scene, steps and evaluations, nanoseconds for each evaluation, and
//! how many operations generated code takes for the accelerations of the scene when it assumes the
//! scene's zeros. All runs take turns. In the last row nothing is left out and stresses are
//! computed at each output time and event and the worst searched in each step, without files.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use nboom::io::SceneFile;
use nboom::model::{
    Dashpot, External, Gravity, HingeState, Scene, SceneDescription, Spring, Structure,
};
use nboom::scalar::{Quaternion, Vec3};
use nboom::sim::{
    Event, InstantMotion, Options, Recorder, Snapshot, StepMotion, Summary, simulate,
};
use nboom::strength::{Settings, StressAnalysis};
use nboom_codegen::{Level, Numbers, Request, generate};

const SECONDS: f64 = 30.0;

/// Takes what it is told and forgets it, but for stresses.
struct Listener {
    detail: bool,
    stresses: Option<StressAnalysis>,
}

impl Recorder for Listener {
    fn needs_detail(&self) -> bool {
        self.detail
    }

    fn sample(&mut self, snapshot: &Snapshot) -> std::io::Result<()> {
        if let (Some(stresses), Some(detail)) = (&mut self.stresses, &snapshot.detail) {
            stresses.motion(snapshot, detail).map_err(std::io::Error::other)?;
            let found = stresses.stations().stresses(stresses.station_loads());
            found.for_each(|stress| {
                black_box(stress);
            });
        }
        black_box(snapshot);
        Ok(())
    }

    fn event(&mut self, event: &Event, after: &Snapshot) -> std::io::Result<()> {
        black_box((event, after));
        Ok(())
    }

    fn needs_instants(&self) -> bool {
        self.stresses.is_some()
    }

    fn instant(&mut self, instant: &InstantMotion) -> std::io::Result<()> {
        if let Some(stresses) = &mut self.stresses {
            stresses.instant(instant).map_err(std::io::Error::other)?;
        }
        Ok(())
    }

    fn needs_steps(&self) -> bool {
        self.stresses.is_some()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> std::io::Result<()> {
        let Some(stresses) = &mut self.stresses else { return Ok(()) };
        stresses.step(step).map_err(std::io::Error::other)
    }
}

/// A scene and what is asked of its run.
struct Case {
    without: &'static str,
    scene: Scene,
    operations: usize,
    samples: usize,
    detail: bool,
    stresses: Option<StressAnalysis>,
    seconds: f64,
    summary: Option<Summary>,
}

impl Case {
    fn new(without: &'static str, leave_out: impl Fn(&mut SceneDescription)) -> Self {
        let mut description = full();
        leave_out(&mut description);
        let scene = Scene::new(description).expect("features may be left out");
        let request = Request::of_scene(&scene, Numbers::RunTime, Level::Fast);
        let request = request.expect("the satellite is made of chains and paddles");
        let operations = generate(&request).expect("it is small").evaluation.flops();
        let (stresses, seconds) = (None, f64::INFINITY);
        let (samples, detail, summary) = (200, true, None);
        Self { without, scene, operations, samples, detail, stresses, seconds, summary }
    }

    fn run(&mut self) {
        let options = Options {
            samples: self.samples,
            kernels: nboom_routines::for_runs(),
            batches: nboom_routines::right_sides_of_eight(),
            ..Options::default()
        };
        let mut listener = Listener { detail: self.detail, stresses: self.stresses.clone() };
        let started = Instant::now();
        let summary = simulate(black_box(&self.scene), &options, &mut listener);
        self.seconds = self.seconds.min(started.elapsed().as_secs_f64());
        self.summary = Some(summary.expect("the scene runs"));
    }
}

fn main() {
    let mut cases = cases();
    let started = Instant::now();
    while started.elapsed().as_secs_f64() < SECONDS {
        cases.iter_mut().for_each(Case::run);
    }
    println!("without microseconds of_full events steps evaluations ns_each operations");
    let whole = cases[0].seconds;
    for Case { without, seconds, summary, operations, .. } in &cases {
        let summary = summary.as_ref().expect("every case has run");
        let (steps, evaluations) = (summary.steps_accepted, summary.evaluations);
        println!(
            "{without} {:.1} {:.3} {} {steps} {evaluations} {:.1} {operations}",
            seconds * 1e6,
            seconds / whole,
            summary.events,
            seconds * 1e9 / evaluations as f64
        );
    }
}

fn cases() -> Vec<Case> {
    let hinges = |change: fn(&mut nboom::model::Hinge)| {
        move |scene: &mut SceneDescription| {
            scene.bodies.iter_mut().for_each(|body| change(&mut body.hinge));
        }
    };
    let mut all = vec![
        Case::new("nothing", |_| ()),
        Case::new("thrust", |scene| scene.externals.clear()),
        Case::new("gravity", |scene| scene.gravity = None),
        Case::new("kick_off_springs", hinges(|hinge| hinge.kick_off = None)),
        Case::new("dashpots", hinges(|hinge| hinge.dashpot = Dashpot::default())),
        Case::new("hinge_springs", hinges(|hinge| hinge.spring = Spring::default())),
        Case::new("products_of_inertia", along_axes),
        Case::new("offsets_of_mass_centres", centred),
        Case::new("both_of_these", |scene| {
            along_axes(scene);
            centred(scene);
        }),
        Case::new("motion_of_the_paddle", |scene| {
            for body in &mut scene.bodies[2..] {
                body.hinge.start.state = HingeState::Locked;
            }
        }),
        Case::new("detail", |_| ()),
        Case::new("output_times", |_| ()),
        Case::new("all_but_hinges_that_lock", |scene| {
            scene.externals.clear();
            scene.gravity = None;
            along_axes(scene);
            centred(scene);
            for body in &mut scene.bodies {
                body.hinge.kick_off = None;
                body.hinge.dashpot = Dashpot::default();
            }
        }),
        Case::new("nothing_with_stresses", |_| ()),
    ];
    for case in &mut all {
        match case.without {
            "detail" => case.detail = false,
            "output_times" => case.samples = 1,
            "nothing_with_stresses" => case.stresses = Some(stresses(&case.scene)),
            "all_but_hinges_that_lock" => (case.samples, case.detail) = (1, false),
            _ => {}
        }
    }
    all
}

fn file() -> SceneFile {
    let deck = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/n-boom-1970.nml");
    nboom::io::read_scene(&deck).expect("the deck is in the clone")
}

fn deck() -> SceneDescription {
    SceneDescription::clone(&file().scene)
}

/// The stations of the deck on the bodies of another scene.
fn stresses(scene: &Scene) -> StressAnalysis {
    let segments = file().structure.expect("the deck asks for stresses").segments().to_vec();
    let (structure, _) = Structure::with_differing_slices(scene, segments).expect("as many bodies");
    StressAnalysis::new(scene, &structure, Settings::default()).expect("sections of the deck")
}

/// The report's case with a thrust, gravity, and bodies without symmetry.
fn full() -> SceneDescription {
    let mut scene = deck();
    let (force, point) = (Vec3::new(30.0, 5.0, -2.0), Vec3::new(-10.0, 1.0, 0.5));
    scene.externals = vec![External::thrust(force, point, [0.05, 0.8])];
    scene.gravity = Some(Gravity { acceleration: 386.0, up: Vec3::unit_z() });
    let turn = Quaternion { scalar: 0.8, vector: Vec3::new(0.36, 0.48, 0.0) }.to_matrix();
    for mass in masses(&mut scene) {
        mass.inertia = mass.inertia.rotated(&turn);
        mass.center_of_mass += Vec3::new(0.2, 0.0, -0.1);
    }
    scene
}

fn masses(scene: &mut SceneDescription) -> impl Iterator<Item = &mut nboom::model::MassProperties> {
    let SceneDescription { main_body, bodies, .. } = scene;
    std::iter::once(main_body).chain(bodies.iter_mut().map(|body| &mut body.mass_properties))
}

/// Inertias along the axes of the bodies.
fn along_axes(scene: &mut SceneDescription) {
    for (mass, of_deck) in masses(scene).zip(masses(&mut deck())) {
        mass.inertia = of_deck.inertia;
    }
}

/// The main body's mass centre at O, those of segments on their η axes.
fn centred(scene: &mut SceneDescription) {
    for (mass, of_deck) in masses(scene).zip(masses(&mut deck())) {
        mass.center_of_mass = of_deck.center_of_mass;
    }
}
