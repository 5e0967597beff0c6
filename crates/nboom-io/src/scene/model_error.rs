//! Which place of a scene is responsible for an error found later.

use nboom_model::{
    BodyName, Course, DraftDefect, DraftError, External, ExternalKind, ExternalPart, HingeLabel,
    Joint, MassDefect, ModelError, Scene, SceneDescription, SceneDraft, SegmentStructure,
    Structure, StructureDefect, StructureError,
};

use super::externals::number_on_body;
use super::fields::{Fields, Reader};
use super::sources::Place;
use super::suggest;
use crate::deck::phrases;
use crate::words::{external_table, joint_table};

/// The tables of a scene by what they describe.
pub(super) struct Responsible<'t> {
    pub root: &'t Fields<'t>,
    /// Those of the bodies of the draft.
    pub bodies: &'t [Fields<'t>],
    /// For each body of the scene, which one of the draft it is.
    pub of_draft: Vec<usize>,
}

impl Responsible<'_> {
    pub fn report_draft(
        &self,
        reader: &mut Reader<'_, '_>,
        draft: &SceneDraft,
        error: &DraftError,
    ) {
        let body = &self.bodies[error.body];
        // No body leads to itself.
        let others = || draft.bodies.iter().enumerate().filter(|(i, _)| *i != error.body);
        let names = || others().map(|(_, body)| body.name.as_str());
        let of_hinges = draft.names_for(error.body);
        let meant = |name: &str| {
            let of_hinges = of_hinges.iter().map(String::as_str);
            // The message says what copies are called whose common name this is.
            suggest::nearest(name, of_hinges).filter(|_| names().all(|known| known != name))
        };
        let (at, symbol, help) = match &error.defect {
            DraftDefect::NameTaken(_) => (body.place("name"), "name", None),
            DraftDefect::Inboard { name, .. } => {
                let known = names().chain(["main_body"]);
                (body.place("on"), "on", suggest::nearest(name, known))
            }
            DraftDefect::Circle => (body.place("on"), "on", None),
            DraftDefect::Coupling { name, .. } => {
                let coupling = (0..).map_while(|number| body.nth("coupling", number));
                let leads = |table: &Fields<'_>| reader.text(table, "to") == Some(name);
                let table = coupling.into_iter().find(leads);
                let at = table.map_or_else(|| body.at.clone(), |table| table.place("to"));
                (at, "to", meant(name))
            }
            DraftDefect::TriggerJoint { waits, .. } => {
                let key = match waits {
                    Joint::Revolute => "passes",
                    Joint::Prismatic => "reaches",
                };
                let release = joint_of(body).and_then(|joint| joint.inner("release"));
                let at = release.map_or_else(|| body.at.clone(), |table| table.place(key));
                (at, key, None)
            }
            DraftDefect::Trigger { name, .. } => {
                let release = joint_of(body).and_then(|joint| joint.inner("release"));
                let key = if release.as_ref().is_some_and(|table| table.has("after")) {
                    "after"
                } else {
                    "when"
                };
                let at = release.map_or_else(|| body.at.clone(), |table| table.place(key));
                (at, key, meant(name))
            }
            _ => (body.place("repeat"), "repeat", None),
        };
        let (found, expected) = phrases(&error.defect.to_string());
        let help = help.map(suggest::question);
        reader.report.error_with_help(reader.sources, &at, symbol, &found, &expected, help);
    }

    /// Reports an error of the scene.
    pub fn report(
        &self,
        reader: &mut Reader<'_, '_>,
        scene: &SceneDescription,
        error: &ModelError,
    ) {
        let (table, symbol) = self.responsible(scene, error);
        let message = match error {
            ModelError::Mass { defect, .. } => defect.to_string(),
            other => other.to_string(),
        };
        let at = table.place(symbol);
        if body_of(scene, error).is_some_and(|i| self.is_told(reader, i, &at, symbol)) {
            return;
        }
        let (found, expected) = phrases(&message);
        reader.error(&at, symbol, &found, &expected);
    }

    /// Whether body number `i` is a copy, and what is wrong here of its table has been told of another one.
    fn is_told(&self, reader: &Reader<'_, '_>, i: usize, at: &Place, symbol: &str) -> bool {
        self.is_copy(i) && reader.report.has(reader.sources, at, symbol)
    }

    /// Whether a body before this one is of the same table.
    fn is_copy(&self, i: usize) -> bool {
        self.of_draft.get(i).is_some_and(|draft| self.of_draft[..i].contains(draft))
    }

    fn responsible(
        &self,
        scene: &SceneDescription,
        error: &ModelError,
    ) -> (Fields<'_>, &'static str) {
        let outer = |key: &str| self.root.inner(key).unwrap_or_else(|| self.root.clone());
        let body = |label: &HingeLabel| self.body(index_of(scene, label));
        let hinge = |label: &HingeLabel| {
            let body = body(label);
            joint_of(&body).unwrap_or(body)
        };
        match error {
            ModelError::Mass { body: name, defect } => {
                let table = match name {
                    BodyName::MainBody => outer("main_body"),
                    BodyName::Segment(label) => body(label),
                };
                (table, mass_key(defect))
            }
            ModelError::NotFinite { body: BodyName::Segment(label), quantity } => match *quantity {
                "hinge point or outer end" => (hinge(label), "at"),
                "kick-off spring" => (body(label), "kick_off"),
                _ => (hinge(label), "start"),
            },
            ModelError::NotFinite { quantity, .. } => match *quantity {
                "gravity" => (outer("gravity"), "acceleration"),
                "initial time" | "end time" => (outer("run"), "end"),
                _ => (outer("initial"), "rate"),
            },
            ModelError::Axis { label, .. } => (hinge(label), "axis"),
            ModelError::MountRotation { label, .. } => (hinge(label), "axes"),
            ModelError::HeldRate { label, .. } => (
                hinge(label),
                match label.joint {
                    Joint::Revolute => "rate",
                    Joint::Prismatic => "speed",
                },
            ),
            ModelError::Trigger { label, .. } => (hinge(label), "release"),
            ModelError::ReleaseDelay { label, .. } => {
                let hinge = hinge(label);
                (hinge.inner("release").unwrap_or(hinge), "by")
            }
            ModelError::TablePoints { table, .. } => {
                let number = scene.torque_tables.get(table - 1).map_or(0, |table| table.hinge);
                let body = self.body(number);
                let slides = scene.bodies.get(number).is_some_and(|body| body.joint.slides());
                let key = if slides { "force" } else { "torque" };
                (joint_of(&body).unwrap_or(body), key)
            }
            ModelError::Rotor { rotor, .. } => (self.rotor(scene, rotor - 1), "rotor"),
            ModelError::Coupling { label, .. } => (body(label), "coupling"),
            ModelError::HeldBase { quantity, .. } => match *quantity {
                "velocity" => (outer("initial"), "velocity"),
                _ => (outer("initial"), "rate"),
            },
            ModelError::Drive { .. } => (outer("main_body"), "drive"),
            ModelError::External { index, part, .. } => self.external(scene, *index, *part),
            // The end of the run, and whatever words cannot say.
            _ => (outer("run"), "end"),
        }
    }

    /// The table of a rotor.
    fn rotor(&self, scene: &SceneDescription, index: usize) -> Fields<'_> {
        let body = scene.rotors[index].body;
        let before = scene.rotors[..index].iter();
        let number = before.filter(|other| other.body == body).count();
        let owner = match body {
            None => self.root.inner("main_body").unwrap_or_else(|| self.root.clone()),
            Some(body) => self.body(body),
        };
        owner.nth("rotor", number).unwrap_or(owner)
    }

    /// The table of a force or torque from outside, and the key that is wrong.
    fn external(
        &self,
        scene: &SceneDescription,
        index: usize,
        part: ExternalPart,
    ) -> (Fields<'_>, &'static str) {
        let External { body, kind, ref course, .. } = scene.externals[index];
        let key = match (part, course, kind) {
            (ExternalPart::Course, Course::Table(_), _) => "over_time",
            (ExternalPart::Course, Course::Pulse { .. }, _) => "until",
            (_, _, ExternalKind::Force) => "force",
            (_, _, ExternalKind::Torque) => "torque",
        };
        let thrust = self.root.inner("thrust");
        let number = number_on_body(scene, index);
        let (owner, number) = match (body, kind, thrust) {
            (None, ExternalKind::Force, Some(thrust)) if number == 0 => return (thrust, key),
            (None, kind, thrust) => {
                let first = usize::from(kind == ExternalKind::Force && thrust.is_some());
                (self.root.inner("main_body"), number - first)
            }
            (Some(body), ..) => (Some(self.body(body)), number),
        };
        let owner = owner.unwrap_or_else(|| self.root.clone());
        (owner.nth(external_table(kind), number).unwrap_or(owner), key)
    }

    fn body(&self, number: usize) -> Fields<'_> {
        let draft = self.of_draft.get(number).copied();
        draft.and_then(|draft| self.bodies.get(draft)).unwrap_or(self.root).clone()
    }

    /// The structure of the scene, if a body has stations or all that latch have pulse constants. The motion
    /// follows the bodies; slices that may differ from them give a warning where they do.
    pub fn structure(
        &self,
        reader: &mut Reader<'_, '_>,
        scene: &Scene,
        structures: Vec<Option<SegmentStructure>>,
    ) -> Option<Structure> {
        if structures.iter().all(Option::is_none) {
            return None;
        }
        let has_stations =
            structures.iter().flatten().any(|structure| !structure.stations.is_empty());
        let found = "a body whose hinge latches without it";
        let mut has_all_pulses = true;
        for (i, body) in scene.bodies.iter().enumerate() {
            if body.hinge.lock_angle.is_none() || self.body(i).has("pulse_constant") {
                continue;
            }
            has_all_pulses = false;
            if self.is_copy(i) {
                continue;
            }
            let at = &self.body(i).at;
            if has_stations {
                let expected = "its `pulse_constant`, since bodies of the scene have stations";
                reader.error(at, "pulse_constant", found, expected);
            } else {
                let expected =
                    "that of every body that latches; loads are without pulses of latches";
                reader.report.warn_at(reader.sources, at, "pulse_constant", found, expected);
            }
        }
        if !has_all_pulses {
            return None;
        }
        if !reader.report.errors.is_empty() {
            return None;
        }
        let segments = structures.into_iter().map(Option::unwrap_or_default).collect();
        match Structure::with_differing_slices(scene, segments) {
            Ok((structure, differences)) => {
                for difference in &differences {
                    self.report_structure(reader, scene, difference, Report::Difference);
                }
                for warning in &structure.warnings(scene) {
                    self.report_structure(reader, scene, warning, Report::Warning);
                }
                reader.report.errors.is_empty().then_some(structure)
            }
            Err(errors) => {
                for error in &errors {
                    self.report_structure(reader, scene, error, Report::Error);
                }
                None
            }
        }
    }

    fn report_structure(
        &self,
        reader: &mut Reader<'_, '_>,
        scene: &Scene,
        error: &StructureError,
        report: Report,
    ) {
        let StructureError::Segment { place, defect } = error else { return };
        let i = index_of(scene, &place.segment);
        let body = self.body(i);
        let may_differ = body.has("slices");
        let station = place.station.and_then(|number| body.nth("station", number));
        let (table, symbol) = match (defect, station) {
            (StructureDefect::PulseConstant(_), _) => (body, "pulse_constant"),
            (StructureDefect::Material(_), _) => (body, "material"),
            (
                StructureDefect::Order { .. }
                | StructureDefect::NotAtHinge(_)
                | StructureDefect::SliceInboard { .. },
                Some(table),
            ) => (table, "at"),
            (StructureDefect::SliceMass(_), Some(table)) => (table, "mass"),
            (StructureDefect::Slice(defect), Some(table)) => (table, mass_key(defect)),
            (_, Some(table)) => (table, "section"),
            (_, None) => (body, "station"),
        };
        let at = table.place(symbol);
        if self.is_told(reader, i, &at, symbol) {
            return;
        }
        let (found, expected) = phrases(&defect.to_string());
        match report {
            Report::Error => reader.error(&at, symbol, &found, &expected),
            Report::Difference if !may_differ => {
                let expected = format!("{expected}, or slices = \"differ\"");
                reader.error(&at, symbol, &found, &expected);
            }
            Report::Difference | Report::Warning => {
                reader.report.warn_at(reader.sources, &at, symbol, &found, &expected);
            }
        }
    }
}

enum Report {
    Error,
    Difference,
    Warning,
}

/// The key of a table of a body or slice that a defect of its mass properties is of.
fn mass_key(defect: &MassDefect) -> &'static str {
    match defect {
        MassDefect::Mass(_) => "mass",
        MassDefect::CenterOfMass(_) | MassDefect::Overflow { .. } => "mass_centre",
        MassDefect::WheelSlides => "slide",
        _ => "inertia",
    }
}

/// The hinged body of a scene whose table has what is wrong, if it is one's.
fn body_of(scene: &SceneDescription, error: &ModelError) -> Option<usize> {
    match error {
        ModelError::Mass { body: BodyName::Segment(label), .. }
        | ModelError::NotFinite { body: BodyName::Segment(label), .. }
        | ModelError::Axis { label, .. }
        | ModelError::MountRotation { label, .. }
        | ModelError::Trigger { label, .. }
        | ModelError::ReleaseDelay { label, .. }
        | ModelError::HeldRate { label, .. }
        | ModelError::Coupling { label, .. } => Some(index_of(scene, label)),
        ModelError::TablePoints { table, .. } => Some(scene.torque_tables.get(table - 1)?.hinge),
        ModelError::Rotor { body, .. } => *body,
        ModelError::External { index, .. } => scene.externals[*index].body,
        _ => None,
    }
}

/// The table of a body's joint.
fn joint_of<'t>(body: &Fields<'t>) -> Option<Fields<'t>> {
    [Joint::Revolute, Joint::Prismatic].into_iter().find_map(|of| body.inner(joint_table(of)))
}

/// Which body of a scene this hinge carries.
fn index_of(scene: &SceneDescription, label: &HingeLabel) -> usize {
    let roots = (0..scene.bodies.len()).filter(|&i| scene.bodies[i].inboard.is_none());
    roots.take(label.appendage + 1).last().unwrap_or_default() + label.segment
}
