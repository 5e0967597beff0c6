//! Hinges, as columns and curves call them.

use nboom_model::{Body, HingeLabel};
use serde::Serialize;
use serde_json::Value;

use crate::Run;
use crate::table::Table;

/// A hinge of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hinge {
    /// Its appendage, from 1.
    pub appendage: usize,
    /// Its place in it, from 1.
    pub segment: usize,
    /// The end of its columns' names.
    pub key: String,
    /// The body on it, by name if it has one, else by the numbers of the hinge.
    pub label: String,
    /// Whether it slides; where there is no scene to say so, it turns.
    pub slides: bool,
    /// Whether its body is a wheel, without mass, which makes any number of turns.
    pub wheel: bool,
}

impl Hinge {
    fn new([appendage, segment]: [usize; 2], name: Option<&str>, slides: bool) -> Self {
        let label = name.map_or_else(|| format!("{appendage},{segment}"), str::to_owned);
        Self {
            appendage,
            segment,
            key: format!("{appendage}_{segment}"),
            label,
            slides,
            wheel: false,
        }
    }
}

impl From<&HingeLabel> for Hinge {
    fn from(label: &HingeLabel) -> Self {
        Self::new(label.numbers(), label.name.as_deref(), label.joint.slides())
    }
}

impl Run {
    /// Its hinges: by the scene, without it by the verdict, and without that by the columns of the motion.
    pub fn hinges(&self) -> Vec<Hinge> {
        if let Some(scene) = self.scene() {
            let with_wheel = |(label, body): (&HingeLabel, &Body)| {
                let wheel = !body.joint.slides() && body.mass_properties.is_wheel(body.axis);
                Hinge { wheel, ..Hinge::from(label) }
            };
            return scene.labels().iter().zip(&scene.bodies).map(with_wheel).collect();
        }
        let told = self.summary.as_ref().and_then(|keys| keys["verdict"]["hinges"].as_array());
        let told = told.and_then(|hinges| hinges.iter().map(of_verdict).collect());
        told.unwrap_or_else(|| {
            let columns = self.motion().map_or(&[][..], Table::names);
            columns.iter().filter_map(|name| of_column(name)).collect()
        })
    }
}

/// As summary.json has it.
fn of_verdict(hinge: &Value) -> Option<Hinge> {
    let number = |key: &str| usize::try_from(hinge[key].as_u64()?).ok();
    let numbers = [number("appendage")?, number("segment")?];
    Some(Hinge::new(numbers, hinge["name"].as_str(), false))
}

fn of_column(name: &str) -> Option<Hinge> {
    let (appendage, segment) = name.strip_prefix("beta_")?.split_once('_')?;
    Some(Hinge::new([appendage.parse().ok()?, segment.parse().ok()?], None, false))
}
