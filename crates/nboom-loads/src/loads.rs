use nboom_model::{HingeState, Scene, Structure};
use nboom_scalar::{Kernel, Vec3};

use crate::equations::LoadEquations;
use crate::generated::Generated;
use crate::load_set::LoadSet;
use crate::motion::{LockUpShare, MotionSize, SceneMotion, VelocityChange};

/// Finds hinge and station loads of one scene, and what describes stresses.
///
/// Evaluations allocate nothing and panic when a slice of the motion has not one entry for each
/// hinge of the scene.
#[derive(Clone, Debug)]
pub struct Loads {
    code: LoadCode,
    /// Of one lock-up or impact.
    impulses: LoadSet,
    still: Still,
}

/// Zeros of a motion at rest.
#[derive(Clone, Debug)]
struct Still {
    /// One for each hinge.
    of_hinges: Vec<f64>,
    outside: Vec<[f64; 3]>,
    rotors: Vec<[f64; 2]>,
}

/// The equations, and code in their place.
#[derive(Clone, Debug)]
struct LoadCode {
    equations: LoadEquations,
    generated: Option<Generated>,
}

impl LoadCode {
    fn evaluate(&mut self, motion: &SceneMotion<'_>, out: &mut LoadSet) {
        match &mut self.generated {
            Some(generated) => generated.evaluate(motion, out),
            None => self.equations.evaluate(motion, out),
        }
    }
}

/// The motion whose loads are the impulses of `jump`: at rest, with jumps for accelerations.
fn suddenly<'a>(still: &'a Still, beta: &'a [f64], jump: &VelocityChange<'a>) -> SceneMotion<'a> {
    let Still { of_hinges, outside, rotors } = still;
    SceneMotion {
        omega_body: Vec3::zero(),
        beta,
        tau: of_hinges,
        acceleration: *jump,
        force_densities: of_hinges,
        outside,
        rotors,
    }
}

impl Loads {
    /// The loads of `scene`: those of its hinges, and with a structure those of its stations.
    ///
    /// Hinge loads follow from the bodies' own mass properties, station loads from the slices.
    pub fn new(scene: &Scene, structure: Option<&Structure>) -> Self {
        Self::by(LoadEquations::new(scene, structure))
    }

    /// The loads by these equations.
    pub fn by(equations: LoadEquations) -> Self {
        let MotionSize { hinges, externals, rotors } = equations.motion_size();
        Self {
            impulses: equations.load_set(),
            still: Still {
                of_hinges: vec![0.0; hinges],
                outside: vec![[0.0; 3]; externals],
                rotors: vec![[0.0; 2]; rotors],
            },
            code: LoadCode { equations, generated: None },
        }
    }

    /// Computes loads by the first of `kernels` that was generated from these equations, if one
    /// was.
    pub fn with_kernels(mut self, kernels: &[Kernel]) -> Self {
        self.code.generated = Generated::of(kernels, &self.code.equations.numbers());
        self
    }

    /// Instruction set of the generated code that runs, if any does.
    pub fn generated_for(&self) -> Option<&'static str> {
        self.code.generated.as_ref().map(Generated::instructions)
    }

    /// What the loads are computed by, in library code.
    pub(crate) fn equations(&self) -> &LoadEquations {
        &self.code.equations
    }

    /// Zero loads of this scene, to be filled in.
    pub fn load_set(&self) -> LoadSet {
        self.code.equations.load_set()
    }

    /// Loads by the motion, the forces along lines and what acts from outside: eqs. (10.4) to
    /// (10.6), corrected: note 24.
    pub fn continuous(&mut self, motion: &SceneMotion<'_>, out: &mut LoadSet) {
        self.code.evaluate(motion, out);
    }

    /// Impulses by a jump of the velocities in the posture `beta`, for hinges that lock, that
    /// are free and that have been held alike: eqs. (10.7) to (10.12), corrected: note 25.
    pub fn impulses(&mut self, beta: &[f64], jump: &VelocityChange<'_>, out: &mut LoadSet) {
        self.code.evaluate(&suddenly(&self.still, beta, jump), out);
    }

    /// Adds the peaks of a lock-up to `loads`: `amplification` times the impulses of each hinge
    /// that locks over its pulse constant, eqs. (10.13) and (10.14).
    ///
    /// All pulses peak together. `loads` holds the continuous loads at that instant; an
    /// amplification of 1 is a pulse that is slow against the bending of the segments.
    pub fn add_lock_up(
        &mut self,
        beta: &[f64],
        shares: &[LockUpShare<'_>],
        amplification: f64,
        loads: &mut LoadSet,
    ) {
        let Self { code, impulses, still } = self;
        for share in shares {
            code.evaluate(&suddenly(still, beta, &share.jump), impulses);
            loads.add_scaled(impulses, amplification / share.pulse_constant);
        }
    }

    /// The free hinge at which the load about the axis (along it where it slides) departs most from
    /// the `torques` that act there, and by which share of what the load is made of; `None` when
    /// all are held.
    ///
    /// Of a motion, torques are those of springs and dashpots; of impulses, those of latches and stops.
    pub fn largest_torque_residual(
        &self,
        loads: &LoadSet,
        hinges: &[HingeState],
        torques: &[f64],
    ) -> Option<(usize, f64)> {
        let free = (0..hinges.len()).filter(|&i| hinges[i] == HingeState::Free);
        let residual = |i: usize| {
            let segment = &self.equations().segments[i];
            let load = segment.joint.along(segment.axis, &loads.hinges[i]);
            let difference = (load - torques[i]).abs();
            let size = loads.sizes[i] + torques[i].abs();
            (i, if difference == 0.0 { 0.0 } else { difference / size })
        };
        free.map(residual).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}
