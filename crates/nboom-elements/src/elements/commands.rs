use nboom_model::Scene;
use nboom_scalar::{Real, Vec3, Wrench};

/// What a control law commands: torques about hinges, a wrench on the main body and accelerations
/// of rotors, all of them constant while they are held.
#[derive(Clone, Debug, PartialEq)]
pub struct Commands {
    hinge_torques: Box<[f64]>,
    rotor_accelerations: Box<[f64]>,
    /// Force on the main body, and moment about O; main-body axes.
    pub main_body: Wrench<f64>,
}

impl Commands {
    /// Nothing, for `scene`.
    pub fn none(scene: &Scene) -> Self {
        let zeros = |count| vec![0.0; count].into();
        Self {
            hinge_torques: zeros(scene.bodies.len()),
            rotor_accelerations: zeros(scene.rotors.len()),
            main_body: Wrench::zero(),
        }
    }

    /// Whether they are of as many hinges and rotors as `scene` has.
    pub fn are_for(&self, scene: &Scene) -> bool {
        self.hinge_torques.len() == scene.bodies.len()
            && self.rotor_accelerations.len() == scene.rotors.len()
    }

    /// Commands nothing.
    pub fn clear(&mut self) {
        self.hinge_torques.fill(0.0);
        self.rotor_accelerations.fill(0.0);
        self.main_body = Wrench::zero();
    }

    /// Torque about each hinge of the scene, positive when it increases β. A held hinge bears it.
    pub fn hinge_torques(&self) -> &[f64] {
        &self.hinge_torques
    }

    /// The torques to be set.
    pub fn hinge_torques_mut(&mut self) -> &mut [f64] {
        &mut self.hinge_torques
    }

    /// Rate of change of the speed of each rotor of the scene relative to its body, beside that of
    /// its table \[rad/T²\].
    pub fn rotor_accelerations(&self) -> &[f64] {
        &self.rotor_accelerations
    }

    /// The accelerations to be set. (target − speed) / period reaches a speed at the next sample.
    pub fn rotor_accelerations_mut(&mut self) -> &mut [f64] {
        &mut self.rotor_accelerations
    }

    /// What forces and torques they exert.
    pub fn reach(&self) -> Reach {
        if self.main_body != Wrench::zero() {
            Reach::MainBody
        } else if self.hinge_torques.iter().any(|&torque| torque != 0.0) {
            Reach::Hinges
        } else {
            Reach::Nothing
        }
    }
}

/// What commands act on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// No force and no torque is commanded.
    Nothing,
    /// Torques about hinges alone.
    Hinges,
    /// A wrench on the main body, and any torques.
    MainBody,
}

/// The wrench on the main body while it is held.
pub(super) fn held<R: Real>(commands: &Commands) -> Option<Wrench<R>> {
    let Wrench { moment, force } = commands.main_body;
    (commands.reach() == Reach::MainBody)
        .then(|| Wrench { moment: Vec3::constant(moment), force: Vec3::constant(force) })
}
