//! Numbers of a scene that two tables of a study change.

use nboom_io::{SceneDocument, Slot};

use crate::study::{Change, Relation};

/// What a table changes in a scene.
pub(super) struct Changed<'a> {
    pub slots: &'a [Slot],
    /// Whether its numbers may take the place of what follows from others that are changed.
    pub may_replace: bool,
}

impl<'a> Changed<'a> {
    /// A change of a fault, which may set a number for good.
    pub fn by_fault(Change { slot, relation, .. }: &'a Change) -> Self {
        let may_replace = *relation == Relation::Value;
        Self { slots: std::slice::from_ref(slot), may_replace }
    }
}

/// Pairs of tables of which one would undo what the other does, the later one first: both change one number, or
/// one starts from a number of the scene that the other moves, or takes its place where it may not.
pub(super) fn overlaps(document: &SceneDocument, all: &[Changed<'_>]) -> Vec<[usize; 2]> {
    let moved: Vec<_> = all.iter().map(|of| moved(document, of.slots)).collect();
    let starts_from = |i: usize, j: usize| {
        !all[i].may_replace
            && all[i].slots.iter().any(|slot| {
                let there = document.number(slot).to_bits();
                moved[j].iter().any(|moved| moved.number(slot).to_bits() != there)
            })
    };
    let overlap = |i: usize, j: usize| {
        let is_in_both = all[i].slots.iter().any(|slot| all[j].slots.contains(slot));
        is_in_both || starts_from(i, j) || starts_from(j, i)
    };
    let first = |i: usize| (0..i).find(|&j| overlap(i, j)).map(|j| [i, j]);
    (0..all.len()).filter_map(first).collect()
}

/// Whether one of `others` follows from the number at `slot`, and is not that number.
pub(super) fn moves(document: &SceneDocument, slot: &Slot, others: &[Slot]) -> bool {
    let moved = moved(document, std::slice::from_ref(slot));
    others.iter().filter(|other| *other != slot).any(|other| {
        let there = document.number(other).to_bits();
        moved.iter().any(|moved| moved.number(other).to_bits() != there)
    })
}

/// The document with these numbers moved, up and down, since what follows from them may have a limit to one side.
fn moved(document: &SceneDocument, slots: &[Slot]) -> [SceneDocument; 2] {
    [1.5, -1.0].map(|by| {
        let values: Vec<(&Slot, f64)> =
            slots.iter().map(|slot| (slot, document.number(slot) + by)).collect();
        document.with(&values)
    })
}
