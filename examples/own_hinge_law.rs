//! A hinge law of the program's own: a tape spring, which is limp while it is folded and snaps straight.
//!
//! ```sh
//! cargo run --release --example own_hinge_law
//! ```
//!
//! The law is a closure of angle and rate. Its work is in the balance of energy, with which the program
//! ends in an error if it is off.

use std::error::Error;

use nboom::model::{
    Appendage, Hinge, HingeStart, HingeState, MassProperties, Mount, Scene, SceneDescription,
    Segment,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Nobody, Options, OwnLaw, Simulator};

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::default();
    for (name, damping) in [("without damping", 0.0), ("with damping", 0.3)] {
        let tape_spring = OwnLaw::new(0, move |beta: f64, tau: f64| {
            // A constant torque while folded, a high peak near the straight state, and none in it.
            let folded = -0.4 * (20.0 * beta).tanh();
            let snap = -60.0 * beta * (-(beta / 0.05).powi(2)).exp();
            folded + snap - damping * tau
        });
        let mut simulator = Simulator::under_laws(&satellite(), options, vec![tape_spring]);
        let summary = simulator.run(&mut Nobody)?;
        let hinge = summary.verdict.hinges[0];
        println!(
            "{name}: at {:.4} rad in the end, energy accounted for to {:.0e}",
            hinge.angle, summary.conservation.energy
        );
        if let Some(poor) = summary.conservation.poor(options.rtol).next() {
            return Err(poor.to_string().into());
        }
        if hinge.angle.abs() > 1.6 {
            return Err(
                format!("an angle of {} found, one within its fold expected", hinge.angle).into()
            );
        }
    }
    Ok(())
}

/// A hub in a slow spin with a panel, folded by a right angle.
fn satellite() -> Scene {
    let hub = MassProperties::new(50.0, Vec3::zero(), Sym3::diagonal(20.0, 15.0, 25.0));
    let panel = MassProperties::new(3.0, Vec3::unit_y() * 0.5, Sym3::diagonal(0.3, 0.05, 0.3));
    let start = HingeStart { angle: 1.55, rate: 0.0, state: HingeState::Free };
    let hinge = Hinge { start, ..Hinge::free() };
    let mut description = SceneDescription::at_rest("tape spring", hub, 20.0);
    let segments = vec![Segment { length: 1.0, mass_properties: panel, hinge }];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    description.initial.omega_body = Vec3::new(0.0, 0.0, 0.02);
    Scene::new(description).expect("the bodies are physical")
}
