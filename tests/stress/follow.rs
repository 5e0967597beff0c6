//! A boom that swings into its latch, and a recorder that follows its stresses.

use std::io;

use nboom::model::{
    Appendage, Hinge, HingeStart, HingeState, MassProperties, Material, Mount, Scene,
    SceneDescription, SectionShape, Segment, SegmentStructure, Station, Structure,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{
    Event, EventKind, InstantMotion, Options, Recorder, Snapshot, StepMotion, simulate,
};
use nboom::strength::{Settings, StationLoad, StationStress, StrengthError, StressAnalysis};

pub const MASS: f64 = 3.0;
pub const LENGTH: f64 = 2.0;
pub const HUB_MASS: f64 = 20.0;
pub const RADIUS: f64 = 0.05;
pub const THICKNESS: f64 = 0.002;
pub const PULSE_CONSTANT: f64 = 0.02;

/// Distances of the stations from the hinge.
pub const STATIONS: [f64; 3] = [1.5, 0.5, 0.0];

/// A uniform rod from `from` to `to` along y.
pub fn rod(from: f64, to: f64) -> MassProperties {
    let (length, middle) = (to - from, Vec3::unit_y() * (0.5 * (from + to)));
    let mass = MASS * length / LENGTH;
    let across = mass * length * length / 12.0;
    MassProperties::new(mass, middle, Sym3::diagonal(across, 0.0, across))
}

/// A rod on a hub, hinged about x at O.
pub fn boom(hinge: Hinge, omega: Vec3<f64>, end_time: f64) -> Scene {
    let hub = MassProperties::new(HUB_MASS, Vec3::zero(), Sym3::diagonal(7.0, 9.0, 8.0));
    let mut description = SceneDescription::at_rest("a boom with stations", hub, end_time);
    description.initial.omega_body = omega;
    let segments = vec![Segment { length: LENGTH, mass_properties: rod(0.0, LENGTH), hinge }];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    Scene::new(description).expect("a rod is a body")
}

/// The boom, held at angle zero.
pub fn held(omega: Vec3<f64>) -> Scene {
    let start = HingeStart { angle: 0.0, rate: 0.0, state: HingeState::Locked };
    boom(Hinge { lock_angle: Some(0.0), start, ..Hinge::free() }, omega, 1.0)
}

/// The boom, swinging towards its latch at angle zero.
pub fn swinging() -> Scene {
    let start = HingeStart { angle: -0.8, rate: 2.0, state: HingeState::Free };
    let hinge = Hinge { lock_angle: Some(0.0), start, ..Hinge::free() };
    boom(hinge, Vec3::new(0.1, 0.3, 0.5), 1.0)
}

pub fn analysis(scene: &Scene, settings: Settings) -> Result<StressAnalysis, StrengthError> {
    let outer = [LENGTH].into_iter().chain(STATIONS);
    let station = |(distance, outer): (f64, f64)| Station {
        distance_from_hinge: distance,
        slice: rod(distance, outer),
        section: SectionShape::Tube { radius: RADIUS, thickness: THICKNESS },
    };
    let segment = SegmentStructure {
        pulse_constant: PULSE_CONSTANT,
        material: Material::elastic(7e10, 0.3),
        stations: STATIONS.into_iter().zip(outer).map(station).collect(),
    };
    let structure = Structure::new(scene, vec![segment]).expect("slices make the rod");
    StressAnalysis::new(scene, &structure, settings)
}

fn stresses(analysis: &StressAnalysis, loads: &[StationLoad]) -> Vec<StationStress> {
    analysis.stations().stresses(loads).collect()
}

/// Everything that a run and its stresses tell.
pub struct Follow {
    pub analysis: StressAnalysis,
    pub samples: Vec<Snapshot>,
    pub at_samples: Vec<Vec<StationStress>>,
    pub at_lock_ups: Vec<Vec<StationStress>>,
    pub impulses: Vec<f64>,
    /// Times of instants with events.
    pub instants: Vec<f64>,
}

impl Follow {
    pub fn run(scene: &Scene, settings: Settings) -> Self {
        Self::run_with(scene, settings, 10)
    }

    /// With this many output intervals.
    pub fn run_with(scene: &Scene, settings: Settings, samples: usize) -> Self {
        let mut follow = Self {
            analysis: analysis(scene, settings).expect("tubes are sections"),
            samples: Vec::new(),
            at_samples: Vec::new(),
            at_lock_ups: Vec::new(),
            impulses: Vec::new(),
            instants: Vec::new(),
        };
        let options = Options { samples, rtol: 1e-12, atol: 1e-14, ..Options::default() };
        simulate(scene, &options, &mut follow).expect("a smooth motion");
        follow.analysis.finish().expect("finite loads");
        let settled = follow.analysis.settled().into_iter();
        let analysis = &follow.analysis;
        follow.at_lock_ups = settled.map(|peaks| stresses(analysis, &peaks.stations)).collect();
        follow
    }
}

impl Recorder for Follow {
    fn needs_detail(&self) -> bool {
        true
    }

    fn needs_instants(&self) -> bool {
        true
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let detail = snapshot.detail.as_ref().expect("detail was asked for");
        self.analysis.motion(snapshot, detail).map_err(io::Error::other)?;
        self.at_samples.push(stresses(&self.analysis, self.analysis.station_loads()));
        self.samples.push(snapshot.clone());
        Ok(())
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.instants.push(instant.after.snapshot.time);
        self.analysis.instant(instant).map_err(io::Error::other)?;
        Ok(())
    }

    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.analysis.step(step).map_err(io::Error::other)
    }

    fn event(&mut self, event: &Event, _after: &Snapshot) -> io::Result<()> {
        if event.kind == EventKind::LockUp {
            self.impulses.extend(event.impulse);
        }
        Ok(())
    }
}
