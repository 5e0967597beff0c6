use super::symbols::{Absent, Extent, SYMBOLS, Symbol};
use super::values::{Sizes, Values, plain};
use crate::diagnostic::Report;

/// Reports symbols that must be given and are not, and values that the original would ignore.
pub(crate) fn check(values: &Values, report: &mut Report<'_>) {
    let unconditional = SYMBOLS.iter().filter(|symbol| symbol.absent == Absent::Error);
    for symbol in unconditional {
        check_symbol(symbol, values, report);
    }
    let (read, ignored) = if values.real("IAB", 0) == 0.0 {
        ("BETAIK", [("ALIK", "IAB is 0"), ("SIGIK", "IAB is 0")])
    } else {
        ("ALIK", [("BETAIK", "IAB is not 0"), ("TAUIK", "IAB is not 0")])
    };
    for name in [read, "EMIK", "HIIK"] {
        require(name, values, report);
    }
    warn_ignored(&ignored, values, report);
    if values.real("IXYZ", 0) == 1.0 {
        require("EMO", values, report);
        warn_ignored(&[("FTSM", "IXYZ is 1")], values, report);
    } else {
        warn_ignored(&[("EMO", "IXYZ is 0")], values, report);
    }
}

/// Reports the symbol if it, or an element of it, is not given.
pub(crate) fn require(name: &'static str, values: &Values, report: &mut Report<'_>) {
    for symbol in SYMBOLS.iter().filter(|symbol| symbol.name == name) {
        check_symbol(symbol, values, report);
    }
}

fn check_symbol(symbol: &'static Symbol, values: &Values, report: &mut Report<'_>) {
    let counted = symbol.shape.iter().all(|extent| matches!(extent, Extent::Fixed(_)));
    let sizes = match values.sizes {
        Some(sizes) => sizes,
        // The number of elements is then not known; any extent will do.
        None if counted => Sizes::LARGEST,
        None => return,
    };
    let key = plain(symbol.name);
    let group_is_absent = !values.groups.contains_key(&symbol.group);
    if group_is_absent || values.is_damaged(key) {
        return;
    }
    let count = sizes.extents(symbol).iter().product();
    let missing = |&i: &usize| values.cell(key, i).is_none() && !may_be_left_out(symbol, i, values);
    let Some(first) = (0..count).find(missing) else { return };
    let at = values.position(key, first);
    let or_slices = match segment_of_mass(symbol, first) {
        Some(i) if values.has_slices() => format!(
            ", or none of EMIK, CNIK and HIIK for segment {}, whose slices then say them",
            i + 1
        ),
        _ => String::new(),
    };
    if values.is_given(symbol.name) {
        let more = (first + 1..count).filter(missing).count();
        let and_more = if more > 0 { format!(" ({more} more are missing)") } else { String::new() };
        let label = values.label(key, first);
        report.error(at, &label, "nothing", format!("a value{and_more}{or_slices}"));
    } else {
        let values = if count == 1 { "a value".to_owned() } else { format!("{count} values") };
        report.error(at, symbol.name, "nothing", format!("{values}{or_slices}"));
    }
}

/// Products of inertia, zero in most decks, and elements that slices replace.
fn may_be_left_out(symbol: &Symbol, index: usize, values: &Values) -> bool {
    let is_product = matches!(symbol.name, "HM" | "HIIK") && !matches!(index % 9, 0 | 4 | 8);
    is_product || segment_of_mass(symbol, index).is_some_and(|i| values.is_by_slices(i))
}

/// The segment, from 0, to whose mass or inertia an element belongs.
fn segment_of_mass(symbol: &Symbol, index: usize) -> Option<usize> {
    match symbol.name {
        "EMIK" => Some(index),
        "HIIK" => Some(index / 9),
        _ => None,
    }
}

fn warn_ignored(
    ignored: &[(&'static str, &'static str)],
    values: &Values,
    report: &mut Report<'_>,
) {
    for &(name, reason) in ignored {
        if values.has_nonzero(name) {
            let at = values.arrays[&plain(name)].at;
            let expected = format!("none since {reason}; they are ignored");
            report.warn(at, name, "values", expected);
        }
    }
}
