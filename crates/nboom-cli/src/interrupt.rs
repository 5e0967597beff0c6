use std::fmt;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::thread;
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::{CliError, say};

/// Interval at which the program checks for a signal.
const LOOK: Duration = Duration::from_millis(100);

/// Time in which a run may end in order; a step of a thousand hinges may take longer.
const PATIENCE: Duration = Duration::from_millis(700);

/// Whether the user or the system has asked for an end, of the command by Ctrl-C or SIGTERM.
#[derive(Clone)]
pub struct Interrupt {
    came: Arc<dyn Fn() -> bool + Send + Sync>,
    /// Held by work that must not be broken off; what the command leaves if it is broken off.
    shield: Arc<Mutex<Left>>,
}

impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Interrupt").field("shield", &self.shield).finish_non_exhaustive()
    }
}

/// The results that a command leaves which is broken off.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Left {
    /// None.
    #[default]
    Nothing,
    /// Those of a run that goes on, in this directory.
    Unfinished(PathBuf),
    /// Those of a run that has stopped before its end, in this directory.
    Incomplete(PathBuf),
    /// Those of a whole run, in this directory.
    Complete(PathBuf),
}

/// Makes an [`Interrupt`] when the work begins.
pub type Interrupts<'a> = &'a dyn Fn() -> Result<Interrupt, CliError>;

impl fmt::Display for Left {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let incomplete = |f: &mut fmt::Formatter<'_>, when: &str, directory: &Path| {
            let directory = directory.display();
            write!(f, "{when}; what was computed before is in {directory}, marked incomplete")
        };
        match self {
            Self::Nothing => write!(f, "within a step; there are no unfinished results"),
            Self::Unfinished(directory) => incomplete(f, "within a step", directory),
            Self::Incomplete(directory) => {
                incomplete(f, "while more was made of the results", directory)
            }
            Self::Complete(directory) => write!(
                f,
                "while more was made of the results; the run itself is complete, its results are in {}",
                directory.display()
            ),
        }
    }
}

impl Interrupt {
    /// An interrupt that comes when the program around the command says so. It is asked at each step of a
    /// run.
    pub fn when(came: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self { came: Arc::new(came), shield: Arc::default() }
    }

    /// From now on the first such signal is only noted. The program ends if it does not react
    /// within a second; the second signal ends it at once.
    pub(crate) fn watch() -> Result<Self, CliError> {
        let came = noted()?;
        let interrupt = Self::at(came.clone());
        let shield = Arc::downgrade(&interrupt.shield);
        thread::spawn(move || insist(&came, &shield));
        Ok(interrupt)
    }

    /// As [`watch`](Self::watch), but the program may take its time to react.
    pub(crate) fn patient() -> Result<Self, CliError> {
        noted().map(Self::at)
    }

    fn at(came: Arc<AtomicBool>) -> Self {
        Self::when(move || came.load(Ordering::Relaxed))
    }

    pub(crate) fn came(&self) -> bool {
        (self.came)()
    }

    /// Makes what unfinished results go into. An end that is asked for meanwhile waits, and then says where they
    /// are.
    pub(crate) fn making<T, E>(
        &self,
        make: impl FnOnce() -> Result<T, E>,
        unfinished: impl FnOnce(&T) -> &Path,
    ) -> Result<T, E> {
        let mut held = self.shield.lock().unwrap_or_else(PoisonError::into_inner);
        let made = make()?;
        *held = Left::Unfinished(unfinished(&made).to_owned());
        Ok(made)
    }

    /// Finishes results by work that must not be broken off; `left` says what is there then.
    pub(crate) fn finishing<T>(
        &self,
        finish: impl FnOnce() -> T,
        left: impl FnOnce(&T) -> Left,
    ) -> T {
        let mut held = self.shield.lock().unwrap_or_else(PoisonError::into_inner);
        let finished = finish();
        *held = left(&finished);
        finished
    }
}

/// Notes the first signal; the second ends the program.
fn noted() -> Result<Arc<AtomicBool>, CliError> {
    let came = Arc::<AtomicBool>::default();
    for signal in [SIGINT, SIGTERM] {
        // The order matters: the first signal must find that none has come.
        flag::register_conditional_default(signal, came.clone())
            .and_then(|_| flag::register(signal, came.clone()))
            .map_err(CliError::Signals)?;
    }
    Ok(came)
}

/// Ends the program a while after a signal has come, unless the run is over by then.
fn insist(came: &AtomicBool, shield: &Weak<Mutex<Left>>) {
    while !came.load(Ordering::Relaxed) {
        thread::sleep(LOOK);
    }
    thread::sleep(PATIENCE);
    let Some(shield) = shield.upgrade() else { return };
    let held = shield.lock().unwrap_or_else(PoisonError::into_inner);
    let error = CliError::BrokenOff { left: held.clone() };
    error.lines().iter().for_each(|line| say("error", line));
    process::exit(error.exit_code().into());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_broken_off_says_what_it_leaves() {
        let interrupt = Interrupt::when(|| false);
        let told = || {
            let left = interrupt.shield.lock().expect("nobody panics").clone();
            CliError::BrokenOff { left }.lines().join("\n")
        };
        assert_eq!(told(), "interrupted within a step; there are no unfinished results");
        let make = || Ok::<_, ()>(PathBuf::from("a.partial"));
        assert!(interrupt.making(make, PathBuf::as_path).is_ok());
        assert_eq!(
            told(),
            "interrupted within a step; what was computed before is in a.partial, marked incomplete"
        );
        for (left, expected) in [
            (Left::Incomplete("a".into()), "what was computed before is in a, marked incomplete"),
            (Left::Complete("a".into()), "the run itself is complete, its results are in a"),
        ] {
            interrupt.finishing(|| (), |()| left);
            assert_eq!(
                told(),
                format!("interrupted while more was made of the results; {expected}")
            );
        }
    }
}
