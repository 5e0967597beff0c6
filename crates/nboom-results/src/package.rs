//! `datapackage.json`: what the columns of all tables of a run are, for programs that read them.
//!
//! It is a [Data Package](https://specs.frictionlessdata.io/tabular-data-package/), with a key `unit` for each
//! column of numbers.

use nboom_model::{Scene, UnitSystem, WantedTable};
use serde::Serialize;

use crate::heads::{Head, Headings, Holds, motion_heads};
use crate::{
    EVENTS_FILE, INSTANTS_FILE, LEDGER_FILE, OUTPUT_FILE, RunDescription, STATES_FILE, events,
    ledger,
};

/// The columns of a table.
#[derive(Clone, Debug)]
pub(crate) struct TableHeads {
    pub file: &'static str,
    pub heads: Vec<Head>,
}

#[derive(Serialize)]
struct PackageKeys<'a> {
    profile: &'static str,
    title: &'a str,
    resources: Vec<ResourceKeys<'a>>,
}

#[derive(Serialize)]
struct ResourceKeys<'a> {
    name: &'a str,
    path: &'a str,
    profile: &'static str,
    schema: SchemaKeys<'a>,
}

#[derive(Serialize)]
struct SchemaKeys<'a> {
    fields: Vec<FieldKeys<'a>>,
}

#[derive(Serialize)]
struct FieldKeys<'a> {
    name: String,
    #[serde(rename = "type")]
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<String>,
    description: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    body: Option<&'a str>,
}

/// The tables of a run without stresses.
pub(crate) fn tables(scene: &Scene, run: &RunDescription) -> Vec<TableHeads> {
    let hinges = scene.labels();
    let motion =
        |file, table: &WantedTable| TableHeads { file, heads: motion_heads(table, hinges) };
    let states = WantedTable::states(hinges.len());
    let mut tables = vec![
        motion(STATES_FILE, &states),
        motion(INSTANTS_FILE, &states),
        TableHeads { file: EVENTS_FILE, heads: events::event_heads(hinges) },
        TableHeads { file: LEDGER_FILE, heads: ledger::heads(scene) },
    ];
    tables.extend(run.output.table.as_ref().map(|table| motion(OUTPUT_FILE, table)));
    tables
}

/// The text of the file.
pub(crate) fn text(
    title: &str,
    tables: &[TableHeads],
    headings: &Headings,
    units: &UnitSystem,
) -> Vec<u8> {
    let resources = tables.iter().map(|table| ResourceKeys {
        name: name(table.file),
        path: table.file,
        profile: "tabular-data-resource",
        schema: SchemaKeys {
            fields: table.heads.iter().map(|head| field(head, headings, units)).collect(),
        },
    });
    let resources = resources.collect();
    let keys = PackageKeys { profile: "tabular-data-package", title, resources };
    let mut text = serde_json::to_vec_pretty(&keys).expect("the keys are texts");
    text.push(b'\n');
    text
}

/// The name of a table: that of its file without the ending.
fn name(file: &'static str) -> &'static str {
    file.split_once('.').map_or(file, |(name, _)| name)
}

fn field<'a>(head: &'a Head, headings: &Headings, units: &UnitSystem) -> FieldKeys<'a> {
    FieldKeys {
        name: headings.cell(head),
        kind: match head.holds {
            Holds::Number(_) | Holds::Various => "number",
            Holds::Count => "integer",
            Holds::Text => "string",
        },
        unit: head.unit(units),
        description: &head.about,
        body: head.body.as_deref(),
    }
}
