//! Elements of a deck that have no effect since others are missing.

use super::assignment::MOST_STATIONS;
use super::builder::Builder;
use super::section::MOST_VERTICES;
use super::shown;
use super::values::{Key, plain};

impl Builder<'_, '_, '_> {
    /// Warns of values for springs and releases that are not there.
    pub fn warn_ignored_of_hinges(&mut self) {
        let n = self.sizes.segments;
        for i in 0..n {
            let is_zero = |name: &'static str, mut indices: std::ops::Range<usize>| {
                indices.all(|index| self.values.real(name, index) == 0.0)
            };
            let no_spring = is_zero("EKNIK", i..i + 1) && is_zero("EKNIK", n + i..n + i + 1);
            let no_dashpot = is_zero("QNIK", 2 * n + i..2 * n + i + 1)
                && is_zero("QNIK", 3 * n + i..3 * n + i + 1);
            let no_kick_off = is_zero("AES", 4 * i..4 * (i + 1));
            let starts_otherwise = !is_zero("SEGSTT", i..i + 1);
            let number = i + 1;
            let no_force = format!("AES(1,{number}) to (4,{number}) are 0");
            self.warn_ignored(
                "THETIK",
                i,
                no_spring,
                &format!("EKNIK({number},1) and ({number},2) are 0"),
            );
            self.warn_ignored(
                "GAMAIK",
                i,
                no_dashpot,
                &format!("QNIK({number},3) and ({number},4) are 0"),
            );
            self.warn_ignored("XIKF", i, no_kick_off, &no_force);
            if no_kick_off {
                for end in ["RIK1", "SIK1"] {
                    self.warn_ignored_elements(plain(end), 3 * i..3 * (i + 1), &no_force);
                }
            }
            self.warn_ignored("RELTB", i, starts_otherwise, &format!("SEGSTT({number}) is not 0"));
        }
    }

    fn warn_ignored(&mut self, name: &'static str, i: usize, is_ignored: bool, since: &str) {
        let value = self.values.real(name, i);
        if is_ignored && value != 0.0 && value.abs() < super::hinges::NEVER {
            let expected = format!("none since {since}; it is ignored");
            self.warn(plain(name), i, shown(value), &expected);
        }
    }

    /// Warns of values for stations that segment `i` does not have.
    pub fn warn_ignored_of_stations(&mut self, i: usize, stations: usize) {
        let of_station = |j: usize| {
            let flat = MOST_STATIONS * i + j;
            let vertices = MOST_VERTICES * j..MOST_VERTICES * (j + 1);
            [
                (plain("S"), flat..flat + 1),
                (plain("DELM"), flat..flat + 1),
                (plain("R"), flat..flat + 1),
                (plain("NVER"), flat..flat + 1),
                (("DELC", i + 1, 0), 3 * j..3 * (j + 1)),
                (("T", i + 1, 0), vertices.clone()),
                (("XI", i + 1, 0), vertices.clone()),
                (("ZETA", i + 1, 0), vertices),
                (("DLI", i + 1, j + 1), 0..9),
            ]
        };
        for (key, indices) in (stations..MOST_STATIONS).flat_map(of_station) {
            let since = format!("NSTA({}) is {stations}", i + 1);
            self.warn_ignored_elements(key, indices, &since);
        }
    }

    /// Warns of the first of some elements that is not zero.
    pub fn warn_ignored_elements(
        &mut self,
        key: Key,
        indices: std::ops::Range<usize>,
        since: &str,
    ) {
        let value = |index| self.values.cell(key, index).map_or(0.0, |cell| cell.value);
        if let Some((index, value)) =
            indices.map(|index| (index, value(index))).find(|(_, value)| *value != 0.0)
        {
            self.warn(key, index, shown(value), &format!("none since {since}; it is ignored"));
        }
    }
}
