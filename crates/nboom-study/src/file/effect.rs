//! Numbers and faults of a study that change nothing.

use nboom_io::{SceneDocument, SceneFile};
use nboom_model::HingeLabel;

use super::overlap::moves;
use super::reader::{Fields, Reader, quoted};
use super::situations::{Situations, are_alike, ignore};
use crate::hinges;
use crate::study::{Change, FailureMode, Fault, Relation, RunSettings, Variable};

/// Shares of a distribution at which a variable is tried.
const TRIED: [f64; 5] = [0.01, 0.25, 0.5, 0.75, 0.99];

/// Failures that the rest of a fault may leave nothing to break.
const PARTS: [FailureMode; 3] =
    [FailureMode::FailedLatch, FailureMode::BrokenSpring, FailureMode::MissedRelease];

/// Whether a change leaves the number that it finds as it is: that of the scene, if no variable moves it.
fn stays(
    Change { slot, relation, number }: &Change,
    variables: &[&Variable],
    document: &SceneDocument,
) -> bool {
    let is_moved = |Variable { slots, .. }: &&Variable| {
        let mut all = slots.iter();
        all.any(|of| of == slot || moves(document, of, std::slice::from_ref(slot)))
    };
    match relation {
        Relation::Factor => *number == 1.0,
        Relation::Offset => *number == 0.0,
        Relation::Value => *number == document.number(slot) && !variables.iter().any(is_moved),
    }
}

impl<'t> Reader<'t> {
    /// Reports variables, and what of faults, on which no run depends; nothing else is wrong.
    pub fn check_effects(
        &mut self,
        [varied, faulty]: [&[Fields<'t>]; 2],
        (variables, faults): (&[Variable], &[Fault]),
        (document, nominal, run): (&SceneDocument, &SceneFile, &RunSettings),
    ) {
        let hinges = nominal.scene.bodies.len();
        let beside = |left_out: Option<usize>| {
            let others = variables.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
            let variables = others.map(|(_, other)| other).collect();
            Situations { document, hinges, run, variables }
        };
        for (number, (of, variable)) in varied.iter().zip(variables).enumerate() {
            let Variable { slots, relation, distribution, .. } = variable;
            let numbers = TRIED.map(|share| distribution.quantile(share));
            let beside = beside(Some(number));
            if ignore(beside.all_with(faults), (slots, *relation, &numbers)) {
                let key = if of.has("path") { "path" } else { "paths" };
                let found = format!("a number without effect, {}", quoted(&variable.name));
                let expected = "a number that runs depend on, which [run] does not override";
                self.error(&of.place_of(key), key, found, expected);
            }
        }
        let beside = beside(None);
        for (of, fault) in faulty.iter().zip(faults) {
            let left = self.check_changes(of, fault, &beside);
            self.check_parts(of, left, nominal.scene.labels(), &beside);
        }
    }

    /// Reports changes of a fault without effect beside the rest of it, and returns the fault without them.
    fn check_changes(&mut self, of: &Fields<'t>, fault: &Fault, beside: &Situations<'_>) -> Fault {
        let Situations { document, variables, .. } = beside;
        let mut left = fault.clone();
        for (inner, change) in self.tables(of, "change").iter().zip(&fault.changes) {
            let Change { slot, relation, number } = change;
            let place = inner.place_of("path");
            let replaced = variables.iter().find(|of| moves(document, slot, &of.slots));
            if let Some(Variable { name, .. }) = replaced {
                let found = format!("a number that {} takes no notice of", quoted(name));
                let expected = "the number that is varied, or a variable that follows from it";
                self.error(&place, "path", found, expected);
                continue;
            }
            if stays(change, variables, document) {
                self.error(&place, "change", "a number that stays as it is", "a change");
                continue;
            }
            let mut others = left.clone();
            others.changes.retain(|other| other.slot != *slot);
            let beside = beside.all().map(|runs| runs.with_fault(&others));
            if ignore(beside, (std::slice::from_ref(slot), *relation, &[*number])) {
                let expected = "a number that runs depend on, which neither [run] nor the rest of the fault overrides";
                self.error(&place, "path", "a number without effect", expected);
                left = others;
            }
        }
        left
    }

    /// Reports hinges of a fault to which the rest of it leaves nothing to do.
    fn check_parts(
        &mut self,
        of: &Fields<'t>,
        mut left: Fault,
        labels: &[HingeLabel],
        beside: &Situations<'_>,
    ) {
        for mode in PARTS {
            for hinge in left.hinges(mode).collect::<Vec<_>>() {
                let mut others = left.clone();
                others.failures.retain(|&other| other != (mode, hinge));
                if are_alike(beside.all(), [&left, &others]) {
                    let name = quoted(&hinges::name(&labels[hinge]));
                    let found =
                        format!("{name}, of which the rest of the fault leaves nothing to break");
                    let (key, expected) = (mode.name(), "hinges on which this has an effect");
                    self.error(&of.place_of(key), key, found, expected);
                    left = others;
                }
            }
        }
    }
}
