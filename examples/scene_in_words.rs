//! A scene in the words of a program: two wings that unfold panel by panel, the scene of `wing.toml`.
//!
//! ```sh
//! cargo run --release --example scene_in_words
//! ```
//!
//! The words are the keys of the file, so loops and functions can write what a file repeats. The program
//! ends with an error if a panel does not lock, or if the scene is not that of the file.

use std::error::Error;
use std::path::Path;

use nboom::io::read_scene;
use nboom::io::words::{BodyWords, at, body, damper, hinge, main_body, scene, spring, when};
use nboom::model::{BodyShape, HingeState, Scene, Solid};
use nboom::sim::{Nobody, Options, simulate};

/// Of a panel, along the wing and across it.
const LONG: f64 = 1.0;
const WIDE: f64 = 1.5;

fn main() -> Result<(), Box<dyn Error>> {
    let satellite = satellite()?;
    let summary = simulate(&satellite, &Options::default(), &mut Nobody)?;
    for (i, hinge) in summary.verdict.hinges.iter().enumerate() {
        let name = satellite.name_of(i).unwrap_or_default();
        println!("{name}: {:?} since {:.4}", hinge.state, hinge.since.unwrap_or(0.0));
        if hinge.state != HingeState::Locked {
            return Err(format!("{name} {:?} found, locked expected", hinge.state).into());
        }
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/wing.toml");
    if satellite != read_scene(&file)?.scene {
        return Err("another scene than that of wing.toml found".into());
    }
    Ok(())
}

/// A bus with two wings of three panels, drawn deployed and stowed beside the bus.
fn satellite() -> Result<Scene, Box<dyn Error>> {
    let shape = BodyShape::around([0.0; 3], Solid::Box([1.6, 1.0, 1.2].into()));
    let bus = main_body().mass(150.0).inertia([30.0, 28.0, 32.0]).shape(shape);
    let root = hinge()
        .at([0.0, 0.6, -0.5])
        .axis("x")
        .start_deg(90.0)
        .release(at(1.0))
        .latch_deg(0.0)
        .spring(spring(0.3).rest_deg(-30.0))
        .damper(damper(0.25));
    let mut wing = scene("wing")
        .end(30.0)
        .main_body(bus)
        .body(panel("inner panel").hinge(root).repeat(2, "z"));
    // Folded like an accordion: each panel back on the one before.
    let outer = [("middle panel", "inner panel", -1.0), ("outer panel", "middle panel", 1.0)];
    for (name, inboard, side) in outer {
        let passes = if side < 0.0 { 45.0 } else { -90.0 };
        let fold = hinge()
            .at([0.0, LONG, 0.0])
            .axis("x")
            .start_deg(180.0 * side)
            .release(when(inboard).passes_deg(passes))
            .latch_deg(0.0)
            .spring(spring(0.2).rest_deg(-30.0 * side))
            .damper(damper(0.2));
        wing = wing.body(panel(name).on(inboard).hinge(fold));
    }
    Ok(wing.build()?)
}

/// A thin plate that stands off its hinge along y.
fn panel(name: &str) -> BodyWords {
    let mass = 2.5;
    body(name)
        .mass(mass)
        .mass_centre([0.0, LONG / 2.0, 0.0])
        .inertia([
            mass * LONG * LONG / 12.0,
            mass * WIDE * WIDE / 12.0,
            mass * (LONG * LONG + WIDE * WIDE) / 12.0,
        ])
        .tip([0.0, LONG, 0.0])
        .shape(BodyShape::around([0.0, LONG / 2.0, 0.0], Solid::Panel([WIDE, LONG, 0.0].into())))
}
