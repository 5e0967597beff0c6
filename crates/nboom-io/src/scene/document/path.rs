//! Paths to numbers of a scene.

use std::sync::Arc;

use crate::diagnostic::quoted;
use crate::scene::catalog::SCENE;
use crate::scene::keys::TableKind;
use crate::scene::suggest;
use crate::scene::tree::{Entry, Node, Table, Value};

/// The place of a number in a [`SceneDocument`](super::SceneDocument): for each table the number of the
/// entry, for each list that of the element, from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slot(Vec<usize>);

/// A path that leads to no number of a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("path {} found, {expected} expected{}", quoted(.found), help(.nearest))]
pub struct UnknownPath {
    /// The path.
    pub found: String,
    /// What would have been right.
    pub expected: &'static str,
    /// A path to a number that is like it.
    pub nearest: Option<String>,
}

fn help(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |near| format!("; {}", suggest::question(near)))
}

pub(super) const NO_PATH: &str =
    "keys with dots between them, numbers from 1 in brackets, and quotes around names with dots";
pub(super) const NO_NUMBER: &str = "the path of a number that the scene says";
pub(super) const NO_NUMBER_OF_ITS_SCENE: &str =
    "the path of a number of the scene in TOML that nboom convert makes of the file";
pub(super) const NO_PARAMETERS: &str =
    "a number that the scene says; it has no parameters, as none that `expanded = true` writes out";
pub(super) const REPEATED: &str =
    "`expanded = true` in the study, for a body that the scene makes by `repeat`";

/// One part of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// A key, or the name of a table in a list.
    Key(String),
    /// A number, from 1.
    Number(usize),
}

/// The parts of a path, of which the first is a key; `None` if it is none.
pub(super) fn steps(path: &str) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    let mut rest = path;
    loop {
        let (key, after) = key(rest.trim_start())?;
        steps.push(Step::Key(key.to_owned()));
        rest = after.trim_start();
        while let Some(inner) = rest.strip_prefix('[') {
            let (number, after) = inner.split_once(']')?;
            let number = number.trim().parse().ok().filter(|&number| number > 0)?;
            steps.push(Step::Number(number));
            rest = after.trim_start();
        }
        if rest.is_empty() {
            return Some(steps);
        }
        rest = rest.strip_prefix('.')?;
    }
}

/// A key at the start of a text, and the text after it.
fn key(text: &str) -> Option<(&str, &str)> {
    if let Some(quote) = text.chars().next().filter(|&c| is_quote(c)) {
        return text[1..].split_once(quote);
    }
    let (key, after) = text.split_at(text.find(['.', '[']).unwrap_or(text.len()));
    (!key.is_empty()).then(|| (key.trim_end(), after))
}

fn is_quote(c: char) -> bool {
    matches!(c, '"' | '\'')
}

/// The place at the end of a path, if there is one.
pub(super) fn find(root: &Table, steps: &[Step]) -> Option<Slot> {
    step(root, steps).map(|(slot, _)| slot)
}

/// The place at the end of a path and what is there.
pub(super) fn step<'t>(root: &'t Table, steps: &[Step]) -> Option<(Slot, &'t Node)> {
    let (first, rest) = steps.split_first()?;
    let Step::Key(key) = first else { return None };
    let place = place_of(root, key)?;
    let (mut slot, mut node) = (Slot(vec![place]), &root.0[place].node);
    for step in rest {
        let place = place_in(&node.value, step)?;
        slot.0.push(place);
        node = inner(&node.value, place)?;
    }
    Some((slot, node))
}

fn place_of(table: &Table, key: &str) -> Option<usize> {
    table.0.iter().position(|entry| entry.key == key)
}

/// Where a step leads in a value.
fn place_in(value: &Value, step: &Step) -> Option<usize> {
    match (value, step) {
        (Value::Table(table), Step::Key(key)) => place_of(table, key),
        (Value::List(nodes), Step::Key(name)) => {
            nodes.iter().position(|node| name_of(node) == Some(name))
        }
        (Value::List(nodes), Step::Number(number)) => {
            (1..=nodes.len()).contains(number).then(|| number - 1)
        }
        _ => None,
    }
}

/// What a table in a list calls itself.
fn name_of(node: &Node) -> Option<&str> {
    let Value::Table(table) = &node.value else { return None };
    match &table.get("name")?.node.value {
        Value::Text(name) => Some(name),
        _ => None,
    }
}

fn inner(value: &Value, place: usize) -> Option<&Node> {
    match value {
        Value::Table(table) => table.0.get(place).map(|entry| &entry.node),
        Value::List(nodes) => nodes.get(place),
        _ => None,
    }
}

/// What is at a place.
///
/// # Panics
/// When there is no such place.
pub(super) fn child<'t>(root: &'t Table, slot: &Slot) -> &'t Value {
    let value = &root.0[slot.0[0]].node.value;
    let below = |value, &place: &usize| {
        inner(value, place).map(|node: &Node| &node.value).expect("a place of this document")
    };
    slot.0[1..].iter().fold(value, below)
}

/// As [`child`], to be changed; other trees keep what they share with this one.
pub(super) fn child_mut<'t>(root: &'t mut Table, slot: &Slot) -> &'t mut Value {
    let value = &mut Arc::make_mut(&mut root.0)[slot.0[0]].node.value;
    slot.0[1..].iter().fold(value, |value, &place| match value {
        Value::Table(table) => &mut Arc::make_mut(&mut table.0)[place].node.value,
        Value::List(nodes) => &mut Arc::make_mut(nodes)[place].value,
        _ => panic!("a place of another document"),
    })
}

/// A number whose path is like one that leads to none.
pub(super) fn nearest(
    root: &Table,
    steps: &[Step],
    is_number: &dyn Fn(&Slot) -> bool,
) -> Option<Slot> {
    let (first, rest) = steps.split_first()?;
    let Step::Key(key) = first else { return None };
    let place = like(key, root.0.iter().map(|entry| Some(entry.key.as_str())))?;
    let (mut slot, mut node) = (Slot(vec![place]), &root.0[place].node);
    for step in rest {
        let place = match (&node.value, step) {
            (Value::Table(table), Step::Key(key)) => {
                Some(like(key, table.0.iter().map(|entry| Some(entry.key.as_str())))?)
            }
            (Value::List(nodes), Step::Key(name)) => like(name, nodes.iter().map(name_of)),
            (Value::List(nodes), Step::Number(number)) => nodes.len().min(*number).checked_sub(1),
            _ => None,
        };
        let Some(place) = place else { break };
        slot.0.push(place);
        node = inner(&node.value, place)?;
    }
    first_number(&node.value, slot, is_number)
}

/// Which of some names is the one that is meant; of bodies of a deck also by the numbers in its name.
fn like<'n>(name: &str, names: impl Iterator<Item = Option<&'n str>> + Clone) -> Option<usize> {
    let place = |wanted: &str| names.clone().position(|known| known == Some(wanted));
    let numbers = || {
        let is_it = |known: &str| known.strip_suffix(name).is_some_and(|left| left.ends_with(' '));
        let is_segment = name.contains(',');
        names.clone().position(|known| is_segment && known.is_some_and(is_it))
    };
    let meant = || suggest::nearest(name, names.clone().flatten()).and_then(place);
    place(name).or_else(numbers).or_else(meant)
}

/// A number at the end of a path that leads there from a table within the scene, or of as much of its end as leads to one
/// number alone, or to one in a table whose name is like the one before. It is within all that the rest of the path names.
pub(super) fn within(
    root: &Table,
    steps: &[Step],
    is_number: &dyn Fn(&Slot) -> bool,
) -> Option<Slot> {
    let mut ends = (0..steps.len()).filter(|&start| matches!(steps[start], Step::Key(_)));
    ends.find_map(|start| {
        let mut found = Vec::new();
        for (place, entry) in root.0.iter().enumerate() {
            let here = (&[entry.key.as_str()][..], Slot(vec![place]));
            lead(&entry.node.value, here, &steps[start..], &mut found);
        }
        let rest = steps[..start].iter().filter_map(|step| match step {
            Step::Key(key) => Some(key.as_str()),
            Step::Number(_) => None,
        });
        let before = rest.clone().next_back();
        let known = |key: &&str| root.0.iter().any(|entry| is_called(entry, key));
        let named: Vec<&str> = rest.filter(known).collect();
        found.retain(|(owners, _)| named.iter().all(|name| owners.contains(name)));
        if let Some(before) = before {
            let owner =
                suggest::nearest(before, found.iter().filter_map(|(of, _)| of.last().copied()));
            if owner.is_none() && found.len() > 1 {
                return None;
            }
            found.retain(|(of, _)| owner.is_none() || of.last().copied() == owner);
        }
        found.into_iter().map(|(_, slot)| slot).find(is_number)
    })
}

/// Whether this is a table, or a list of some, with this key or name, or one is within it.
fn is_called(Entry { key, node, .. }: &Entry, name: &str) -> bool {
    match &node.value {
        Value::Table(table) => key == name || table.0.iter().any(|entry| is_called(entry, name)),
        Value::List(nodes) => {
            let is_within = |node: &Node| match &node.value {
                Value::Table(table) => table.0.iter().any(|entry| is_called(entry, name)),
                _ => false,
            };
            key == name || nodes.iter().any(|node| name_of(node) == Some(name) || is_within(node))
        }
        _ => false,
    }
}

/// Where a path leads from a value that stands at a place, within tables and lists of these names, and from all within it.
fn lead<'t>(
    value: &'t Value,
    (owners, slot): (&[&'t str], Slot),
    steps: &[Step],
    found: &mut Vec<(Vec<&'t str>, Slot)>,
) {
    let mut there = (slot.clone(), Some(value));
    for step in steps {
        let place = there.1.and_then(|value| place_in(value, step));
        there.0.0.extend(place);
        there.1 = place.and_then(|place| Some(&inner(there.1?, place)?.value));
    }
    if there.1.is_some() {
        found.push((owners.to_vec(), there.0));
    }
    let mut into = |node: &'t Node, name: Option<&'t str>, place: usize| {
        let owners: Vec<&str> = owners.iter().copied().chain(name).collect();
        let below = Slot(slot.0.iter().copied().chain([place]).collect());
        lead(&node.value, (&owners, below), steps, found);
    };
    match value {
        Value::Table(table) => {
            for (place, Entry { key, node, .. }) in table.0.iter().enumerate() {
                into(node, Some(key), place);
            }
        }
        Value::List(nodes) => {
            for (place, node) in nodes.iter().enumerate() {
                into(node, name_of(node), place);
            }
        }
        _ => {}
    }
}

/// The first number at a place or below.
fn first_number(value: &Value, slot: Slot, is_number: &dyn Fn(&Slot) -> bool) -> Option<Slot> {
    let below = |(place, node): (usize, &Node)| {
        let slot = Slot(slot.0.iter().copied().chain([place]).collect());
        first_number(&node.value, slot, is_number)
    };
    match value {
        Value::Table(table) => table.0.iter().map(|entry| &entry.node).enumerate().find_map(below),
        Value::List(nodes) => nodes.iter().enumerate().find_map(below),
        _ => is_number(&slot).then_some(slot),
    }
}

/// The path of a place.
pub(super) fn text(root: &Table, slot: &Slot) -> String {
    let Entry { key, node, .. } = &root.0[slot.0[0]];
    let (mut text, mut node) = (part(key), node);
    for &place in &slot.0[1..] {
        let Some(next) = inner(&node.value, place) else { break };
        match (&node.value, name_of(next)) {
            (Value::Table(table), _) => text = format!("{text}.{}", part(&table.0[place].key)),
            (_, Some(name)) => text = format!("{text}.{}", part(name)),
            _ => text = format!("{text}[{}]", place + 1),
        }
        node = next;
    }
    text
}

/// The unit of what is at a place, with T for that of times, if its key says one.
pub(super) fn unit(root: &Table, slot: &Slot) -> Option<&'static str> {
    let Entry { key, node, .. } = &root.0[slot.0[0]];
    let (mut keys, mut node) = (vec![key.as_str()], node);
    for &place in &slot.0[1..] {
        if let Value::Table(table) = &node.value {
            keys.push(&table.0[place].key);
        }
        node = inner(&node.value, place)?;
    }
    let below = |(kind, _): (&'static TableKind, _), name: &&str| match kind.key(name) {
        Some(key) => (key.holds.table().unwrap_or(kind), key.unit(name)),
        // A name that the scene chooses.
        None => (kind, None),
    };
    keys.iter().fold((&SCENE, None), below).1
}

/// A key or name as a part of a path.
fn part(key: &str) -> String {
    let needs_quotes = key.contains(['.', '[']) || key.starts_with(is_quote) || key != key.trim();
    let quote = if key.contains('"') { '\'' } else { '"' };
    if needs_quotes { format!("{quote}{key}{quote}") } else { key.to_owned() }
}
