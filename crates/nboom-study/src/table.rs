//! Columns of the tables of a study.

use nboom_model::{Quantity, UnitSystem};
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
    let units = units(&study.nominal);
    let hinges = study.nominal.scene.labels();
    let time = Column::new("t", Kind::Number, "time").in_units_of(units.time());
    let motion = nboom_model::Column::all(hinges.len());
    let motion = motion.iter().map(|column| of_motion(column, column.name(hinges), hinges, &units));
    [case(), time].into_iter().chain(motion).collect()
}

/// The labels of the units of a scene.
pub(crate) fn units(file: &nboom_io::SceneFile) -> UnitSystem {
    file.settings.units.clone().unwrap_or_default()
}

/// A column of the motion under this name.
pub(crate) fn of_motion(
    column: &nboom_model::Column,
    name: String,
    hinges: &[nboom_model::HingeLabel],
    units: &UnitSystem,
) -> Column {
    let about = column.about(hinges);
    let body = column.hinge.and_then(|hinge| hinges[hinge].name.as_deref()).map(str::to_owned);
    let found = if column.quantity == Quantity::State {
        Column::new(name, Kind::Integer, about)
    } else {
        Column::new(name, Kind::Number, about).in_units_of(units.label(column.unit(hinges)))
    };
    Column { body, ..found }
}

fn case() -> Column {
    Column::new("case", Kind::Integer, "number of the case, from 1")
}
