//! A program of which nothing is optimised, nboom included, as `cargo run` builds it at first: every method brings a
//! stiff hinge to its end on the stack of a thread.

use std::error::Error;
use std::thread;

use nboom::io::words::{body, damper, hinge, main_body, scene, spring};
use nboom::model::Scene;
use nboom::sim::{Method, Nobody, Options, Path, simulate};

fn main() -> Result<(), Box<dyn Error>> {
    for method in Method::ALL {
        // A thread has two megabytes unless it asks for more.
        let run = thread::Builder::new().name(method.name().to_owned()).spawn(move || run(method));
        let steps = run?.join().expect("nothing panics")?;
        println!("{}: {steps} steps", method.name());
    }
    Ok(())
}

fn run(method: Method) -> Result<usize, String> {
    let scene = stiff_booms(if takes_short_steps(method) { 0.01 } else { 20.0 });
    let options = Options { integrator: method, path: Path::Generic, ..Options::default() };
    let summary = simulate(&scene, &options, &mut Nobody).map_err(|error| error.to_string())?;
    Ok(summary.steps_accepted)
}

/// Whether stability keeps the steps of a method short.
fn takes_short_steps(method: Method) -> bool {
    use Method::{Auto, Radau5, Radau9, Radau13};
    !matches!(method, Auto | Radau5 | Radau9 | Radau13)
}

fn stiff_booms(end: f64) -> Scene {
    let boom = |name: &str| {
        let hinge = hinge()
            .at([0.0, 1.0, 0.0])
            .axis("x")
            .start_deg(60.0)
            .spring(spring(1.0))
            .damper(damper(1e6));
        body(name)
            .mass(3.0)
            .mass_centre([0.0, 0.5, 0.0])
            .inertia([0.3, 0.05, 0.3])
            .hinge(hinge)
    };
    scene("stiff-booms")
        .end(end)
        .main_body(main_body().mass(50.0).inertia([20.0, 15.0, 25.0]))
        .body(boom("inner"))
        .body(boom("outer").on("inner"))
        .build()
        .expect("a scene that can be simulated")
}
