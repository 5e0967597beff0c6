//! What may be broken.

use nboom_io::{SceneDocument, SceneFile, nearest};
use nboom_model::{Hinge, HingeLabel, HingeState, Release, Scene, Spring};

use super::keys::FAULT;
use super::overlap::{Changed, overlaps};
use super::reader::{At, Fields, Reader, quoted};
use crate::fault::FaultError;
use crate::hinges;
use crate::study::{Change, FailureMode, Fault, LateRelease, Relation};

/// What pages call cases without fault.
const NO_FAULT: &str = "no fault";

/// Keys of what a fault breaks.
fn breaks() -> impl Iterator<Item = &'static str> {
    FAULT.keys.iter().map(|key| key.name).filter(|name| *name != "name")
}

/// What a hinge is that cannot fail so, and which hinges can.
fn misfit(mode: FailureMode, hinge: &Hinge) -> Option<[&'static str; 2]> {
    let (fits, misfit) = match mode {
        FailureMode::Stuck => return None,
        FailureMode::MissedRelease => (
            hinge.start.state == HingeState::Unreleased,
            ["a hinge that is not released at all", "hinges that start unreleased"],
        ),
        FailureMode::FailedLatch => {
            (hinge.lock_angle.is_some(), ["a hinge without latch", "hinges with latch"])
        }
        FailureMode::BrokenSpring => (
            hinge.spring != Spring::default() || hinge.kick_off.is_some(),
            ["a hinge without spring or kick-off spring", "hinges with spring or kick-off spring"],
        ),
    };
    (!fits).then_some(misfit)
}

impl<'t> Reader<'t> {
    /// A fault of a scene.
    pub fn fault(
        &mut self,
        of: &Fields<'t>,
        document: &SceneDocument,
        nominal: &SceneFile,
    ) -> Option<Fault> {
        let before = self.errors.len();
        let mut failures = Vec::new();
        for mode in FailureMode::ALL {
            let hinges = self.hinges(of, mode.name(), &nominal.scene);
            failures.extend(hinges.into_iter().map(|hinge| (mode, hinge)));
        }
        let late_release = self.late_releases(of, &nominal.scene, &failures);
        let changes = self.changes(of, document);
        let name = self.text(of, "name")?;
        if name.value.trim().is_empty() || name.value.contains(char::is_control) {
            self.error(&name.place, "name", quoted(name.value), "a name in one line");
        } else if name.value.trim() == NO_FAULT {
            let expected = "a name that does not stand for cases without one";
            self.error(&name.place, "name", quoted(name.value), expected);
        }
        let name = name.value.to_owned();
        let fault = Fault { name, failures, late_release, changes };
        for mode in FailureMode::ALL {
            let (key, bodies) = (mode.name(), &nominal.scene.bodies);
            let hinges = || fault.hinges(mode).map(|i| &bodies[i].hinge);
            if hinges().any(|hinge| !hinge.can_turn()) {
                let found = "a hinge that is held or locked all the time";
                self.error(&of.place_of(key), key, found, "hinges that move");
            }
            if let Some([found, expected]) = hinges().find_map(|hinge| misfit(mode, hinge)) {
                self.error(&of.place_of(key), key, found, expected);
            }
        }
        for key in breaks().filter(|key| of.has_empty_list(key)) {
            self.error(&of.place_of(key), key, "an empty list", "at least one entry");
        }
        if !breaks().any(|key| of.has(key)) {
            let expected = breaks().collect::<Vec<_>>().join(", or ");
            self.error(&of.place(), "fault", "nothing that is broken", expected);
        }
        if self.errors.len() == before {
            self.try_fault(of, &fault, nominal);
        }
        Some(fault)
    }

    /// Reports a fault that makes no scene of one that is right.
    fn try_fault(&mut self, of: &Fields<'t>, fault: &Fault, nominal: &SceneFile) {
        let mut description = (*nominal.scene).clone();
        if let Err(error) = fault.apply(&mut description) {
            self.error(&of.place(), "fault", error.found(), FaultError::EXPECTED);
        } else if let Err(errors) = nominal.scene.with_description(description) {
            let why = errors.first().map_or_else(String::new, ToString::to_string);
            let found = format!("no scene ({why})");
            self.error(&of.place(), "fault", found, "a fault that leaves one");
        }
    }

    fn hinges(&mut self, of: &Fields<'t>, key: &'static str, scene: &Scene) -> Vec<usize> {
        let mut found = Vec::new();
        for name in self.texts(of, key).unwrap_or_default() {
            let Some(hinge) = self.hinge(&name, scene) else { continue };
            self.require_once(&name, found.contains(&hinge));
            found.push(hinge);
        }
        found
    }

    fn require_once(&mut self, name: &At<&str>, is_there: bool) {
        if is_there {
            let found = format!("{}, a hinge that is there before", quoted(name.value));
            self.error(&name.place, name.key, found, "each hinge once");
        }
    }

    /// A hinge by the name of its body or by its numbers.
    fn hinge(&mut self, name: &At<&str>, scene: &Scene) -> Option<usize> {
        let found = HingeLabel::find(scene.labels(), name.value);
        if found.is_none() {
            let known: Vec<String> = scene.labels().iter().map(hinges::name).collect();
            let meant = nearest(name.value, known.iter().map(String::as_str));
            let expected = "a hinge, by the name of its body or by its numbers as 1,2";
            self.error_like(&name.place, name.key, quoted(name.value), expected, meant);
        }
        found
    }

    /// Late releases, but of hinges that are not released at all by failures of the fault.
    fn late_releases(
        &mut self,
        of: &Fields<'t>,
        scene: &Scene,
        failures: &[(FailureMode, usize)],
    ) -> Vec<LateRelease> {
        let mut found = Vec::new();
        for inner in self.tables(of, "late_release") {
            let name = self.text(&inner, "hinge");
            let hinge = name.as_ref().and_then(|name| self.hinge(name, scene));
            let by = self.number(&inner, "by");
            if let Some(by) = by.as_ref().filter(|by| by.value <= 0.0) {
                self.error(&by.place, "by", by.value.to_string(), "a number above zero");
            }
            let (Some(name), Some(hinge), Some(by)) = (name, hinge, by) else { continue };
            self.require_once(&name, found.iter().any(|late: &LateRelease| late.hinge == hinge));
            let of_scene = &scene.bodies[hinge].hinge;
            if let Some([found, expected]) = misfit(FailureMode::MissedRelease, of_scene) {
                self.error(&inner.place_of("hinge"), "hinge", found, expected);
            }
            let is_free = of_scene.start.state != HingeState::Unreleased;
            let keeps = [FailureMode::Stuck, FailureMode::MissedRelease];
            let gone = keeps.into_iter().find(|mode| failures.contains(&(*mode, hinge)));
            let why = match (gone, of_scene.release) {
                (Some(mode), _) => {
                    Some(format!("which {} of the fault keeps from it", mode.name()))
                }
                (None, Release::Angle { .. }) => Some("by another hinge's angle".to_owned()),
                (None, Release::Never) if !is_free => Some("never".to_owned()),
                (None, _) => None,
            };
            if let Some(why) = why {
                let found = format!("the release of {}, {why}", quoted(name.value));
                self.error(&name.place, name.key, found, "one by time, or after a lock-up");
            }
            found.push(LateRelease { hinge, by: by.value });
        }
        found
    }

    fn changes(&mut self, of: &Fields<'t>, document: &SceneDocument) -> Vec<Change> {
        let (mut found, mut places) = (Vec::new(), Vec::new());
        for inner in self.tables(of, "change") {
            let path = self.text(&inner, "path");
            let slot = path.and_then(|path| self.slot(document, &path));
            let given: Vec<Relation> =
                Relation::ALL.into_iter().filter(|relation| inner.has(relation.name())).collect();
            let [relation] = given[..] else {
                let names: Vec<&str> = given.into_iter().map(Relation::name).collect();
                let found =
                    if names.is_empty() { "nothing".to_owned() } else { names.join(" and ") };
                let expected = format!("one of {}", Relation::ALL.map(Relation::name).join(", "));
                self.error(&inner.place(), "change", found, expected);
                continue;
            };
            let number = self.number(&inner, relation.name());
            if let (Some(slot), Some(number)) = (slot, number) {
                found.push(Change { slot, relation, number: number.value });
                places.push(inner.place_of("path"));
            }
        }
        let changed: Vec<_> = found.iter().map(Changed::by_fault).collect();
        for [later, _] in overlaps(document, &changed) {
            let found = "a number that the fault changes before";
            self.error(&places[later], "path", found, "each number in one change");
        }
        found
    }
}
