//! Where the file of a scene has what is responsible for an error found later.

use nboom_model::{
    DraftDefect, DraftError, Finding, Joint, ModelError, Scene, SceneDescription, SceneDraft,
    SegmentStructure, Structure, StructureDefect, StructureError,
};

use super::fields::{Fields, Reader};
use super::sources::Place;
use super::suggest;
use crate::responsible::{Table, index_of, mass_key, responsible};
use crate::words::external_table;

/// The tables of a scene in a file by what they describe.
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
                let key = waits.passes_name();
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
        let Finding { found, expected } = error.defect.finding();
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
        let (table, symbol) = responsible(scene, self.root.inner("thrust").is_some(), error);
        let fields = self.fields(table);
        let (at, symbol) = (fields.place(symbol), fields.written(symbol));
        if table.body().is_some_and(|i| self.is_told(reader, i, &at, symbol)) {
            return;
        }
        let Finding { found, expected } = error.finding();
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

    /// Where a table stands; that which has it, where it is not given.
    fn fields(&self, table: Table) -> Fields<'_> {
        let outer = |key: &str| self.root.inner(key).unwrap_or_else(|| self.root.clone());
        let owner = |body: Option<usize>| body.map_or_else(|| outer("main_body"), |i| self.body(i));
        let joint = |i| {
            let body = self.body(i);
            joint_of(&body).unwrap_or(body)
        };
        match table {
            Table::Run => outer("run"),
            Table::Initial => outer("initial"),
            Table::Gravity => outer("gravity"),
            Table::MainBody => outer("main_body"),
            Table::Body(i) => self.body(i),
            Table::Joint(i) => joint(i),
            Table::Release(i) => {
                let joint = joint(i);
                joint.inner("release").unwrap_or(joint)
            }
            Table::KickOff(i) => {
                let body = self.body(i);
                body.inner("kick_off").unwrap_or(body)
            }
            Table::Rotor(body, number) => {
                let owner = owner(body);
                owner.nth("rotor", number).unwrap_or(owner)
            }
            Table::Thrust => outer("thrust"),
            Table::External(body, kind, number) => {
                let owner = owner(body);
                owner.nth(external_table(kind), number).unwrap_or(owner)
            }
        }
    }

    fn body(&self, number: usize) -> Fields<'_> {
        let draft = self.of_draft.get(number).copied();
        draft.and_then(|draft| self.bodies.get(draft)).unwrap_or(self.root).clone()
    }

    /// The structure of the scene, if a body has stations or all with a latch or stops have pulse constants. The motion
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
        let found = "a body whose hinge has a latch or stops, without it";
        let mut has_all_pulses = true;
        for (i, body) in scene.bodies.iter().enumerate() {
            if !body.hinge.has_latch_or_stop() {
                self.warn_of_idle_pulse(reader, i);
            }
            if !body.hinge.may_be_struck() || self.body(i).has("pulse_constant") {
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
                    "that of every such body; loads are without pulses of latches and stops";
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

    /// Warns of the pulse constant of a body without latch and stops.
    fn warn_of_idle_pulse(&self, reader: &mut Reader<'_, '_>, i: usize) {
        let at = self.body(i).place("pulse_constant");
        if self.body(i).has("pulse_constant") && !self.is_told(reader, i, &at, "pulse_constant") {
            let (found, expected) =
                ("one of a body without latch and stops", "a latch, stops, or none");
            reader.report.warn_at(reader.sources, &at, "pulse_constant", found, expected);
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
            (StructureDefect::PulseConstant(_) | StructureDefect::LongPulse { .. }, _) => {
                (body, "pulse_constant")
            }
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
        let Finding { found, expected } = defect.finding();
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

/// The table of a body's joint.
fn joint_of<'t>(body: &Fields<'t>) -> Option<Fields<'t>> {
    Joint::ALL.into_iter().find_map(|of| body.inner(of.name()))
}
