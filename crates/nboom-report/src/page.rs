//! Pages: the bundles with a title and data.

use serde::Serialize;
use serde_json::Value;

use crate::captions::Captions;
use crate::events::EventKeys;
use crate::geometry::{SceneKeys, UnitKeys};
use crate::hinges::Hinge;
use crate::loads::Worst;
use crate::pack::{Packed, Packing};
use crate::rotors::Rotor;
use crate::run::Run;
use crate::table::Table;
use crate::text;

/// Pages without title and data: that of runs, and that of a sweep.
const OF_RUNS: &str = include_str!("../page/bundle/page.html");
const OF_A_SWEEP: &str = include_str!("../page/bundle/sweep.html");

/// Bytes of the tables in a page.
const TABLES: usize = 6_000_000;

/// No page is longer than this, whatever the run \[bytes\], but for scenes and events of unusual length.
pub const MOST_BYTES: usize = 10_000_000;

#[derive(Serialize)]
struct PageKeys<'a> {
    runs: Vec<RunKeys<'a>>,
}

#[derive(Serialize)]
struct RunKeys<'a> {
    label: &'a str,
    units: UnitKeys,
    summary: Option<&'a Value>,
    certificate: Option<&'a Value>,
    gaps: Vec<String>,
    /// What was left out so that the page stays small.
    thinned: Option<String>,
    captions: Captions,
    hinges: Vec<Hinge>,
    rotors: Vec<Rotor>,
    scene: Option<SceneKeys>,
    text: Option<&'a str>,
    events: &'a [EventKeys],
    motion: Option<Packed<'a>>,
    has_momentum: bool,
    /// Of the main body, from 0; nutation is about it.
    spin_axis: usize,
    /// Radians in a unit of time.
    least_rate: f64,
    is_slid: bool,
    kick_offs: Option<Packed<'a>>,
    rotor_speeds: Option<Packed<'a>>,
    requested: Option<Packed<'a>>,
    ledger: Option<Packed<'a>>,
    hinge_loads: Option<Packed<'a>>,
    stress: Option<Packed<'a>>,
    stress_peaks: Option<Packed<'a>>,
    hinge_envelope: &'a [Worst],
    stress_envelope: &'a [Worst],
}

/// The page of a run, or of several on the same axes.
pub fn page(mut runs: Vec<Run>) -> String {
    let packing = Packing::of(runs.iter().flat_map(Run::tables), TABLES);
    let thinned: Vec<_> = runs.iter_mut().map(|run| thin(run, packing)).collect();
    let keys = runs.iter().zip(thinned).map(|(run, thinned)| keys(run, thinned, packing));
    let data = PageKeys { runs: keys.collect() };
    let title = match &runs[..] {
        [run] => run.label.clone(),
        runs => format!("{} runs", runs.len()),
    };
    filled(OF_RUNS, &title, &data)
}

/// The page of a sweep of this name, from what its program reads.
pub fn sweep_page(name: &str, data: &impl Serialize) -> String {
    filled(OF_A_SWEEP, name, data)
}

/// A page with its title and data, which are text whatever is in them.
fn filled(template: &str, title: &str, data: &impl Serialize) -> String {
    let data = serde_json::to_string(data).expect("the keys are texts and numbers");
    let parts = [("@TITLE@", text::escaped(title)), ("@DATA@", text::json(&data))];
    let mut page = String::with_capacity(template.len() + data.len() + data.len() / 8);
    let mut rest = template;
    for (mark, part) in parts {
        // Bundles have both, in this order; a test looks.
        let (before, after) = rest.split_once(mark).unwrap_or((rest, ""));
        page.push_str(before);
        page.push_str(&part);
        rest = after;
    }
    page + rest
}

/// Leaves out rows that nobody would see, and says so.
fn thin(run: &mut Run, packing: Packing) -> Option<String> {
    let times: Vec<f64> = run.events.iter().map(|event| event.t).collect();
    let mut told: Option<(usize, usize, f64)> = None;
    for table in run.tables_mut() {
        let needed = rows_at(table, &times);
        let deviation = packing.thin(table, &needed);
        if deviation.is_none() && table.read == table.rows() {
            continue;
        }
        let deviation = deviation.unwrap_or(0.0).max(told.map_or(0.0, |(_, _, worst)| worst));
        let (rows, read) = told.map_or((table.rows(), table.read), |(rows, read, _)| (rows, read));
        told = Some((rows, read, deviation));
    }
    let (rows, read, deviation) = told.filter(|(rows, read, _)| rows < read)?;
    Some(format!(
        "The page has {rows} of {read} rows. Extremes and events are all there; between them curves are \
         off by at most {:.2} % of their range. The tables have the rest.",
        100.0 * deviation
    ))
}

/// Rows of a table at these times, which ascend.
fn rows_at(table: &Table, times: &[f64]) -> Vec<usize> {
    let Some(of_rows) = table.columns.first() else { return Vec::new() };
    let is_at = |row: &usize| times.binary_search_by(|time| time.total_cmp(&of_rows[*row])).is_ok();
    (0..of_rows.len()).filter(is_at).collect()
}

fn keys(run: &Run, thinned: Option<String>, packing: Packing) -> RunKeys<'_> {
    let pack = |table| packed(table, packing);
    let (hinges, stresses) = (run.hinge_loads.as_ref(), run.stresses.as_ref());
    RunKeys {
        label: &run.label,
        units: UnitKeys::from(&run.units),
        summary: run.summary.as_ref(),
        certificate: run.certificate.as_ref(),
        gaps: run.gaps().iter().map(ToString::to_string).collect(),
        thinned,
        captions: run.captions(),
        hinges: run.hinges(),
        rotors: run.rotors(),
        scene: run.file.as_ref().map(SceneKeys::from),
        text: run.text.as_deref(),
        events: &run.events,
        motion: pack(run.motion.as_ref()),
        has_momentum: run.has_momentum(),
        spin_axis: run.spin_axis().number(),
        least_rate: run.least_rate(),
        is_slid: run.is_slid(),
        kick_offs: pack(run.kick_offs.as_ref()),
        rotor_speeds: pack(run.rotor_speeds.as_ref()),
        requested: pack(run.requested.as_ref()),
        ledger: pack(run.ledger.as_ref()),
        hinge_loads: pack(hinges.map(|loads| &loads.motion)),
        stress: pack(stresses.map(|loads| &loads.motion)),
        stress_peaks: pack(stresses.map(|loads| &loads.peaks)),
        hinge_envelope: &run.hinge_envelope,
        stress_envelope: &run.stress_envelope,
    }
}

/// A table, unless it is empty.
fn packed(table: Option<&Table>, packing: Packing) -> Option<Packed<'_>> {
    table.filter(|table| table.rows() > 0).map(|table| packing.pack(table))
}
