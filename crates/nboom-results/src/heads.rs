//! What the columns of tables are called, and what they hold.

use std::borrow::Cow;

use nboom_model::{HingeLabel, UnitSystem, WantedTable};

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Head {
    pub name: Cow<'static, str>,
    pub holds: Holds,
    /// What it is, in one line.
    pub about: Cow<'static, str>,
    /// The body on the hinge of a quantity of hinges, of a scene that has names.
    pub body: Option<String>,
}

/// What stands in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
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
    pub fn number(
        name: &'static str,
        unit: &'static str,
        about: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self::of(name, Holds::Number(unit), about)
    }

    pub fn count(name: &'static str, about: &'static str) -> Self {
        Self::of(name, Holds::Count, about)
    }

    pub fn text(name: &'static str, about: &'static str) -> Self {
        Self::of(name, Holds::Text, about)
    }

    pub fn of(name: &'static str, holds: Holds, about: impl Into<Cow<'static, str>>) -> Self {
        Self { name: name.into(), holds, about: about.into(), body: None }
    }

    pub fn time(about: &'static str) -> Self {
        Self::number("t", "T", about)
    }

    /// The unit with its labels, of numbers that have one for all rows.
    pub fn unit(&self, units: &UnitSystem) -> Option<String> {
        match self.holds {
            Holds::Number(unit) => Some(units.label(unit)),
            Holds::Various | Holds::Count | Holds::Text => None,
        }
    }
}

/// Those of a table of the motion.
pub(crate) fn of_motion(table: &WantedTable, hinges: &[HingeLabel]) -> Vec<Head> {
    let head = |column: &nboom_model::Column| {
        let suffix = if table.is_in_degrees(column, hinges) { "_deg" } else { "" };
        let is_code = column.quantity == nboom_model::Quantity::State;
        let name = column.hinge.and_then(|hinge| hinges[hinge].name.as_deref());
        Head {
            name: (column.name(hinges) + suffix).into(),
            holds: if is_code { Holds::Count } else { Holds::Number(table.unit(column, hinges)) },
            about: column.about(hinges).into(),
            body: name.map(str::to_owned),
        }
    };
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
    use nboom_model::Column;

    #[test]
    fn units_stand_behind_names_on_request_alone() {
        let columns = Column::all(1);
        let table = WantedTable { columns, in_degrees: true };
        let heads = of_motion(&table, &fixture::labels()[..1]);
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
