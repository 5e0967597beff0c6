//! Runs that are asked to end where they are, and what is refused before a first step.

use std::cell::Cell;
use std::io;

use nboom::formulation::Formulation;
use nboom::sim::{
    Form, Options, Path, Recorder, Reference, SimError, Snapshot, Witness, check_start, simulate,
    trust,
};

use crate::collect::tight;
use crate::rotors::{free, oscillating, scene};

/// Asks for the end after so many questions, and notes what it was told.
struct Impatient {
    patience: Cell<usize>,
    times: Vec<f64>,
}

impl Impatient {
    fn asking_after(patience: usize) -> Self {
        Self { patience: Cell::new(patience), times: Vec::new() }
    }
}

impl Recorder for Impatient {
    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.times.push(snapshot.time);
        Ok(())
    }

    fn interrupted(&self) -> bool {
        self.patience.set(self.patience.get().saturating_sub(1));
        self.patience.get() == 0
    }
}

/// Asked at every step and every output time, so also within a step with very many.
#[test]
fn a_run_ends_where_it_is_asked_to() {
    // Force-free: a few long steps, with a million output times.
    let still = scene(&[free(0.0, 1.0)], 1.0);
    let mut recorder = Impatient::asking_after(1000);
    let failure = simulate(&still, &tight(1_000_000), &mut recorder).expect_err("interrupted");
    let SimError::Interrupted { time } = failure.error else { panic!("{failure}") };
    assert!((900..1000).contains(&recorder.times.len()), "{}", recorder.times.len());
    let last = *recorder.times.last().expect("some");
    assert!(last <= time && time <= last + 1.5e-6, "{last} {time}");

    // Many steps and few output times.
    let busy = scene(&[oscillating(free(0.0, 1.0), 50.0, 0.0)], 9.0);
    let mut recorder = Impatient::asking_after(100);
    let failure = simulate(&busy, &tight(1), &mut recorder).expect_err("interrupted");
    let SimError::Interrupted { time } = failure.error else { panic!("{failure}") };
    assert!(failure.summary.steps_accepted < 100);
    assert_eq!(failure.summary.end_time, time);
    assert!(time > 0.0 && time < 9.0, "{time}");
    assert_eq!(failure.to_string(), format!("interrupted at time {time}"));
}

#[test]
fn reference_runs_are_asked_too() {
    let busy = scene(&[oscillating(free(0.0, 1.0), 50.0, 0.0)], 9.0);
    let mut witness = Witness::new();
    simulate(&busy, &tight(1), &mut witness).expect("it runs");
    for reference in Reference::ALL {
        // Early, and for double-double also when the run that guides it is over.
        for patience in [1, 100, 3000] {
            let mut beside = Impatient::asking_after(patience);
            match trust(&busy, &tight(1), &witness, reference, &mut beside) {
                Err(failure) => assert!(
                    matches!(failure.error, SimError::Interrupted { .. }),
                    "{}: {failure}",
                    reference.name()
                ),
                // It needs fewer steps than that.
                Ok(_) => {
                    let left = beside.patience.get();
                    assert!(left > 0 && patience == 3000, "{}", reference.name());
                }
            }
        }
    }
}

#[test]
fn what_no_run_can_begin_with_is_refused_beforehand() {
    let scene = scene(&[free(0.0, 1.0)], 1.0);
    let defaults = Options::default();
    assert!(check_start(&scene, &defaults).is_ok());
    let refused = check_start(&scene, &Options { rtol: 2.0, ..defaults });
    assert!(matches!(refused, Err(SimError::Option(_))), "{refused:?}");
    let formulation = Some(Form::Closed(Formulation::Report));
    let generated = Options { path: Path::Generated, formulation, ..defaults };
    let refused = check_start(&scene, &generated);
    assert!(matches!(refused, Err(SimError::NoRoutine { .. })), "{refused:?}");
}
