//! Numbers of a study that change nothing.

use nboom_io::{SceneDocument, SceneFile, Slot};
use nboom_model::SegmentStructure;

use super::overlap::moves;
use super::reader::{Fields, Reader, quoted};
use crate::study::{Change, Fault, Relation, RunSettings, Variable};
use crate::wanted::Loads;

/// Shares of a distribution at which a variable is tried.
const TRIED: [f64; 5] = [0.01, 0.25, 0.5, 0.75, 0.99];

/// The share at which others are when a variable has no effect on the scene as it stands.
const ELSEWHERE: f64 = 0.3;

/// By how much numbers are moved to see whether anything depends on them.
const MOVES: [f64; 2] = [1.5, -1.0];

/// What runs of a study are made of.
pub(super) struct Runs<'a> {
    pub document: &'a SceneDocument,
    pub nominal: &'a SceneFile,
    pub run: &'a RunSettings,
}

impl Runs<'_> {
    /// Whether any of these numbers at these places makes another run, or if they happen to be those that are there,
    /// whether others would.
    fn depend_on(&self, slots: &[Slot], relation: Relation, numbers: &[f64]) -> bool {
        let is_other = |relation: Relation, number: f64| {
            let value = |slot| relation.applied(number, || self.document.number(slot));
            let values: Vec<_> = slots.iter().map(|slot| (slot, value(slot))).collect();
            self.document.scene(&values).ok().map(|file| !self.are_those_of(&file))
        };
        // A factor leaves zero as it is, whatever others would do to it.
        let moved = if relation == Relation::Factor { relation } else { Relation::Offset };
        // Numbers that make no scene have an effect, which is told case by case; moved ones may only be too far.
        numbers.iter().any(|&number| is_other(relation, number).unwrap_or(true))
            || MOVES.iter().any(|&by| is_other(moved, by).unwrap_or(false))
    }

    /// Whether runs depend on a variable where all others have other numbers than the scene.
    fn depend_beside_others(&self, variables: &[Variable], number: usize) -> bool {
        let others = variables.iter().enumerate().filter(|(i, _)| *i != number);
        let values: Vec<(&Slot, f64)> = others
            .flat_map(|(_, Variable { slots, relation, distribution, .. })| {
                let drawn = distribution.quantile(ELSEWHERE);
                let value = move |slot| relation.applied(drawn, || self.document.number(slot));
                slots.iter().map(move |slot| (slot, value(slot)))
            })
            .collect();
        let document = self.document.with(&values);
        let Ok(nominal) = document.scene(&[]) else { return false };
        let Variable { slots, relation, distribution, .. } = &variables[number];
        let numbers = TRIED.map(|share| distribution.quantile(share));
        let runs = Runs { document: &document, nominal: &nominal, run: self.run };
        runs.depend_on(slots, *relation, &numbers)
    }

    /// What stresses depend on; a yield stress of the runs takes the place of those of materials.
    fn judged(&self, file: &SceneFile) -> Option<Vec<SegmentStructure>> {
        let mut segments = file.structure.as_ref()?.segments().to_vec();
        if self.run.strength.yield_stress.is_some() {
            segments.iter_mut().for_each(|segment| segment.material.yield_stress = None);
        }
        Some(segments)
    }

    /// Whether runs of this scene are those of the scene as it stands.
    fn are_those_of(&self, file: &SceneFile) -> bool {
        let scene = |file: &SceneFile| self.run.scene(file).ok();
        let has_loads = Loads::of(self.nominal, self.run) > Loads::None;
        let is_sampled_alike =
            self.run.samples.is_some() || file.settings.sampling == self.nominal.settings.sampling;
        scene(file) == scene(self.nominal)
            && is_sampled_alike
            && (!has_loads || self.judged(file) == self.judged(self.nominal))
    }
}

/// Whether a change leaves the number that it finds as it is: that of the scene, if no variable moves it.
fn stays(
    Change { slot, relation, number }: &Change,
    variables: &[Variable],
    document: &SceneDocument,
) -> bool {
    let is_moved = |Variable { slots, .. }: &Variable| {
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
    /// Reports variables, and changes of faults, on which no run depends; nothing else is wrong.
    pub fn check_effects(
        &mut self,
        [varied, faulty]: [&[Fields<'t>]; 2],
        (variables, faults): (&[Variable], &[Fault]),
        runs: &Runs<'_>,
    ) {
        let expected = "a number that runs depend on, which [run] does not override";
        for (number, (of, variable)) in varied.iter().zip(variables).enumerate() {
            let Variable { slots, relation, distribution, .. } = variable;
            let numbers = TRIED.map(|share| distribution.quantile(share));
            if !runs.depend_on(slots, *relation, &numbers)
                && !runs.depend_beside_others(variables, number)
            {
                let key = if of.has("path") { "path" } else { "paths" };
                let found = format!("a number without effect, {}", quoted(&variable.name));
                self.error(&of.place_of(key), key, found, expected);
            }
        }
        for (of, fault) in faulty.iter().zip(faults) {
            for (inner, change) in self.tables(of, "change").iter().zip(&fault.changes) {
                let Change { slot, relation, number } = change;
                let place = inner.place_of("path");
                let replaced = variables.iter().find(|of| moves(runs.document, slot, &of.slots));
                if let Some(Variable { name, .. }) = replaced {
                    let found = format!("a number that {} takes no notice of", quoted(name));
                    let expected = "the number that is varied, or a variable that follows from it";
                    self.error(&place, "path", found, expected);
                } else if stays(change, variables, runs.document) {
                    let expected = "a change";
                    self.error(&place, "change", "a number that stays as it is", expected);
                } else if !runs.depend_on(std::slice::from_ref(slot), *relation, &[*number]) {
                    self.error(&place, "path", "a number without effect", expected);
                }
            }
        }
    }
}
