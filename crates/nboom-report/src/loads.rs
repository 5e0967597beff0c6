//! Hinge loads and stresses: long tables, of which the page has a column for each hinge or station.

use std::collections::HashMap;
use std::path::Path;

use nboom_results::{ENVELOPE_FILE, HINGE_ENVELOPE_FILE, HINGE_LOADS_FILE, STRESS_FILE};
use nboom_tables::{Fields, Rows, count, number};
use serde::Serialize;

use crate::Gap;
use crate::table::Table;

/// Loads over time, and peaks of stresses at lock-ups and impacts.
#[derive(Debug, Default)]
pub(crate) struct Loads {
    pub motion: Table,
    pub peaks: Table,
    pub gap: Option<Gap>,
}

/// Rows of one instant that become one row.
struct Pivot {
    table: Table,
    places: HashMap<String, usize>,
    row: Vec<f64>,
}

impl Pivot {
    fn new() -> Self {
        Self {
            table: Table::new(vec!["t".to_owned()]),
            places: HashMap::new(),
            row: vec![f64::NAN],
        }
    }

    fn set(&mut self, time: f64, name: String, value: f64) {
        if self.row[0] != time {
            self.close();
            self.row[0] = time;
        }
        let rows = self.table.rows();
        let place = *self.places.entry(name).or_insert_with_key(|name| {
            self.table.names.push(name.clone());
            self.table.columns.push(vec![0.0; rows]);
            self.table.names.len() - 1
        });
        self.row.resize(self.table.names.len(), 0.0);
        self.row[place] = value;
    }

    fn close(&mut self) {
        if !self.row[0].is_nan() {
            self.table.push(&self.row);
            self.row[1..].fill(0.0);
        }
    }

    fn finish(mut self) -> Table {
        self.close();
        self.table
    }
}

/// The size of a force or moment.
fn size(fields: &Fields<'_>, places: &[usize]) -> Result<f64, String> {
    let mut sum = 0.0;
    for &place in places {
        sum += number(&fields[place])?.powi(2);
    }
    Ok(sum.sqrt())
}

/// Sizes of the force and the moment of every hinge.
pub(crate) fn hinge_loads(directory: &Path) -> Result<Option<Loads>, Gap> {
    let Some(mut rows) = Rows::open(directory, HINGE_LOADS_FILE)? else { return Ok(None) };
    let [t, event, appendage, segment] = rows.places(["t", "event", "appendage", "segment"])?;
    let force = rows.places(["p_xi", "p_eta", "p_zeta"])?;
    let moment = rows.places(["q_xi", "q_eta", "q_zeta"])?;
    let mut pivot = Pivot::new();
    let ended = rows.each(|fields| {
        // What is largest at lock-ups and impacts is in the envelope.
        if !fields[event].is_empty() {
            return Ok(());
        }
        let time = number(&fields[t])?;
        let hinge = format!("{}_{}", count(&fields[appendage])?, count(&fields[segment])?);
        pivot.set(time, format!("force_{hinge}"), size(fields, &force)?);
        pivot.set(time, format!("moment_{hinge}"), size(fields, &moment)?);
        Ok(())
    });
    Ok(Some(loads([pivot, Pivot::new()], ended.map_err(Gap::from))))
}

fn loads([motion, peaks]: [Pivot; 2], ended: Result<(), Gap>) -> Loads {
    Loads { motion: motion.finish(), peaks: peaks.finish(), gap: ended.err() }
}

/// The largest von Mises stress of every station.
pub(crate) fn stresses(directory: &Path) -> Result<Option<Loads>, Gap> {
    let Some(mut rows) = Rows::open(directory, STRESS_FILE)? else { return Ok(None) };
    let [t, event, appendage, segment, station, point, von_mises] =
        rows.places(["t", "event", "appendage", "segment", "station", "point", "von_mises"])?;
    let mut pivots = [Pivot::new(), Pivot::new()];
    let ended = rows.each(|fields| {
        if &fields[point] != "max" {
            return Ok(());
        }
        let pivot = &mut pivots[usize::from(!fields[event].is_empty())];
        let [k, i, s] = [appendage, segment, station].map(|place| count(&fields[place]));
        pivot.set(
            number(&fields[t])?,
            format!("{}_{}_{}", k?, i?, s?),
            number(&fields[von_mises])?,
        );
        Ok(())
    });
    Ok(Some(loads(pivots, ended.map_err(Gap::from))))
}

/// A row of either envelope.
#[derive(Debug, Serialize)]
pub struct Worst {
    /// Of the hinge or segment, from 1.
    pub appendage: usize,
    /// Its place in the appendage, from 1.
    pub segment: usize,
    /// When.
    pub t: f64,
    event: String,
    event_appendage: Option<usize>,
    event_segment: Option<usize>,
    /// Of what it is the largest value.
    #[serde(flatten)]
    pub what: Largest,
}

/// The largest value of a load.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Largest {
    /// Of a hinge.
    Hinge {
        /// `force` or `moment`.
        quantity: String,
        /// Its magnitude.
        magnitude: f64,
    },
    /// Of a station.
    Station {
        /// Which one of its segment, from 1.
        station: usize,
        /// The von Mises stress.
        von_mises: f64,
        /// The load that causes most of it.
        driver: String,
        /// Margin to yielding.
        margin: Option<f64>,
        /// Margin to breaking.
        ultimate_margin: Option<f64>,
    },
}

impl Largest {
    /// Loads are compared within a kind: forces, moments, stresses.
    fn kind(&self) -> &str {
        match self {
            Self::Hinge { quantity, .. } => quantity,
            Self::Station { .. } => "stress",
        }
    }

    fn load(&self) -> f64 {
        match *self {
            Self::Hinge { magnitude, .. } => magnitude,
            Self::Station { von_mises, .. } => von_mises,
        }
    }
}

/// Sorts by the share that a load is of the largest of its kind, the worst first.
pub(crate) fn sort_by_load(rows: &mut [Worst]) {
    let mut largest: HashMap<String, f64> = HashMap::new();
    for Worst { what, .. } in &*rows {
        let most = largest.entry(what.kind().to_owned()).or_default();
        *most = most.max(what.load());
    }
    let share = |row: &Worst| row.what.load() / largest[row.what.kind()];
    rows.sort_by(|a, b| share(b).total_cmp(&share(a)));
}

/// The rows of an envelope, and what ended it early.
pub(crate) type Envelope = (Vec<Worst>, Option<Gap>);

/// The largest force and moment of each hinge.
pub(crate) fn hinge_envelope(directory: &Path) -> Result<Option<Envelope>, Gap> {
    envelope(directory, HINGE_ENVELOPE_FILE, |rows| {
        let [quantity, magnitude] = rows.places(["quantity", "magnitude"])?;
        Ok(move |fields: &Fields<'_>| {
            Ok(Largest::Hinge {
                quantity: fields[quantity].to_owned(),
                magnitude: number(&fields[magnitude])?,
            })
        })
    })
}

/// The largest stress of each station.
pub(crate) fn stress_envelope(directory: &Path) -> Result<Option<Envelope>, Gap> {
    envelope(directory, ENVELOPE_FILE, |rows| {
        let [station, von_mises, driver, margin] =
            rows.places(["station", "von_mises", "driver", "margin"])?;
        // Where no material has an ultimate stress there is no such column.
        let ultimate_margin = rows.place("ultimate_margin").ok();
        let given = |text: &str| Some(text).filter(|text| !text.is_empty()).map(number).transpose();
        Ok(move |fields: &Fields<'_>| {
            Ok(Largest::Station {
                station: count(&fields[station])?,
                von_mises: number(&fields[von_mises])?,
                driver: fields[driver].to_owned(),
                margin: given(&fields[margin])?,
                ultimate_margin: ultimate_margin.map_or(Ok(None), |place| given(&fields[place]))?,
            })
        })
    })
}

fn envelope<F>(
    directory: &Path,
    file: &'static str,
    what: impl FnOnce(&Rows) -> Result<F, Gap>,
) -> Result<Option<Envelope>, Gap>
where
    F: Fn(&Fields<'_>) -> Result<Largest, String>,
{
    let Some(mut rows) = Rows::open(directory, file)? else { return Ok(None) };
    let [t, event, appendage, segment, event_appendage, event_segment] =
        rows.places(["t", "event", "appendage", "segment", "event_appendage", "event_segment"])?;
    let what = what(&rows)?;
    let mut found = Vec::new();
    let of_event = |field: &str| Some(field).filter(|text| !text.is_empty()).map(count).transpose();
    let ended = rows.each(|fields| {
        found.push(Worst {
            appendage: count(&fields[appendage])?,
            segment: count(&fields[segment])?,
            t: number(&fields[t])?,
            event: fields[event].to_owned(),
            event_appendage: of_event(&fields[event_appendage])?,
            event_segment: of_event(&fields[event_segment])?,
            what: what(fields)?,
        });
        Ok(())
    });
    Ok(Some((found, ended.err().map(Gap::from))))
}
