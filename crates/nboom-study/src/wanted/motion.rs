//! Columns of the table of states, at the end or at their extremes.

use nboom_io::{SceneFile, nearest};
use nboom_model::{Column, Quantity, WantedTable};
use nboom_results::{Head, quantity};
use nboom_sim::{Snapshot, Summary};

use super::{Named, Needs, What, refused};
use crate::statistics::Meaning;
use crate::table::{of_run, units};

/// What is taken of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Taken {
    Final,
    Largest,
    Smallest,
}

/// A column of the motion, at the end or at its extreme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Extreme {
    taken: Taken,
    column: Column,
}

/// What is called so before the name of a column.
pub(super) const WORDS: [&str; 3] = ["final", "largest", "smallest"];

/// What a number is of whose text this is the first word, if it is one of such a column.
pub(super) fn meaning(word: &str) -> Option<Meaning> {
    match word {
        "largest" => Some(Meaning::Largest),
        "smallest" => Some(Meaning::Smallest),
        "final" => Some(Meaning::Other),
        _ => None,
    }
}

/// The column with this name, taken as the word says.
pub(super) fn named(word: &str, text: &str, file: &SceneFile) -> Named {
    let SceneFile { scene, .. } = file;
    let named = |text: &str| Column::named(text, scene.labels(), scene.rotors.len());
    let single = |columns: &[Column]| format!("{word} {}", columns[0].name(scene.labels()));
    let columns = named(text).or_else(|_| named(text.trim())).map_err(|unknown| {
        let meant = nearest(text, unknown.known.iter().map(String::as_str));
        let meant = meant.and_then(|name| match &named(name).ok()?[..] {
            [_] => Some(format!("{word} {name}")),
            columns => Some(single(columns)),
        });
        (unknown.expected.to_owned(), meant)
    })?;
    let [column] = columns[..] else {
        return Err(("a single column of the motion".to_owned(), Some(single(&columns))));
    };
    let table = WantedTable { columns, in_degrees: false };
    if table.is_of_held_body() && !scene.base.is_held() {
        return Err(refused("columns of a main body that moves freely"));
    }
    let taken = match word {
        "largest" => Taken::Largest,
        "smallest" => Taken::Smallest,
        _ => Taken::Final,
    };
    let head = of_run(Head::of_motion(&table, &column, scene.labels()), &units(file));
    let description = match taken {
        Taken::Final => format!("{}, at the end", head.description),
        _ => format!("{}, {word} of output times and events", head.description),
    };
    let head = nboom_tables::Column { description, ..head };
    Ok((What::Motion(Extreme { taken, column }), head, Needs::Nothing))
}

impl Extreme {
    /// What it is in a run of this summary: NaN where it says nothing.
    pub fn meant(&self, value: f64, summary: &Summary) -> f64 {
        let is_rounding =
            self.column.quantity == Quantity::Nutation && !summary.has_angular_momentum;
        if is_rounding { f64::NAN } else { value }
    }

    /// Whether it takes an evaluation of the equations of motion.
    pub fn needs_detail(&self) -> bool {
        WantedTable { columns: vec![self.column], in_degrees: false }.needs_detail()
    }

    /// Whether both sides of each instant may change it, and not only output times.
    pub fn needs_instants(&self) -> bool {
        self.taken != Taken::Final
    }

    /// The value so far, NaN at the start, and that of a snapshot make the next one.
    pub fn follow(&self, value: &mut f64, snapshot: &Snapshot) {
        let here = quantity(&self.column, snapshot);
        *value = match self.taken {
            Taken::Final => here,
            Taken::Largest => value.max(here),
            Taken::Smallest => value.min(here),
        };
    }
}
