use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::description::Description;
use crate::directory::{self, Place, State, require_same};
use crate::journal::Journal;
use crate::task::{Report, finish, settle};
use crate::{Shard, StudyError, space, tables};

/// The most missing shards that are named.
const NAMED: usize = 10;

/// Puts all shards of a sweep together in a directory, which then is as if the sweep had been made there.
///
/// Shards may come in any order, and stay as they are. `csv` and `accept_difference` are as in a sweep.
///
/// # Errors
/// When a directory is no finished shard of the same sweep, or has another study or scene than the sweep wrote, when
/// not each shard is given once, and when the directory is refused or cannot be written.
pub fn merge(
    shards: &[PathBuf],
    directory: &Path,
    csv: bool,
    accept_difference: bool,
) -> Result<Report, StudyError> {
    let parts = in_order(shards)?;
    let (mut whole, mut texts): (Option<Description>, _) = (None, None);
    for (path, part) in &parts {
        texts = Some(directory::sources(path, part)?);
        let part = Description { shard: None, complete: false, csv, counts: None, ..part.clone() };
        whole = Some(match whole {
            None => part,
            Some(whole) => {
                require_same(path, &whole, &part, accept_difference).map_err(of_another)?;
                whole.also_by(&part)
            }
        });
    }
    let (whole, [study, scene]) = whole.zip(texts).expect("there is a shard");
    let place = Place::take(directory)?;
    let what = match place.state(&whole, accept_difference)? {
        State::Complete(what) => return settle(&place, what, csv),
        State::Open(what) => Description { csv: csv || what.csv, ..what },
        State::Fewer(then) => {
            let (directory, differences) = (directory.to_owned(), then.differences(&whole));
            return Err(StudyError::Different { directory, differences });
        }
    };
    let journals: Result<Vec<Journal>, _> = parts.iter().map(whole_journal).collect();
    let journals = journals?;
    let bytes: u64 = journals.iter().map(Journal::bytes).sum();
    space::require(directory, bytes.saturating_mul(tables::formats(what.csv)), what.cases)?;
    place.begin(&what, &study, &scene)?;
    finish(&place, what, &journals, [&study, &scene])
}

/// What is wrong with a shard that is not of the sweep that others are of.
fn of_another(error: StudyError) -> StudyError {
    match error {
        StudyError::Different { directory, differences } => {
            StudyError::ShardOfAnother { directory, differences }
        }
        other => other,
    }
}

/// Directories of shards with what they are, in order of cases.
///
/// # Errors
/// When one is no finished shard, or not each shard is there once.
fn in_order(shards: &[PathBuf]) -> Result<Vec<(PathBuf, Description)>, StudyError> {
    let mut parts = BTreeMap::new();
    let mut of = None;
    for path in shards {
        let (shard, what) = finished(path)?;
        if *of.get_or_insert(shard.of()) != shard.of() {
            let found = format!("the shard {shard} beside shards of another sweep");
            return Err(StudyError::NoShard { directory: path.clone(), found });
        }
        if let Some((other, _)) = parts.insert(shard, (path.clone(), what)) {
            return Err(StudyError::ShardTwice { shard, directories: [other, path.clone()] });
        }
    }
    let (given, of) = (parts.len() as u64, of.unwrap_or(1));
    let is_there = |number: &u64| parts.keys().any(|shard: &Shard| shard.number() == *number);
    let missing = (1..=of).filter(|number| !is_there(number)).take(NAMED);
    let missing: Vec<String> = missing.map(|number| format!("{number}/{of}")).collect();
    if missing.is_empty() {
        Ok(parts.into_values().collect())
    } else {
        Err(StudyError::ShardsMissing { given, of, missing })
    }
}

/// Which shard a directory is.
///
/// # Errors
/// When it is no finished one.
fn finished(directory: &Path) -> Result<(Shard, Description), StudyError> {
    let none = |found: &str| {
        let (directory, found) = (directory.to_owned(), found.to_owned());
        StudyError::NoShard { directory, found }
    };
    let what = directory::description(directory)?.ok_or_else(|| none("no sweep"))?;
    let shard = what.shard.ok_or_else(|| none("a sweep of all cases"))?;
    if what.complete {
        return Ok((shard, what));
    }
    let done = directory::journal(directory, &what)?.done();
    let found = format!("{done} of {} cases of the shard {shard}", what.share());
    Err(none(&found))
}

/// The journal of a finished shard.
///
/// # Errors
/// When it lacks cases.
fn whole_journal((directory, what): &(PathBuf, Description)) -> Result<Journal, StudyError> {
    let journal = directory::journal(directory, what)?;
    journal.require_whole()?;
    match journal.missing().first() {
        None => Ok(journal),
        Some(missing) => {
            let (directory, case) = (directory.clone(), missing.start());
            Err(StudyError::NoShard { directory, found: format!("no case {case}") })
        }
    }
}
