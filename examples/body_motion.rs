//! Position, velocity and momentum of every body, about any point.
//!
//! ```sh
//! cargo run --release --example body_motion
//! ```
//!
//! Two booms unfold from a spinning hub. At each output time the program shows where the spin is: the
//! share of each body in the angular momentum about a fixed point. It ends with an error if the shares
//! do not sum up to a constant.

use std::error::Error;
use std::io;

use nboom::model::{
    Appendage, Hinge, HingeStart, HingeState, MassProperties, Mount, Scene, SceneDescription,
    Segment, Spring,
};
use nboom::scalar::{Mat3, Sym3, Vec3};
use nboom::sim::{Options, Recorder, Snapshot, simulate};

/// Looks at the bodies of a scene about a fixed point.
struct Shares {
    scene: Scene,
    point: Vec3<f64>,
    sums: Vec<f64>,
}

impl Recorder for Shares {
    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let bodies = snapshot.bodies(&self.scene);
        let about = |body: &nboom::sim::BodyMotion| body.angular_momentum_about(self.point).z;
        let shares: Vec<f64> = bodies.iter().map(about).collect();
        let tip_speed = bodies[1].velocity_inertial.norm();
        let sum = shares.iter().sum();
        println!("{:5.1} {shares:9.4?} sum {sum:.9}, first boom at {tip_speed:.4}", snapshot.time);
        self.sums.push(sum);
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let scene = satellite();
    let mut shares =
        Shares { scene: scene.clone(), point: Vec3::new(3.0, -1.0, 0.0), sums: Vec::new() };
    simulate(&scene, &Options { samples: 10, ..Options::default() }, &mut shares)?;
    let first = shares.sums[0];
    match shares.sums.iter().find(|&&sum| (sum - first).abs() > 1e-7 * first.abs()) {
        Some(sum) => Err(format!("a sum of {sum} found, {first} expected").into()),
        None => Ok(()),
    }
}

/// A hub in a spin with a boom on each side, on springs.
fn satellite() -> Scene {
    let hub = MassProperties::new(50.0, Vec3::zero(), Sym3::diagonal(15.0, 20.0, 25.0));
    let boom = MassProperties::new(4.0, Vec3::unit_y(), Sym3::diagonal(1.4, 0.1, 1.4));
    let start = HingeStart { angle: 1.5, rate: 0.0, state: HingeState::Free };
    let spring = Spring { quadratic: 0.0, linear: -6.0, preload_angle: 0.0 };
    let hinge = Hinge { start, spring, lock_angle: Some(0.0), ..Hinge::free() };
    let mut description = SceneDescription::at_rest("two booms", hub, 5.0);
    for side in [1.0, -1.0] {
        // Axes turned by half a revolution about x on the other side.
        let (y, z) = (Vec3::unit_y() * side, Vec3::unit_z() * side);
        let rot_inboard_from_hinge = Mat3::from_rows(Vec3::unit_x(), y, z);
        let mount = Mount { point: Vec3::unit_y() * side, rot_inboard_from_hinge };
        let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge }];
        description.attach(&Appendage::Regular { mount, segments });
    }
    description.initial.omega_body = Vec3::new(0.0, 0.0, 0.5);
    Scene::new(description).expect("the bodies are physical")
}
