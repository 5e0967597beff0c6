//! What a number of a study stands beside: other variables and what is broken.

use nboom_io::{SceneDocument, Slot};

use super::relevant::Relevant;
use crate::case::broken;
use crate::distribution::Distribution;
use crate::study::{Change, Fault, Relation, RunSettings, Variable};

/// Shares of their distributions at which all variables are first.
const SHARES: [f64; 5] = [0.3, 0.01, 0.5, 0.7, 0.99];

/// How often each variable is then at a share of its own.
const SCATTERED: usize = 12;

/// How often after that each number of a list comes, beside others of other lists.
const ROUNDS: usize = 3;

/// By how much numbers are moved to see whether anything depends on them; whole, as counts are.
const MOVES: [f64; 2] = [2.0, -1.0];

/// What runs of a study are made of.
pub(super) struct Runs<'a> {
    /// With what is drawn.
    document: SceneDocument,
    run: &'a RunSettings,
    /// How many hinges there are, which faults count.
    hinges: usize,
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
    pub fn with_fault<'b>(&self, fault: &'b Fault) -> Runs<'b>
    where
        'a: 'b,
    {
        let (run, hinges) = (self.run, self.hinges);
        Runs { document: self.document.clone(), run, hinges, fault: Some(fault) }
    }

    /// What runs with these numbers depend on, if they make a scene.
    pub fn relevant(&self, values: &[(&Slot, f64)]) -> Option<Relevant> {
        let Some(fault) = self.fault else {
            return Relevant::of(&self.document.scene(values).ok()?, self.run);
        };
        // What a fault changes is what was drawn.
        let drawn = self.document.with(values);
        let changes = fault.changes.iter().map(|Change { slot, relation, number }| {
            (slot, relation.applied(*number, || drawn.number(slot)))
        });
        let file = drawn.scene(&changes.collect::<Vec<_>>()).ok()?;
        if file.scene.bodies.len() != self.hinges {
            return None;
        }
        Relevant::of(&broken(file, fault).ok()?, self.run)
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
        let given = numbers.iter().map(|&number| tried(relation, number));
        let moved = MOVES.iter().map(|&by| tried(moving, by));
        let (mut is_same, mut makes_none) = (false, false);
        for (number, found) in given.chain(moved).enumerate() {
            match found {
                Tried::Other => return Some(true),
                Tried::Same => is_same = true,
                // Numbers that make no scene are told case by case, unless others show that nothing depends on them.
                Tried::NoScene => makes_none |= number < numbers.len(),
                Tried::Untouched => {}
            }
        }
        Some(makes_none && !is_same)
    }
}

/// Numbers, and what becomes of those at these places with them.
pub(super) type Numbers<'a> = (&'a [Slot], Relation, &'a [f64]);

/// Whether none of these runs depends on numbers.
pub(super) fn ignore<'a>(all: impl Iterator<Item = Runs<'a>>, numbers: Numbers<'_>) -> bool {
    are_all(all, |runs| runs.depend_on(numbers).map(|depends| !depends))
}

/// Whether all these runs are the same with one fault as with another.
pub(super) fn are_alike<'a>(
    all: impl Iterator<Item = Runs<'a>>,
    [one, another]: [&Fault; 2],
) -> bool {
    are_all(all, |runs| {
        let of = |fault| runs.with_fault(fault).relevant(&[]);
        Some(of(one)? == of(another)?)
    })
}

/// Whether something holds for all of which it is known, and not for none; asks no further than the first that denies.
fn are_all<'a>(
    mut all: impl Iterator<Item = Runs<'a>>,
    holds: impl Fn(&Runs<'_>) -> Option<bool>,
) -> bool {
    let mut is_known = false;
    let denies = |runs: Runs<'_>| {
        let found = holds(&runs);
        is_known |= found.is_some();
        found == Some(false)
    };
    !all.any(denies) && is_known
}

/// Runs of a scene in which variables have numbers of theirs.
#[derive(Clone)]
pub(super) struct Situations<'a> {
    pub document: &'a SceneDocument,
    pub hinges: usize,
    pub run: &'a RunSettings,
    pub variables: Vec<&'a Variable>,
}

impl<'a> Situations<'a> {
    /// Without fault, the likeliest to show anything first.
    pub fn all(&self) -> impl Iterator<Item = Runs<'a>> {
        self.with(None)
    }

    /// The same, and then with each of these.
    pub fn all_with(&self, faults: &'a [Fault]) -> impl Iterator<Item = Runs<'a>> {
        std::iter::once(None).chain(faults.iter().map(Some)).flat_map(|fault| self.with(fault))
    }

    fn with(&self, fault: Option<&'a Fault>) -> impl Iterator<Item = Runs<'a>> {
        let longest = self.variables.iter().map(|of| listed(&of.distribution).count()).max();
        let all = SHARES.len() + SCATTERED + ROUNDS * longest.unwrap_or(0);
        let different = if self.variables.is_empty() { 1 } else { all };
        let this = self.clone();
        (0..different).map(move |number| Runs {
            document: this.drawn(number),
            run: this.run,
            hinges: this.hinges,
            fault,
        })
    }

    /// The scene with the numbers that variables have in the situation of this number.
    fn drawn(&self, situation: usize) -> SceneDocument {
        let values = self.variables.iter().enumerate().flat_map(|(place, variable)| {
            let Variable { slots, relation, distribution, .. } = variable;
            let number = drawn(distribution, place, situation);
            let there = |slot| self.document.number(slot);
            slots.iter().map(move |slot| (slot, relation.applied(number, || there(slot))))
        });
        self.document.with(&values.collect::<Vec<_>>())
    }
}

/// The number of the variable at this place in a situation.
fn drawn(distribution: &Distribution, place: usize, situation: usize) -> f64 {
    if let Some(share) = SHARES.get(situation) {
        return distribution.quantile(*share);
    }
    let count = listed(distribution).count();
    match situation.checked_sub(SHARES.len() + SCATTERED) {
        Some(further) if count > 0 => {
            let (number, round) = (further / ROUNDS, further % ROUNDS);
            let shift = (scattered(place, round) * count as f64) as usize;
            listed(distribution).nth((number + shift) % count).unwrap_or(f64::NAN)
        }
        _ => distribution.quantile(scattered(place, situation)),
    }
}

/// The numbers of a list that come at all; none of other distributions.
fn listed(distribution: &Distribution) -> impl Iterator<Item = f64> {
    let (values, weights) = match distribution {
        Distribution::Values { values, weights, .. } => (&values[..], &weights[..]),
        _ => (&[][..], &[][..]),
    };
    values.iter().zip(weights).filter(|(_, weight)| **weight > 0.0).map(|(value, _)| *value)
}

/// A share for each place, which goes through all of them in steps that differ from place to place.
fn scattered(place: usize, step: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    (0.5 + GOLDEN * (step * (place + 1)) as f64).fract().clamp(0.005, 0.995)
}
