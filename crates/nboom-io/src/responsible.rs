//! Which table and key of a scene is responsible for an error found later; files and words have the same.

use nboom_model::{
    BaseQuantity, BodyName, Course, External, ExternalKind, ExternalPart, HingeLabel,
    HingeQuantity, Joint, MassDefect, ModelError, RotorPart, RotorSpeed, SceneDescription,
    SceneQuantity, UnitQuantity,
};

/// A table of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Table {
    Run,
    Initial,
    Gravity,
    MainBody,
    /// That of a hinged body of the scene.
    Body(usize),
    /// That of its joint.
    Joint(usize),
    /// That of the release of its joint.
    Release(usize),
    /// That of its kick-off spring.
    KickOff(usize),
    /// The rotor of this number, from 0, of a body or the main body.
    Rotor(Option<usize>, usize),
    /// The thrust of the scene, which is its first force on the main body.
    Thrust,
    /// The force or torque of this number among those of its kind that are no thrust, from 0, on a body or the main
    /// body.
    External(Option<usize>, ExternalKind, usize),
}

impl Table {
    /// The hinged body that it is of, if it is of one.
    pub fn body(self) -> Option<usize> {
        match self {
            Self::Body(i) | Self::Joint(i) | Self::Release(i) | Self::KickOff(i) => Some(i),
            Self::Rotor(body, _) | Self::External(body, ..) => body,
            Self::Run | Self::Initial | Self::Gravity | Self::MainBody | Self::Thrust => None,
        }
    }
}

/// The table and the key, of a scene with a table of its thrust or without.
pub(crate) fn responsible(
    scene: &SceneDescription,
    has_thrust: bool,
    error: &ModelError,
) -> (Table, &'static str) {
    let body = |label: &HingeLabel| Table::Body(index_of(scene, label));
    let joint = |label: &HingeLabel| Table::Joint(index_of(scene, label));
    match error {
        ModelError::Mass { body: BodyName::MainBody, defect } => {
            (Table::MainBody, mass_key(defect))
        }
        ModelError::Mass { body: BodyName::Segment(label), defect } => {
            (body(label), mass_key(defect))
        }
        ModelError::NotFiniteInHinge { label, quantity } => match quantity {
            HingeQuantity::Points => (joint(label), "at"),
            HingeQuantity::Spring => (joint(label), "spring"),
            HingeQuantity::Dashpot => (joint(label), "damper"),
            HingeQuantity::Friction => (joint(label), "friction"),
            HingeQuantity::Start => (joint(label), "start"),
            HingeQuantity::LockAngle => (joint(label), "latch"),
            HingeQuantity::Release => (joint(label), "release"),
            HingeQuantity::KickOff => (body(label), "kick_off"),
        },
        ModelError::NotFinite { quantity } => match quantity {
            SceneQuantity::InitialTime => (Table::Run, "start"),
            SceneQuantity::InitialPosition => (Table::Initial, "position"),
            SceneQuantity::InitialVelocity => (Table::Initial, "velocity"),
            SceneQuantity::InitialRate => (Table::Initial, "rate"),
            SceneQuantity::EndTime | SceneQuantity::Duration => (Table::Run, "end"),
            SceneQuantity::Gravity => (Table::Gravity, "acceleration"),
        },
        ModelError::NotUnit { quantity, .. } => match quantity {
            UnitQuantity::InitialAttitude => (Table::Initial, "attitude"),
            UnitQuantity::GravityDirection => (Table::Gravity, "up"),
        },
        ModelError::KickOffLimit { label, .. } => (Table::KickOff(index_of(scene, label)), "limit"),
        ModelError::Axis { label, .. } => (joint(label), "axis"),
        ModelError::MountRotation { label, .. } => (joint(label), "axes"),
        ModelError::HeldRate { label, .. } => (joint(label), label.joint.rate_name()),
        ModelError::NegativeFriction { label, .. } => (joint(label), "friction"),
        ModelError::Stops { label, .. } => (joint(label), "stops"),
        ModelError::Restitution { label, .. } => (joint(label), "restitution"),
        ModelError::StartState { label, .. } => (joint(label), "state"),
        ModelError::Trigger { label, .. } => (joint(label), "release"),
        ModelError::ReleaseDelay { label, .. } => (Table::Release(index_of(scene, label)), "by"),
        ModelError::TablePoints { table, joint, .. } => {
            let hinge = scene.torque_tables.get(*table).map_or(0, |table| table.hinge);
            (Table::Joint(hinge), joint.force_name())
        }
        ModelError::Rotor { rotor, part, .. } => {
            let key = match (part, &scene.rotors[*rotor].speed) {
                (RotorPart::Body, _) => "body",
                (RotorPart::Axis, _) => "axis",
                (RotorPart::Inertia, _) => "inertia",
                (RotorPart::Speed, RotorSpeed::Constant(_)) => "speed",
                (RotorPart::Speed, RotorSpeed::Table(_)) => "speed_over_time",
            };
            (of_rotor(scene, *rotor), key)
        }
        ModelError::Coupling { label, .. } => (body(label), "coupling"),
        ModelError::HeldBase { quantity, .. } => match quantity {
            BaseQuantity::Velocity => (Table::Initial, "velocity"),
            BaseQuantity::AngularRate => (Table::Initial, "rate"),
        },
        ModelError::Drive { .. } => (Table::MainBody, "drive"),
        ModelError::External { index, part, .. } => {
            let External { kind, ref course, .. } = scene.externals[*index];
            let key = match (part, course, kind) {
                (ExternalPart::Course, Course::Table(_), _) => "over_time",
                (ExternalPart::Course, Course::Pulse { .. }, _) => "until",
                (_, _, ExternalKind::Force) => "force",
                (_, _, ExternalKind::Torque) => "torque",
            };
            (of_external(scene, has_thrust, *index), key)
        }
        // The end of the run, and whatever words cannot say.
        _ => (Table::Run, "end"),
    }
}

/// The key of a table of a body or slice that a defect of its mass properties is of.
pub(crate) fn mass_key(defect: &MassDefect) -> &'static str {
    match defect {
        MassDefect::Mass(_) => "mass",
        MassDefect::CenterOfMass(_) | MassDefect::Overflow { .. } => "mass_centre",
        MassDefect::WheelSlides => Joint::Prismatic.name(),
        _ => "inertia",
    }
}

/// The table of a rotor of a scene.
pub(crate) fn of_rotor(scene: &SceneDescription, rotor: usize) -> Table {
    let body = scene.rotors[rotor].body;
    let before = scene.rotors[..rotor].iter();
    Table::Rotor(body, before.filter(|other| other.body == body).count())
}

/// The table of what acts from outside on a scene with a table of its thrust or without.
pub(crate) fn of_external(scene: &SceneDescription, has_thrust: bool, index: usize) -> Table {
    let External { body, kind, .. } = scene.externals[index];
    let is_after_thrust = has_thrust && body.is_none() && kind == ExternalKind::Force;
    let number = number_on_body(scene, index).checked_sub(usize::from(is_after_thrust));
    number.map_or(Table::Thrust, |number| Table::External(body, kind, number))
}

/// Which one an external is of its kind on its body, in the order in which their tables are read.
fn number_on_body(scene: &SceneDescription, index: usize) -> usize {
    let External { body, kind, .. } = scene.externals[index];
    let before = scene.externals[..index].iter();
    before.filter(|other| other.body == body && other.kind == kind).count()
}

/// Which body of a scene this hinge carries.
pub(crate) fn index_of(scene: &SceneDescription, label: &HingeLabel) -> usize {
    let roots = (0..scene.bodies.len()).filter(|&i| scene.bodies[i].inboard.is_none());
    roots.take(label.appendage + 1).last().unwrap_or_default() + label.segment
}
