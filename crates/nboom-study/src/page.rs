//! The page of a sweep: what it shows, as data in the page, of which the page's own program makes elements.

use serde::Serialize;

use crate::statistics::Summary;

/// What a page says of a sweep beside its statistics.
#[derive(Clone, Debug, Serialize)]
pub struct Facts {
    /// The study's name.
    pub name: String,
    /// The study as `nboom run` takes it.
    pub study: String,
    /// The scene's file.
    pub scene: String,
    /// How draws were made, by its name in studies.
    pub method: String,
    /// The study's seed.
    pub seed: u64,
    /// How many draws there are.
    pub draws: u64,
    /// Variables that were drawn to vary together.
    pub vary_together: Vec<String>,
    /// The version that ran it.
    pub version: String,
    /// Cases that have a page of their own, `worst/case-N/report.html` beside this one.
    pub reports: Vec<u64>,
}

#[derive(Serialize)]
struct PageKeys<'a> {
    facts: &'a Facts,
    summary: &'a Summary,
}

/// The page of a sweep.
pub fn page(facts: &Facts, summary: &Summary) -> String {
    nboom_report::sweep_page(&facts.name, &PageKeys { facts, summary })
}
