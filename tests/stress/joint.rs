//! Two booms that lock in one instant, each with a pulse of its own.

use std::io;

use nboom::model::{
    Body, Material, Mount, Scene, SceneDescription, SectionShape, SegmentStructure, Station,
    Structure,
};
use nboom::scalar::{Mat3, Vec3};
use nboom::sim::{Event, EventKind, InstantMotion, Options, Recorder, Snapshot, simulate};
use nboom::strength::{PulseShape, Settings, StressAnalysis};

use crate::follow::{LENGTH, RADIUS, THICKNESS, rod, swinging};

const PULSE_CONSTANTS: [f64; 2] = [0.02, 0.05];

/// The swinging boom, and what half a turn about z makes of it.
fn two_booms() -> Scene {
    let mut description = SceneDescription::clone(&swinging());
    description.initial.omega_body = Vec3::unit_z() * 0.5;
    let half_turn = Mat3::about_axis(Vec3::unit_z(), std::f64::consts::PI);
    let mount = Mount { rot_inboard_from_hinge: half_turn, ..description.bodies[0].mount };
    description.bodies.push(Body { mount, ..description.bodies[0] });
    Scene::new(description).expect("rods are bodies")
}

struct Follow {
    analysis: StressAnalysis,
    /// Moment about the hinge's axis at the root of each boom at the lock-up.
    moments: Vec<f64>,
    impulses: Vec<f64>,
    times: Vec<f64>,
}

impl Follow {
    fn run(settings: Settings) -> Self {
        let scene = two_booms();
        let root = Station {
            distance_from_hinge: 0.0,
            slice: rod(0.0, LENGTH),
            section: SectionShape::Tube { radius: RADIUS, thickness: THICKNESS },
        };
        let segment = |pulse_constant| SegmentStructure {
            pulse_constant,
            material: Material::elastic(7e10, 0.3),
            stations: vec![root.clone()],
        };
        let structure = Structure::new(&scene, PULSE_CONSTANTS.map(segment).to_vec());
        let structure = structure.expect("slices make the rods");
        let analysis = StressAnalysis::new(&scene, &structure, settings);
        let mut follow = Self {
            analysis: analysis.expect("tubes are sections"),
            moments: Vec::new(),
            impulses: Vec::new(),
            times: Vec::new(),
        };
        let options = Options { samples: 1, rtol: 1e-12, atol: 1e-14, ..Options::default() };
        simulate(&scene, &options, &mut follow).expect("a smooth motion");
        follow.analysis.finish().expect("finite loads");
        let settled = follow.analysis.settled();
        let loads = settled.iter().flat_map(|peaks| &peaks.stations);
        follow.moments = loads.map(|at| at.load.moment.x).collect();
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

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.analysis.instant(instant).map_err(io::Error::other)?;
        Ok(())
    }

    fn event(&mut self, event: &Event, _: &Snapshot) -> io::Result<()> {
        if event.kind == EventKind::LockUp {
            self.impulses.extend(event.impulse);
            self.times.push(event.time);
        }
        Ok(())
    }
}

#[test]
fn every_hinge_of_a_joint_lock_up_carries_its_own_impulse_over_its_own_pulse_constant() {
    for pulses in PulseShape::ALL {
        for amplification in [1.0, 1.7] {
            let settings = Settings { amplification, pulses, ..Settings::default() };
            let Follow { moments, impulses, times, .. } = Follow::run(settings);
            assert!(impulses.len() == 2 && times[0] == times[1], "{impulses:?} at {times:?}");
            for ((moment, impulse), constant) in moments.iter().zip(&impulses).zip(PULSE_CONSTANTS)
            {
                // Nothing else acts about the axis of a hinge without spring and dashpot, a pulse at
                // the other hinge neither. Where pulses rise and fall, that of the other hinge may
                // have the stress be largest a little before or after the peak.
                let share = moment / (amplification * impulse / constant);
                let least = if pulses == PulseShape::AllAtOnce { 1.0 - 1e-9 } else { 0.98 };
                assert!((least..1.0 + 1e-9).contains(&share), "{moments:?}, {impulses:?}");
            }
            // What half a turn makes of a boom locks as the boom does.
            assert!((impulses[0] - impulses[1]).abs() < 1e-11 * impulses[0].abs(), "{impulses:?}");
        }
    }
}
