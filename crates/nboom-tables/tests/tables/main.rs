//! Tables in formats of other programs: what is in them, and what is refused.

mod formats;
mod input;
mod rows;

use std::fs;
use std::path::PathBuf;

use serde_json::{Value, json};
use tempfile::TempDir;

/// The directory of a run of two tables.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new() -> Self {
        let place = Self { directory: tempfile::tempdir().expect("a directory") };
        place.write("summary.json", r#"{ "complete": true, "name": "boom" }"#);
        place.write("scene.toml", "name = \"boom\" # one hinge, of 3 °\n");
        place.write("datapackage.json", &package().to_string());
        place.write("states.csv", "t [s],beta_1_1\n0,-0.0\n0.1,5e-324\n");
        place.write("events.csv", "t [s],event,appendage\n0.1,release,1\n0.25,end,\n");
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("writable");
    }
}

/// What `nboom run --units-in-headers` says of these tables.
fn package() -> Value {
    let field = |name: &str, kind: &str| json!({ "name": name, "type": kind, "description": "x" });
    let mut time = field("t [s]", "number");
    time["unit"] = "s".into();
    let mut angle = field("beta_1_1", "number");
    angle["body"] = "boom".into();
    let event = [time.clone(), field("event", "string"), field("appendage", "integer")];
    let states =
        json!({ "name": "states", "path": "states.csv", "schema": { "fields": [time, angle] } });
    let events = json!({ "name": "events", "path": "events.csv", "schema": { "fields": event } });
    json!({ "profile": "tabular-data-package", "resources": [states, events] })
}
