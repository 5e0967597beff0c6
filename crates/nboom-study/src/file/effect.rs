//! Numbers and faults of a study that change nothing.

use nboom_io::{SceneDocument, SceneFile, Slot};
use nboom_model::HingeLabel;

use super::overlap::moves;
use super::reader::{Fields, Reader, quoted};
use super::relevant::Relevant;
use crate::case::broken;
use crate::hinges;
use crate::study::{Change, Fault, Relation, RunSettings, Variable};

/// Shares of a distribution at which a variable is tried.
const TRIED: [f64; 5] = [0.01, 0.25, 0.5, 0.75, 0.99];

/// The share at which variables are when something has no effect on the scene as it stands.
const ELSEWHERE: f64 = 0.3;

/// By how much numbers are moved to see whether anything depends on them; whole, as counts are.
const MOVES: [f64; 2] = [2.0, -1.0];

/// Lists of hinges of a fault that the rest of it may leave nothing to do, by their keys.
const PARTS: [(&str, Part); 3] = [
    ("failed_latch", |fault| &mut fault.failed_latch),
    ("broken_spring", |fault| &mut fault.broken_spring),
    ("missed_release", |fault| &mut fault.missed_release),
];

type Part = fn(&mut Fault) -> &mut Vec<usize>;

/// What runs of a study are made of.
struct Runs<'a> {
    document: SceneDocument,
    run: &'a RunSettings,
    /// What is broken, but for its changes, which are in the document.
    fault: Option<&'a Fault>,
}

/// What becomes of runs where a number is tried.
#[derive(Clone, Copy, PartialEq)]
enum Tried {
    NoScene,
    /// It is the number that is there.
    Untouched,
    Same,
    Other,
}

impl<'a> Runs<'a> {
    /// Those in which a fault is there.
    fn with_fault<'b>(&self, fault: &'b Fault) -> Runs<'b>
    where
        'a: 'b,
    {
        let of = |Change { slot, relation, number }: &'b Change| {
            (slot, relation.applied(*number, || self.document.number(slot)))
        };
        let document = self.document.with(&fault.changes.iter().map(of).collect::<Vec<_>>());
        Runs { document, run: self.run, fault: Some(fault) }
    }

    /// What runs with these numbers depend on, if they make a scene.
    fn relevant(&self, values: &[(&Slot, f64)]) -> Option<Relevant> {
        let file = self.document.scene(values).ok()?;
        let file = match self.fault {
            Some(fault) => broken(file, fault).ok()?,
            None => file,
        };
        Relevant::of(&file, self.run)
    }

    /// Whether any of these numbers at these places makes another run, or if they happen to be those that are there,
    /// whether others would; unknown where not even those that are there make a scene.
    fn depend_on(&self, (slots, relation, numbers): Numbers<'_>) -> Option<bool> {
        let nominal = self.relevant(&[])?;
        let tried = |relation: Relation, number: f64| {
            let there = |slot| self.document.number(slot);
            let value = |slot| (slot, relation.applied(number, || there(slot)));
            let values: Vec<_> = slots.iter().map(value).collect();
            if values.iter().all(|&(slot, value)| value == there(slot)) {
                return Tried::Untouched;
            }
            match self.relevant(&values) {
                None => Tried::NoScene,
                Some(found) if found == nominal => Tried::Same,
                Some(_) => Tried::Other,
            }
        };
        // A factor leaves zero as it is, whatever others would do to it.
        let moving = if relation == Relation::Factor { relation } else { Relation::Offset };
        let given: Vec<Tried> = numbers.iter().map(|&number| tried(relation, number)).collect();
        let moved = MOVES.map(|by| tried(moving, by));
        let any = |found: Tried| given.iter().chain(&moved).any(|&tried| tried == found);
        // Numbers that make no scene are told case by case, unless others show that nothing depends on them.
        Some(any(Tried::Other) || (given.contains(&Tried::NoScene) && !any(Tried::Same)))
    }
}

/// Numbers, and what becomes of those at these places with them.
type Numbers<'a> = (&'a [Slot], Relation, &'a [f64]);

/// Whether none of these runs depends on numbers.
fn ignore(runs: &[Runs<'_>; 2], numbers: Numbers<'_>) -> bool {
    let known = runs.each_ref().map(|runs| runs.depend_on(numbers));
    known.contains(&Some(false)) && !known.contains(&Some(true))
}

/// Whether all these runs are the same with one fault as with another.
fn are_alike(runs: &[Runs<'_>; 2], [one, another]: [&Fault; 2]) -> bool {
    let known = runs.each_ref().map(|runs| {
        let of = |fault| runs.with_fault(fault).relevant(&[]);
        Some(of(one)? == of(another)?)
    });
    known.contains(&Some(true)) && !known.contains(&Some(false))
}

/// Runs of the scene as it stands, and of one in which these variables have other numbers.
fn runs_of<'a, 'v>(
    (document, run): (&SceneDocument, &'a RunSettings),
    variables: impl Iterator<Item = &'v Variable>,
) -> [Runs<'a>; 2] {
    let of = |Variable { slots, relation, distribution, .. }: &'v Variable| {
        let drawn = distribution.quantile(ELSEWHERE);
        slots.iter().map(move |slot| (slot, relation.applied(drawn, || document.number(slot))))
    };
    let elsewhere: Vec<(&Slot, f64)> = variables.flat_map(of).collect();
    let documents = [document.clone(), document.with(&elsewhere)];
    documents.map(|document| Runs { document, run, fault: None })
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
    /// Reports variables, and what of faults, on which no run depends; nothing else is wrong.
    pub fn check_effects(
        &mut self,
        [varied, faulty]: [&[Fields<'t>]; 2],
        (variables, faults): (&[Variable], &[Fault]),
        (document, nominal, run): (&SceneDocument, &SceneFile, &RunSettings),
    ) {
        for (number, (of, variable)) in varied.iter().zip(variables).enumerate() {
            let Variable { slots, relation, distribution, .. } = variable;
            let others = variables.iter().enumerate().filter(|(i, _)| *i != number);
            let runs = runs_of((document, run), others.map(|(_, other)| other));
            let numbers = TRIED.map(|share| distribution.quantile(share));
            if ignore(&runs, (slots, *relation, &numbers)) {
                let key = if of.has("path") { "path" } else { "paths" };
                let found = format!("a number without effect, {}", quoted(&variable.name));
                let expected = "a number that runs depend on, which [run] does not override";
                self.error(&of.place_of(key), key, found, expected);
            }
        }
        let runs = runs_of((document, run), variables.iter());
        for (of, fault) in faulty.iter().zip(faults) {
            let left = self.check_changes(of, fault, variables, &runs);
            self.check_parts(of, left, nominal.scene.labels(), &runs);
        }
    }

    /// Reports changes of a fault without effect beside the rest of it, and returns the fault without them.
    fn check_changes(
        &mut self,
        of: &Fields<'t>,
        fault: &Fault,
        variables: &[Variable],
        runs: &[Runs<'_>; 2],
    ) -> Fault {
        let document = &runs[0].document;
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
            let beside = runs.each_ref().map(|runs| runs.with_fault(&others));
            if ignore(&beside, (std::slice::from_ref(slot), *relation, &[*number])) {
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
        runs: &[Runs<'_>; 2],
    ) {
        for (key, part) in PARTS {
            for hinge in part(&mut left).clone() {
                let mut others = left.clone();
                part(&mut others).retain(|&other| other != hinge);
                if are_alike(runs, [&left, &others]) {
                    let name = quoted(&hinges::name(&labels[hinge]));
                    let found =
                        format!("{name}, of which the rest of the fault leaves nothing to break");
                    self.error(&of.place_of(key), key, found, "hinges on which this has an effect");
                    left = others;
                }
            }
        }
    }
}
