//! A deployment in code that was generated where it is used.
//!
//! ```sh
//! cargo run --release --manifest-path examples/macros/Cargo.toml
//! ```
//!
//! `scene!` compiles the deck beside `Cargo.toml` into the program, with routines for it and for each
//! state with held hinges that it comes through. `routine!` makes one for a topology. The
//! deployment is run in the scene's own code, then once more in library code; the program ends
//! with an error if any stage ran in other code than it should, or if a hinge locks at another
//! time.

use std::error::Error;
use std::io;

use nboom::scalar::Kernel;
use nboom::sim::{Event, EventKind, Options, Path, Recorder, Snapshot, Summary, simulate};

nboom::routine! {
    /// Any satellite with a boom of two segments and a paddle.
    BoomAndPaddle: S2_P, level = exact
}

const BOOMS: nboom::CompiledScene = nboom::scene!("booms.nml");

fn main() -> Result<(), Box<dyn Error>> {
    println!("{}: {} routines", BOOMS.name(), BOOMS.kernels().len());
    let own = Options { path: Path::Generated, kernels: BOOMS.kernels(), ..Options::default() };
    let (generated, summary) = run(&own)?;
    for event in &generated {
        println!("{:.9} {:8} hinge {}", event.time, event.kind.name(), event.hinge);
    }
    for stage in &summary.selections {
        println!("from {:.9}: {}, {}", stage.since, stage.path, stage.reason);
        if stage.path != "generated" {
            return Err(format!("generated code expected from {} on", stage.since).into());
        }
    }

    let (library, _) = run(&Options { path: Path::Generic, ..Options::default() })?;
    let same = |(a, b): (&Change, &Change)| {
        (a.kind, a.hinge) == (b.kind, b.hinge) && (a.time - b.time).abs() <= 1e-7 * b.time
    };
    if generated.len() != library.len() || !generated.iter().zip(&library).all(same) {
        return Err(format!("{generated:?} found, {library:?} expected").into());
    }
    println!("library code has the same events");

    let general = Kernel::of::<BoomAndPaddle>();
    let all_free = BOOMS.kernels().iter().find(|kernel| kernel.topology == general.topology);
    let baked = all_free.ok_or("a routine for all hinges free expected")?;
    println!(
        "{}: {} constants to prepare, {} with the deck's numbers built in",
        general.topology, general.constants, baked.constants
    );
    Ok(())
}

/// What the deck does: runs it and keeps releases and lock-ups.
fn run(options: &Options) -> Result<(Vec<Change>, Summary), Box<dyn Error>> {
    let mut changes = Changes(Vec::new());
    let summary = simulate(&BOOMS.scene()?, options, &mut changes)?;
    Ok((changes.0, summary))
}

/// A hinge that is released or locks.
#[derive(Debug)]
struct Change {
    time: f64,
    kind: EventKind,
    hinge: usize,
}

struct Changes(Vec<Change>);

impl Recorder for Changes {
    fn event(&mut self, event: &Event, _: &Snapshot) -> io::Result<()> {
        let &Event { time, kind, hinge, .. } = event;
        if let (EventKind::Release | EventKind::LockUp, Some(hinge)) = (kind, hinge) {
            self.0.push(Change { time, kind, hinge });
        }
        Ok(())
    }
}
