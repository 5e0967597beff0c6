//! The page of a sweep as text; a browser opens it elsewhere.

use nboom_study::statistics::{Field, Role, Statistics, Summary};
use nboom_study::{Facts, Requirement, page};
use nboom_tables::Cell;

use crate::{field, uniform};

const HOSTILE: &str = "</script><img src=x onerror=alert(1)> <!-- @SCRIPT@ & \"quoted\" \u{2028}";

fn facts(name: &str) -> Facts {
    Facts {
        name: name.to_owned(),
        study: name.to_owned(),
        scene: name.to_owned(),
        method: "monte_carlo".to_owned(),
        seed: 1970,
        draws: 2000,
        vary_together: vec![name.to_owned(); 2],
        version: "0.1.0".to_owned(),
        reports: vec![3],
    }
}

/// Statistics of as many columns with names of this kind.
fn summary(columns: usize, rows: usize, name: &str) -> Summary {
    let role = |i| if i % 2 == 0 { Role::Variable } else { Role::Result };
    let column = |i| field(&format!("{name} {i}"), role(i));
    let status = field("status", Role::Status);
    let fields: Vec<Field> =
        (0..columns).map(column).chain([field("fault", Role::Fault), status]).collect();
    let results = fields.iter().filter(|field| field.role == Role::Result);
    let required = results.map(|Field { label, .. }| Requirement {
        result: label.clone(),
        at_least: Some(0.1),
        at_most: None,
    });
    let required: Vec<_> = required.collect();
    let mut statistics = Statistics::new(fields, &required);
    let mut random = uniform(5);
    for row in 0..rows {
        let numbers = random.by_ref().take(columns).map(Cell::Number);
        let fault = if row % 2 == 0 { Cell::Empty } else { Cell::Text(name) };
        let status = Cell::Text(if row % 5 == 0 { name } else { "ok" });
        statistics.row(&numbers.chain([fault, status]).collect::<Vec<_>>());
    }
    statistics.finish()
}

/// The text between two others that stand once each.
fn between<'a>(page: &'a str, start: &str, end: &str) -> &'a str {
    let (_, rest) = page.split_once(start).expect("a start");
    rest.split_once(end).expect("an end").0
}

#[test]
fn names_stay_texts() {
    let (facts, summary) = (facts(HOSTILE), summary(4, 40, HOSTILE));
    let found = page(&facts, &summary);
    let plain = page(&self::facts("plain"), &self::summary(4, 40, "plain"));
    for mark in ["<script", "</script", "<img", "<!--"] {
        assert_eq!(found.matches(mark).count(), plain.matches(mark).count(), "{mark}");
    }
    let data = between(&found, "type=\"application/json\">", "</script>");
    assert!(!data.contains('<'));
    let keys: serde_json::Value = serde_json::from_str(data).expect("JSON");
    assert_eq!(keys["facts"]["name"], HOSTILE);
    let read: Summary = serde_json::from_value(keys["summary"].clone()).expect("statistics");
    assert_eq!(read, summary);
}

#[test]
fn pages_are_known_by_their_mark_and_run_only_their_own_program() {
    use base64::Engine;
    use sha2::Digest;
    let found = page(&facts("plain"), &summary(4, 40, "plain"));
    assert!(found[..1000].contains(nboom_results::REPORT_MARK));
    let program = between(&found, "<script>", "</script>");
    let hash = sha2::Sha256::digest(program);
    let hash = base64::prelude::BASE64_STANDARD.encode(hash);
    assert_eq!(between(&found, "script-src '", "'"), format!("sha256-{hash}"));
    assert!(!program.contains("innerHTML"));
    for address in ["http://", "https://", "src=", "url(", "@import"] {
        let own = found.replace("http://www.w3.org/2000/svg", "");
        assert!(!own.contains(address), "{address}");
    }
}

#[test]
fn twenty_columns_and_two_thousand_points_are_less_than_a_megabyte() {
    let summary = summary(20, 5000, "a name of usual length");
    assert_eq!(summary.points.cases.len(), 2000);
    let found = page(&facts("plain"), &summary);
    assert!(found.len() < 1_000_000, "{}", found.len());
}
