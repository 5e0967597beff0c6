//! What of a scene its runs depend on.

use nboom_io::{Sampling, SceneFile};
use nboom_model::{
    Base, Body, Dashpot, Material, Scene, SceneDescription, SegmentStructure, Spring, Stops,
};
use nboom_scalar::{Sym3, Vec3};
use nboom_strength::Loads;

use crate::study::RunSettings;

/// What stands for a material that no stress is compared with.
const ANY_MATERIAL: Material = Material::elastic(1.0, 0.0);

/// All of a scene that its runs depend on: scenes that have it in common have the same runs.
#[derive(PartialEq)]
pub(super) struct Relevant {
    description: SceneDescription,
    /// Natural sizes of coordinates, relative to which errors are measured.
    sizes: Vec<f64>,
    sampling: Option<Sampling>,
    segments: Option<Vec<SegmentStructure>>,
}

impl Relevant {
    /// That of a scene, unless its run would end before its start.
    pub fn of(file: &SceneFile, run: &RunSettings) -> Option<Self> {
        let scene = run.scene(file).ok()?;
        Some(Self {
            sizes: sizes(&scene),
            sampling: file.settings.sampling_of_run(run.samples),
            segments: segments(file, run),
            description: moving(&scene),
        })
    }
}

/// Of the hinges that turn.
fn sizes(scene: &Scene) -> Vec<f64> {
    let turn = (0..scene.bodies.len()).filter(|&i| scene.bodies[i].hinge.can_turn());
    turn.map(|i| scene.coordinate_scale(i)).collect()
}

/// The description without what is only drawn and what moves nothing.
fn moving(scene: &Scene) -> SceneDescription {
    let mut description = (**scene).clone();
    if description.base == Base::Fixed {
        description.main_body.inertia = Sym3::zero();
    }
    description.torque_tables.retain(|table| scene.bodies[table.hinge].hinge.can_turn());
    for coupling in description.couplings.iter_mut().filter(|of| of.stiffness == 0.0) {
        coupling.rest = 0.0;
    }
    for Body { tip, hinge, .. } in &mut description.bodies {
        *tip = Vec3::zero();
        if !hinge.can_turn() {
            hinge.spring = Spring::default();
            hinge.dashpot = Dashpot::default();
            hinge.friction = 0.0;
            hinge.lock_angle = None;
        }
        // A restitution of no stops is that of nothing.
        if hinge.stops.is_none() || !hinge.can_turn() {
            hinge.stops = Stops::NONE;
        }
        let Spring { quadratic, linear, preload_angle } = &mut hinge.spring;
        if [*quadratic, *linear] == [0.0; 2] {
            *preload_angle = 0.0;
        }
        let Dashpot { angle_quadratic, angle_linear, preload_angle, .. } = &mut hinge.dashpot;
        if [*angle_quadratic, *angle_linear] == [0.0; 2] {
            *preload_angle = 0.0;
        }
    }
    description
}

/// What loads and stresses depend on; a yield stress of the runs takes the place of those of materials.
fn segments(file: &SceneFile, run: &RunSettings) -> Option<Vec<SegmentStructure>> {
    let loads = run.wanted_loads(file, &file.scene).loads();
    if loads == Loads::None {
        return None;
    }
    let mut segments = file.structure.as_ref()?.segments().to_vec();
    for (segment, body) in segments.iter_mut().zip(&file.scene.bodies) {
        let SegmentStructure { pulse_constant, material, stations } = segment;
        if !body.hinge.may_be_struck() {
            *pulse_constant = 1.0;
        }
        if loads < Loads::Stations {
            stations.clear();
        }
        let Material { yield_stress, ultimate_stress, .. } = *material;
        *material = match (stations.is_empty(), run.strength.yield_stress) {
            (true, _) => ANY_MATERIAL,
            (false, Some(_)) => Material { ultimate_stress, ..ANY_MATERIAL },
            (false, None) => Material { yield_stress, ultimate_stress, ..ANY_MATERIAL },
        };
    }
    Some(segments)
}
