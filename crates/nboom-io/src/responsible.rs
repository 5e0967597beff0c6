//! Which table and key of a scene is responsible for an error found later; files and words have the same.

use nboom_model::{
    BodyName, Course, External, ExternalKind, ExternalPart, HingeLabel, Joint, MassDefect,
    ModelError, Rotor, RotorSpeed, SceneDescription,
};

use crate::deck::phrases;

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
            Self::Body(i) | Self::Joint(i) | Self::Release(i) => Some(i),
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
        ModelError::NotFinite { body: Some(BodyName::Segment(label)), quantity } => match *quantity
        {
            "hinge point or outer end" => (joint(label), "at"),
            "hinge spring" => (joint(label), "spring"),
            "hinge dashpot" => (joint(label), "damper"),
            "lock angle" => (joint(label), "latch"),
            "release" => (joint(label), "release"),
            "kick-off spring" => (body(label), "kick_off"),
            _ => (joint(label), "start"),
        },
        ModelError::NotFinite { quantity, .. } | ModelError::NotUnit { quantity, .. } => {
            match *quantity {
                "initial time" => (Table::Run, "start"),
                "initial position" => (Table::Initial, "position"),
                "initial velocity" => (Table::Initial, "velocity"),
                "initial angular rate" => (Table::Initial, "rate"),
                "initial attitude" => (Table::Initial, "attitude"),
                "gravity" => (Table::Gravity, "acceleration"),
                "direction of gravity" => (Table::Gravity, "up"),
                _ => (Table::Run, "end"),
            }
        }
        ModelError::Axis { label, .. } => (joint(label), "axis"),
        ModelError::MountRotation { label, .. } => (joint(label), "axes"),
        ModelError::HeldRate { label, .. } => (
            joint(label),
            match label.joint {
                Joint::Revolute => "rate",
                Joint::Prismatic => "speed",
            },
        ),
        ModelError::Trigger { label, .. } => (joint(label), "release"),
        ModelError::ReleaseDelay { label, .. } => (Table::Release(index_of(scene, label)), "by"),
        ModelError::TablePoints { table, joint, .. } => {
            let hinge = scene.torque_tables.get(table - 1).map_or(0, |table| table.hinge);
            (Table::Joint(hinge), if joint.slides() { "force" } else { "torque" })
        }
        ModelError::Rotor { rotor, quantity, .. } => {
            let Rotor { body, ref speed, .. } = scene.rotors[rotor - 1];
            let before = scene.rotors[..rotor - 1].iter();
            let number = before.filter(|other| other.body == body).count();
            let key = match (*quantity, speed) {
                ("speed", RotorSpeed::Table(_)) => "speed_over_time",
                (quantity, _) => quantity,
            };
            (Table::Rotor(body, number), key)
        }
        ModelError::Coupling { label, .. } => (body(label), "coupling"),
        ModelError::HeldBase { quantity, .. } => match *quantity {
            "velocity" => (Table::Initial, "velocity"),
            _ => (Table::Initial, "rate"),
        },
        ModelError::Drive { .. } => (Table::MainBody, "drive"),
        ModelError::External { index, part, .. } => {
            let External { body, kind, ref course, .. } = scene.externals[*index];
            let key = match (part, course, kind) {
                (ExternalPart::Course, Course::Table(_), _) => "over_time",
                (ExternalPart::Course, Course::Pulse { .. }, _) => "until",
                (_, _, ExternalKind::Force) => "force",
                (_, _, ExternalKind::Torque) => "torque",
            };
            let is_after_thrust = has_thrust && body.is_none() && kind == ExternalKind::Force;
            let number = number_on_body(scene, *index).checked_sub(usize::from(is_after_thrust));
            (number.map_or(Table::Thrust, |number| Table::External(body, kind, number)), key)
        }
        // The end of the run, and whatever words cannot say.
        _ => (Table::Run, "end"),
    }
}

/// What was found and what expected, without the place, with which messages of most errors begin.
pub(crate) fn found_and_expected(error: &ModelError) -> (String, String) {
    let message = error.to_string();
    let has_place = !matches!(
        error,
        ModelError::NotFinite { body: None, .. }
            | ModelError::NotUnit { .. }
            | ModelError::EndTime { .. }
            | ModelError::External { .. }
    );
    let told = message.split_once(": ").filter(|_| has_place).map_or(&*message, |(_, told)| told);
    phrases(told)
}

/// The key of a table of a body or slice that a defect of its mass properties is of.
pub(crate) fn mass_key(defect: &MassDefect) -> &'static str {
    match defect {
        MassDefect::Mass(_) => "mass",
        MassDefect::CenterOfMass(_) | MassDefect::Overflow { .. } => "mass_centre",
        MassDefect::WheelSlides => "slide",
        _ => "inertia",
    }
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
