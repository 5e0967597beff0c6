//! The page of a sweep: one file that needs no network and no program but a browser.
//!
//! What it shows is in the page as data, of which the page's own program makes elements. No text of a study becomes
//! markup or program, and the page's policy lets a browser run only the program whose hash it names.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::statistics::Summary;

const TEMPLATE: &str = include_str!("page/sweep.html");
const STYLE: &str = include_str!("page/sweep.css");

/// The files of the page's program, in one scope.
const PROGRAM: &str = concat!(
    "'use strict';\n(() => {\n",
    include_str!("page/text.js"),
    include_str!("page/picture.js"),
    include_str!("page/sweep.js"),
    "})();\n",
);

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
    let keys = PageKeys { facts, summary };
    let data = serde_json::to_string(&keys).expect("the keys are texts and numbers");
    let hash = BASE64_STANDARD.encode(Sha256::digest(PROGRAM));
    // The data come last, so that no mark within them is one of the template.
    TEMPLATE
        .replace("@SCRIPT_HASH@", &format!("sha256-{hash}"))
        .replace("@STYLE@", STYLE)
        .replace("@SCRIPT@", PROGRAM)
        .replace("@DATA@", &data.replace('<', "\\u003c"))
}
