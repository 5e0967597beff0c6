//! Whether a table has the keys that its kind takes.

use std::ptr;

use super::catalog::SCENE;
use super::fields::{Fields, Reader};
use super::keys::{Holds, Key, TableKind, all_tables};
use super::suggest;
use super::tree::Entry;
use crate::diagnostic::quoted;

impl Reader<'_, '_> {
    /// Reports keys of a table that its kind does not have, that are missing or that contradict each other.
    pub fn check_keys(&mut self, fields: &Fields<'_>) {
        if self.are_keys_right {
            return;
        }
        let Fields { kind, table, at } = fields;
        let mut meant = Vec::new();
        for Entry { key, key_at, .. } in table.0.iter() {
            if kind.key(key).is_none() {
                let names: Vec<String> = kind.keys.iter().flat_map(Key::names).collect();
                let near = suggest::nearest(key, names.iter().map(String::as_str));
                meant.extend(near.and_then(|near| kind.key(near)).map(|key| key.name));
                let found = format!("{} in {}", quoted(key), kind.name);
                let elsewhere =
                    keepers(key, fields.kind).map(|names| format!("it is a key of {names}"));
                let (expected, help) =
                    ("a key of this table", elsewhere.or(near.map(suggest::question)));
                self.report.error_with_help(self.sources, key_at, key, &found, expected, help);
            }
        }
        for key in kind.keys {
            let given: Vec<&Entry> =
                table.0.iter().filter(|entry| key.is_called(&entry.key)).collect();
            if let [_, second] = given[..] {
                let found = format!("{} beside {}", quoted(&second.key), quoted(&given[0].key));
                self.error(&second.key_at, &second.key, &found, "one of them");
            }
            // A key that is nearly there has been told.
            if given.is_empty() && key.is_required && !meant.contains(&key.name) {
                let found = format!("none in {}", kind.name);
                let about = in_a_sentence(key.about);
                let expected = match key.holds {
                    Holds::Table(_) => format!("a table {}: {about}", key.name),
                    _ => about,
                };
                self.error(at, &key.names().join(" or "), &found, &expected);
            }
        }
        let given: Vec<&str> =
            kind.one_of.iter().copied().filter(|key| fields.entry(key).is_some()).collect();
        let is_nearly_there = given.is_empty() && kind.one_of.iter().any(|key| meant.contains(key));
        if !kind.one_of.is_empty() && given.len() != 1 && !is_nearly_there {
            let found = if given.is_empty() { "none".to_owned() } else { given.join(" and ") };
            let expected = format!("exactly one of {}", kind.one_of.join(", "));
            self.error(at, kind.name, &found, &expected);
        }
    }
}

/// The tables around or within one of this kind that have the key.
fn keepers(key: &str, kind: &'static TableKind) -> Option<String> {
    let within = |of: &'static TableKind| of.keys.iter().filter_map(|key| key.holds.table());
    let is_around = |of: &&'static TableKind| within(of).any(|one| ptr::eq(one, kind));
    let around = all_tables(&SCENE).into_iter().filter(is_around);
    let have_it = around.chain(within(kind)).filter(|other| other.key(key).is_some());
    let names: Vec<&str> = have_it.map(|other| other.name).collect();
    (!names.is_empty()).then(|| names.join(" or "))
}

/// A sentence without its point and with a small first letter, unless it begins with a name.
fn in_a_sentence(about: &str) -> String {
    let (first, rest) = about.split_at(about.chars().next().map_or(0, char::len_utf8));
    let is_name = about.starts_with("Young") || about.starts_with("Poisson");
    let first = if is_name { first.to_owned() } else { first.to_lowercase() };
    first + rest.strip_suffix('.').unwrap_or(rest)
}
