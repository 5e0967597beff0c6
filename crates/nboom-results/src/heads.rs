//! What the columns of tables are called, and what they hold.

use std::borrow::Cow;

use nboom_model::{Column, HingeLabel, Quantity, UnitSystem, WantedTable};

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    /// What it is called.
    pub name: Cow<'static, str>,
    /// What stands in it.
    pub holds: Holds,
    /// What it is, in one line.
    pub about: Cow<'static, str>,
    /// The body on the hinge of a quantity of hinges, of a scene that has names.
    pub body: Option<String>,
}

/// What stands in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// Numbers of this unit, made of those of length L, time T and force F.
    Number(&'static str),
    /// Numbers whose unit depends on the row.
    Various,
    /// Whole numbers.
    Count,
    /// Words.
    Text,
}

/// The unit of numbers without one.
const ONE: &str = "1";

impl Head {
    pub(crate) fn number(
        name: &'static str,
        unit: &'static str,
        about: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self::of(name, Holds::Number(unit), about)
    }

    pub(crate) fn count(name: &'static str, about: &'static str) -> Self {
        Self::of(name, Holds::Count, about)
    }

    pub(crate) fn text(name: &'static str, about: &'static str) -> Self {
        Self::of(name, Holds::Text, about)
    }

    pub(crate) fn of(
        name: &'static str,
        holds: Holds,
        about: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self { name: name.into(), holds, about: about.into(), body: None }
    }

    pub(crate) fn time(about: &'static str) -> Self {
        Self::number("t", "T", about)
    }

    /// That of a column of a table of the motion of these hinges; names of those in degrees end in `_deg`.
    pub fn of_motion(table: &WantedTable, column: &Column, hinges: &[HingeLabel]) -> Self {
        let suffix = if table.is_in_degrees(column, hinges) { "_deg" } else { "" };
        let is_code = column.quantity == Quantity::State;
        let name = column.hinge.and_then(|hinge| hinges[hinge].name.as_deref());
        Self {
            name: (column.name(hinges) + suffix).into(),
            holds: if is_code { Holds::Count } else { Holds::Number(table.unit(column, hinges)) },
            about: column.about(hinges).into(),
            body: name.map(str::to_owned),
        }
    }

    /// The unit with its labels, of numbers that have one for all rows.
    pub fn unit(&self, units: &UnitSystem) -> Option<String> {
        match self.holds {
            Holds::Number(unit) => Some(units.label(unit)),
            Holds::Various | Holds::Count | Holds::Text => None,
        }
    }
}

/// Columns of a table of the motion of these hinges: the time, and those that it says.
pub fn motion_heads(table: &WantedTable, hinges: &[HingeLabel]) -> Vec<Head> {
    let head = |column| Head::of_motion(table, column, hinges);
    [Head::time("time")].into_iter().chain(table.columns.iter().map(head)).collect()
}

/// How the headers of tables call columns: by their names, or with units behind these.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Headings {
    units: Option<UnitSystem>,
}

impl Headings {
    /// Names with units in brackets, as `t [s]`; numbers without a unit keep their names alone.
    pub fn with_units(units: UnitSystem) -> Self {
        Self { units: Some(units) }
    }

    /// What stands in the header.
    pub(crate) fn cell(&self, head: &Head) -> String {
        let of_one = head.holds == Holds::Number(ONE);
        let unit = self.units.as_ref().filter(|_| !of_one).and_then(|units| head.unit(units));
        unit.map_or_else(|| head.name.to_string(), |unit| format!("{} [{unit}]", head.name))
    }

    /// The header, without the end of its line.
    pub(crate) fn line(&self, heads: &[Head]) -> String {
        heads.iter().map(|head| self.cell(head)).collect::<Vec<_>>().join(",")
    }
}

/// The name of a column by what stands in the header, with or without a unit.
pub fn column_name(cell: &str) -> &str {
    cell.split_once(" [").map_or(cell, |(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture;

    #[test]
    fn units_stand_behind_names_on_request_alone() {
        let table = WantedTable { in_degrees: true, ..WantedTable::states(1) };
        let heads = motion_heads(&table, &fixture::labels()[..1]);
        let plain = Headings::default();
        let headings = Headings::with_units(UnitSystem::Si);
        for (cell, alone) in [
            ("t [s]", "t"),
            ("v_y [m/s]", "v_y"),
            ("chi", "chi"),
            ("beta_1_1_deg [deg]", "beta_1_1_deg"),
            ("tau_1_1_deg [deg/s]", "tau_1_1_deg"),
            ("state_1_1", "state_1_1"),
            ("kinetic_energy [N m]", "kinetic_energy"),
        ] {
            let head = heads.iter().find(|head| head.name == alone).expect(alone);
            assert_eq!(
                (headings.cell(head), plain.cell(head)),
                (cell.to_owned(), alone.to_owned())
            );
            assert_eq!(column_name(cell), alone);
        }
    }
}
