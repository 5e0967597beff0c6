//! Columns of the tables of a study.

use nboom_model::{UnitSystem, WantedTable};
use nboom_results::{Head, Holds, motion_heads};
use nboom_tables::{Column, Kind};

use crate::Study;
use crate::study::{Relation, Variable};

/// Those of the table of cases: case, seed, fault if there are any, variables, results, status.
pub fn columns(study: &Study) -> Vec<Column> {
    let mut columns =
        vec![case(), Column::new("seed", Kind::Integer, "seed of the draw of the case")];
    if !study.faults.is_empty() {
        columns.push(Column::new("fault", Kind::Text, "what is broken, if anything is"));
    }
    columns.extend(study.variables.iter().map(|variable| of_variable(variable, study)));
    columns.extend(study.wanted.iter().map(|wanted| wanted.column().clone()));
    let about = "`ok`, `ok, runs away`, `ok, poor conservation`, `ok, latch in doubt`, or why there are no results";
    columns.push(Column::new("status", Kind::Text, about));
    columns
}

/// That of a variable, which says what becomes of its numbers.
fn of_variable(variable: &Variable, study: &Study) -> Column {
    let (document, slots) = (&study.document, &variable.slots);
    let paths: Vec<String> = slots.iter().map(|slot| document.path(slot)).collect();
    let (word, unit) = match variable.relation {
        Relation::Factor => ("factor on", Some("1")),
        relation => {
            let units = || slots.iter().map(|slot| document.unit(slot));
            let unit = units().next().flatten().filter(|first| units().all(|of| of == Some(first)));
            (if relation == Relation::Value { "value of" } else { "offset to" }, unit)
        }
    };
    let about = format!("{word} {}", paths.join(", "));
    let column = Column::new(&variable.name, Kind::Number, about);
    match unit {
        Some(unit) => column.in_units_of(units(&study.nominal).label(unit)),
        None => column,
    }
}

/// Those of the table of the states of all cases: case, time, and the columns of `states.csv`.
pub fn trajectory_columns(study: &Study) -> Vec<Column> {
    let (units, hinges) = (units(&study.nominal), study.nominal.scene.labels());
    let heads = motion_heads(&WantedTable::states(hinges.len()), hinges);
    [case()].into_iter().chain(heads.into_iter().map(|head| of_run(head, &units))).collect()
}

/// The labels of the units of a scene.
pub(crate) fn units(file: &nboom_io::SceneFile) -> UnitSystem {
    file.settings.units.clone().unwrap_or_default()
}

/// A column of a table of a run.
pub(crate) fn of_run(head: Head, units: &UnitSystem) -> Column {
    let kind = match head.holds {
        Holds::Number(_) | Holds::Various => Kind::Number,
        Holds::Count => Kind::Integer,
        Holds::Text => Kind::Text,
    };
    let unit = head.unit(units);
    let Head { name, about, body, .. } = head;
    Column { unit, body, ..Column::new(name, kind, about) }
}

fn case() -> Column {
    Column::new("case", Kind::Integer, "number of the case, from 1")
}
