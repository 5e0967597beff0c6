//! Rotors, as curves call them, and their speeds.

use nboom_model::{Quantity, RotorSpeed};
use serde::Serialize;

use crate::Run;
use crate::table::Table;

/// A rotor of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rotor {
    /// The end of its columns' names: its number, from 1.
    pub key: String,
    /// Its number, and the body that carries it where there is a scene to say so.
    pub label: String,
}

impl Run {
    /// Its rotors: by the scene, without it by the columns that were asked for.
    pub fn rotors(&self) -> Vec<Rotor> {
        if let Some(scene) = self.scene() {
            let hinges = self.hinges();
            let rotors = scene.rotors.iter().enumerate().map(|(i, rotor)| {
                let body = rotor.body.map_or("main body", |body| hinges[body].label.as_str());
                Rotor { key: (i + 1).to_string(), label: format!("rotor {}, {body}", i + 1) }
            });
            return rotors.collect();
        }
        let mut keys: Vec<&str> = Vec::new();
        for name in self.requested().map_or(&[][..], Table::names) {
            let key = Quantity::OF_A_ROTOR
                .into_iter()
                .find_map(|quantity| name.strip_prefix(quantity.name())?.strip_prefix('_'));
            keys.extend(key.filter(|key| !keys.contains(key)));
        }
        let rotor = |key: &str| Rotor { key: key.to_owned(), label: format!("rotor {key}") };
        keys.into_iter().map(rotor).collect()
    }

    /// Speeds of rotors relative to their bodies, in columns like `rotor_speed_1`: as the run wrote them if somebody
    /// asked for those of all, else as the scene commands them.
    pub fn rotor_speeds(&self) -> Option<&Table> {
        self.rotor_speeds.as_ref().or(self.requested())
    }
}

/// The speeds that the scene commands, at the times of the motion and wherever a table over time has a corner; nothing
/// if the run wrote all of them.
pub(crate) fn commanded(run: &Run) -> Option<Table> {
    let (scene, motion) = (run.scene()?, run.motion()?);
    let names = run.rotors().into_iter().map(|rotor| column(&rotor.key));
    let names: Vec<String> = names.collect();
    let is_written =
        |name: &String| run.requested().is_some_and(|table| table.column(name).is_some());
    if names.iter().all(is_written) {
        return None;
    }
    let mut times = motion.times().to_vec();
    let (first, last) = (*times.first()?, *times.last()?);
    for rotor in &scene.rotors {
        if let RotorSpeed::Table(points) = &rotor.speed {
            let corners = points.iter().map(|[time, _]| *time);
            times.extend(corners.filter(|time| (first..last).contains(time)));
        }
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    let mut table = Table::new(["t".to_owned()].into_iter().chain(names).collect());
    for time in times {
        let speeds = scene.rotors.iter().map(|rotor| rotor.speed.at(time));
        table.push(&[time].into_iter().chain(speeds).collect::<Vec<_>>());
    }
    Some(table)
}

fn column(key: &str) -> String {
    format!("{}_{key}", Quantity::RotorSpeed.name())
}
