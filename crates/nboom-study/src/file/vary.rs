//! What varies, and together with what.

use std::ops::Range;

use nboom_io::{SceneDocument, Slot, nearest};

use super::overlap::{Changed, overlaps};
use super::reader::{At, Fields, Reader, quoted};
use crate::distribution::{Distribution, Unfit};
use crate::study::{Correlation, Method, Relation, Variable};

/// Keys of which a variable has one.
const DISTRIBUTIONS: [&str; 4] = ["uniform", "normal", "log_normal", "values"];

/// Columns that all tables have.
pub(super) const RESERVED: [&str; 4] = ["case", "seed", "fault", "status"];

impl<'t> Reader<'t> {
    /// A variable of a study by this method.
    pub fn variable(
        &mut self,
        of: &Fields<'t>,
        document: &SceneDocument,
        method: Method,
    ) -> Option<Variable> {
        let relation = self.choice(of, "as").and_then(|found| {
            Relation::ALL.into_iter().find(|relation| relation.name() == found.value)
        });
        let paths = self.paths(of);
        let mut slots: Vec<Slot> = Vec::new();
        for path in paths.iter().flatten() {
            let Some(slot) = self.slot(document, path) else { continue };
            if slots.contains(&slot) {
                self.error(
                    &path.place,
                    path.key,
                    "a number that is there before",
                    "each number once",
                );
            }
            slots.push(slot);
        }
        let distribution = self.distribution(of, method);
        let name = match self.text(of, "name") {
            Some(name) => name.value.to_owned(),
            None => name_of_path(paths.as_ref()?.first()?.value),
        };
        let starts = |c: char| c.is_ascii_alphabetic() || c == '_';
        let goes_on = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if !(name.starts_with(starts) && name.chars().all(goes_on)) || RESERVED.contains(&&name[..])
        {
            let expected = "a name of letters, digits and _, not a digit first, nor case, seed, fault or status";
            self.error(&of.place_of("name"), "name", quoted(&name), expected);
        }
        let relation = relation.unwrap_or(Relation::Value);
        Some(Variable { name, slots, relation, distribution: distribution? })
    }

    fn paths(&mut self, of: &Fields<'t>) -> Option<Vec<At<&'t str>>> {
        match (of.has("path"), of.has("paths")) {
            (true, false) => self.text(of, "path").map(|path| vec![path]),
            (false, true) => {
                let paths = self.texts(of, "paths")?;
                if paths.is_empty() {
                    self.error(
                        &of.place_of("paths"),
                        "paths",
                        "an empty list",
                        "at least one path",
                    );
                }
                Some(paths)
            }
            (has_both, _) => {
                let found = if has_both { "both" } else { "neither" };
                self.error(&of.place(), "path", found, "either path or paths");
                None
            }
        }
    }

    /// The place in the scene to which a path leads.
    pub fn slot(&mut self, document: &SceneDocument, path: &At<&'t str>) -> Option<Slot> {
        match document.slot(path.value) {
            Ok(slot) => Some(slot),
            Err(unknown) => {
                let (found, meant) = (quoted(&unknown.found), unknown.nearest.as_deref());
                self.error_like(&path.place, path.key, found, unknown.expected, meant);
                None
            }
        }
    }

    fn distribution(&mut self, of: &Fields<'t>, method: Method) -> Option<Distribution> {
        let given: Vec<&'static str> =
            DISTRIBUTIONS.into_iter().filter(|name| of.has(name)).collect();
        let [name] = given[..] else {
            let found = if given.is_empty() { "nothing".to_owned() } else { given.join(" and ") };
            self.error(&of.place(), "vary", found, "one of uniform, normal, log_normal, values");
            return None;
        };
        let idle = [
            ("points", "uniform", method == Method::Grid),
            ("weights", "values", method != Method::Grid),
        ];
        for (key, owner, fits) in idle {
            if of.has(key) && !(owner == name && fits) {
                let place = of.place_of(key);
                let when = if key == "points" { "in a grid" } else { "not in a grid" };
                self.error(
                    &place,
                    key,
                    "a key without effect",
                    format!("it with `{owner}`, {when}"),
                );
            }
        }
        let found = match name {
            "uniform" => self.uniform(of)?,
            "values" => {
                let values = self.numbers(of, "values")?.value;
                let weights = match of.has("weights") {
                    true => self.numbers(of, "weights")?.value,
                    false => vec![1.0; values.len()],
                };
                Distribution::one_of(values, weights)
            }
            name => self.bell(of, name)?,
        };
        if method == Method::Grid && found.points().is_none() {
            let expected = "values, or uniform with points, in a grid";
            self.error(&of.place_of(name), name, "a distribution without points", expected);
        }
        if let Err(Unfit { key, found, expected }) = found.check() {
            let place = of.place_of(if of.has(key) { key } else { name });
            self.error(&place, key, found, expected);
        }
        Some(found)
    }

    fn uniform(&mut self, of: &Fields<'t>) -> Option<Distribution> {
        let inner = self.table(of, "uniform")?;
        let from = self.number(&inner, "from").map(|found| found.value);
        let to = self.number(&inner, "to").map(|found| found.value);
        let points = self.whole(of, "points").map(|found| found.value);
        let (from, to) = (from?, to?);
        if of.has("points") && points.is_none() {
            return None;
        }
        Some(match points {
            Some(points) => Distribution::Points { from, to, points },
            None => Distribution::Uniform { from, to },
        })
    }

    fn bell(&mut self, of: &Fields<'t>, name: &'static str) -> Option<Distribution> {
        let inner = self.table(of, name)?;
        let is_normal = name == "normal";
        let names = if is_normal { ["mean", "deviation"] } else { ["median", "sigma"] };
        let [middle, width] = names.map(|name| self.number(&inner, name).map(|of| of.value));
        let least = if is_normal { f64::NEG_INFINITY } else { 0.0 };
        let from = self.number(&inner, "from").map_or(least, |of| of.value);
        let to = self.number(&inner, "to").map_or(f64::INFINITY, |of| of.value);
        let (middle, width) = (middle?, width?);
        Some(if is_normal {
            Distribution::Normal { mean: middle, deviation: width, from, to }
        } else {
            Distribution::LogNormal { median: middle, sigma: width, from, to }
        })
    }

    /// Reports variables of which one would undo what another does.
    pub fn check_overlaps(
        &mut self,
        tables: &[Fields<'t>],
        variables: &[(Option<Variable>, Range<usize>)],
        document: &SceneDocument,
    ) {
        let known = tables
            .iter()
            .zip(variables)
            .filter_map(|(of, (variable, _))| variable.as_ref().map(|variable| (of, variable)));
        let known: Vec<_> = known.collect();
        let changed: Vec<_> = known
            .iter()
            .map(|(_, variable)| Changed { slots: &variable.slots, may_replace: false })
            .collect();
        for [later, earlier] in overlaps(document, &changed) {
            let (of, key) =
                (known[later].0, if known[later].0.has("path") { "path" } else { "paths" });
            let found = format!("a number that {} changes too", quoted(&known[earlier].1.name));
            self.error(&of.place_of(key), key, found, "each number in one table");
        }
    }

    /// Correlations, of each pair one.
    pub fn correlations(
        &mut self,
        tables: &[Fields<'t>],
        method: Method,
        names: &[&str],
    ) -> Vec<Correlation> {
        let mut all: Vec<Correlation> = Vec::new();
        for of in tables {
            let Some(found) = self.correlation(of, method, names) else { continue };
            let [a, b] = found.between;
            if all.iter().any(|known| [[a, b], [b, a]].contains(&known.between)) {
                let place = of.place_of("between");
                self.error(
                    &place,
                    "between",
                    "a pair that is correlated already",
                    "each pair once",
                );
            }
            all.push(found);
        }
        all
    }

    fn correlation(
        &mut self,
        of: &Fields<'t>,
        method: Method,
        names: &[&str],
    ) -> Option<Correlation> {
        if method == Method::Grid {
            let expected = "none in a grid, which has all combinations";
            self.error(&of.place(), "correlation", "a correlation", expected);
        }
        let between = self.texts(of, "between");
        let coefficient = self.number(of, "coefficient");
        let (between, coefficient) = (between?, coefficient?);
        let [first, second] = &between[..] else {
            let found = format!("{} names", between.len());
            self.error(&of.place_of("between"), "between", found, "the names of two variables");
            return None;
        };
        let number = |reader: &mut Self, name: &At<&str>| {
            let number = names.iter().position(|known| *known == name.value);
            if number.is_none() {
                let meant = nearest(name.value, names.iter().copied());
                let found = quoted(name.value);
                reader.error_like(&name.place, "between", found, "the name of a variable", meant);
            }
            number
        };
        let between = [number(self, first), number(self, second)];
        if coefficient.value.abs() >= 1.0 {
            let found = coefficient.value.to_string();
            self.error(&coefficient.place, "coefficient", found, "a number above -1 and below 1");
        }
        let between = [between[0]?, between[1]?];
        if between[0] == between[1] {
            self.error(&second.place, "between", "a variable twice", "two variables");
        }
        Some(Correlation { between, coefficient: coefficient.value })
    }
}

/// The name of a variable after its path: each run of characters other than letters, digits and `_` of ASCII
/// becomes one `_`, but none at the ends.
fn name_of_path(path: &str) -> String {
    let parts = path.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}
