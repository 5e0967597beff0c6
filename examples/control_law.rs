//! A control law at a sample rate: a motor opens a boom while jets hold the satellite's attitude.
//!
//! ```sh
//! cargo run --release --example control_law
//! ```
//!
//! Every 0.05 time units the law sees the motion and commands a torque about the hinge and a moment on
//! the main body, which are held until the next sample. The program ends with an error if the attitude
//! is lost, or if momentum and energy do not balance.

use std::error::Error;

use nboom::model::{
    Appendage, Hinge, HingeStart, HingeState, MassProperties, Mount, Scene, SceneDescription,
    Segment,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Commands, Control, Nobody, Options, Simulator, Snapshot};

/// The boom opens at this rate.
const RATE: f64 = 0.2;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = satellite();
    let mut tilt = 0.0_f64;
    let mut law = |seen: &Snapshot, commands: &mut Commands| {
        let error = seen.attitude.vector * 2.0;
        tilt = tilt.max(error.norm());
        // A motor that keeps the rate, until a latch holds the boom.
        commands.hinge_torques_mut()[0] = 8.0 * (RATE - seen.tau[0]);
        commands.main_body.moment = error * -40.0 - seen.omega_body * 60.0;
    };
    let control = Control { period: 0.05, law: &mut law };
    let mut simulator = Simulator::new(&scene, Options::default());
    let summary = simulator.run_controlled(control, &mut Nobody)?;

    let boom = summary.verdict.hinges[0];
    println!("the boom is {:?} since {:.6}", boom.state, boom.since.unwrap_or(0.0));
    println!("the satellite was tilted by {:.4} rad at most", tilt);
    println!("energy is accounted for to {:.0e}", summary.conservation.energy);
    if boom.state != HingeState::Locked || tilt > 0.1 {
        return Err(format!("{boom:?} and a tilt of {tilt} found").into());
    }
    match summary.conservation.poor(1e-9).next() {
        Some(poor) => Err(poor.to_string().into()),
        None => Ok(()),
    }
}

/// A hub with one boom, stowed along its side, that locks when it is straight.
fn satellite() -> Scene {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(60.0, 40.0, 50.0));
    let boom = MassProperties::new(5.0, Vec3::unit_y(), Sym3::diagonal(1.7, 0.1, 1.7));
    let start = HingeStart { angle: -3.0, rate: 0.0, state: HingeState::Free };
    let hinge = Hinge { start, lock_angle: Some(0.0), ..Hinge::free() };
    let mut description = SceneDescription::at_rest("motor", hub, 30.0);
    let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge }];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    Scene::new(description).expect("the bodies are physical")
}
