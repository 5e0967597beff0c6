//! An order of instructions in which equal ones stand together.

use std::collections::BTreeMap;
use std::ops::Range;

/// An instruction that waits for others, by their numbers.
#[derive(Clone, Debug)]
pub(crate) struct Task<K, I> {
    pub kind: K,
    pub instruction: I,
    pub after: Vec<usize>,
}

/// Instructions of one kind, by their places in the schedule.
#[derive(Clone, Debug)]
pub(crate) struct Run<K> {
    pub kind: K,
    pub places: Range<usize>,
}

/// Puts every task after those it waits for, in long runs of one kind, so that the kind is decided
/// once in a run. Of the tasks that need not wait, all of the most frequent kind come next, with
/// those that they set free.
///
/// Tasks wait for earlier ones only.
pub(crate) fn schedule<K: Copy + Ord, I: Copy>(tasks: &[Task<K, I>]) -> (Vec<I>, Vec<Run<K>>) {
    let mut waits: Vec<usize> = tasks.iter().map(|task| task.after.len()).collect();
    let mut followers = vec![Vec::new(); tasks.len()];
    let mut ready: BTreeMap<K, Vec<usize>> = BTreeMap::new();
    for (i, task) in tasks.iter().enumerate() {
        task.after.iter().for_each(|&before| followers[before].push(i));
        if task.after.is_empty() {
            ready.entry(task.kind).or_default().push(i);
        }
    }
    let (mut instructions, mut runs) = (Vec::with_capacity(tasks.len()), Vec::new());
    while let Some(kind) = most_frequent(&ready) {
        let start = instructions.len();
        while let Some(task) = ready.get_mut(&kind).and_then(Vec::pop) {
            instructions.push(tasks[task].instruction);
            for &follower in &followers[task] {
                waits[follower] -= 1;
                if waits[follower] == 0 {
                    ready.entry(tasks[follower].kind).or_default().push(follower);
                }
            }
        }
        runs.push(Run { kind, places: start..instructions.len() });
    }
    (instructions, runs)
}

fn most_frequent<K: Copy + Ord>(ready: &BTreeMap<K, Vec<usize>>) -> Option<K> {
    let waiting = ready.iter().filter(|(_, tasks)| !tasks.is_empty());
    waiting.max_by_key(|(_, tasks)| tasks.len()).map(|(&kind, _)| kind)
}
