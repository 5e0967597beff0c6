//! Columns of the tables of a study.

use nboom_model::{Quantity, UnitSystem};
use nboom_tables::{Column, Kind};

use crate::Study;

/// Those of the table of cases: case, seed, fault if there are any, variables, results, status.
pub fn columns(study: &Study) -> Vec<Column> {
    let mut columns =
        vec![case(), Column::new("seed", Kind::Integer, "seed of the draw of the case")];
    if !study.faults.is_empty() {
        columns.push(Column::new("fault", Kind::Text, "what is broken, if anything is"));
    }
    columns.extend(study.variables.iter().map(|variable| {
        Column::new(&variable.name, Kind::Number, "what is drawn for this variable")
    }));
    columns.extend(study.wanted.iter().map(|wanted| wanted.column().clone()));
    let about = "`ok`, `ok, poor conservation`, `ok, latch in doubt`, or why there are no results";
    columns.push(Column::new("status", Kind::Text, about));
    columns
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
