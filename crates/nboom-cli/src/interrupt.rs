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
    /// Held by work that must not be broken off; where unfinished results are.
    shield: Arc<Mutex<Option<PathBuf>>>,
}

/// Makes an [`Interrupt`] when the work begins.
pub type Interrupts<'a> = &'a dyn Fn() -> Result<Interrupt, CliError>;

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
        *held = Some(unfinished(&made).to_owned());
        Ok(made)
    }

    /// Says that no unfinished results are left.
    pub(crate) fn leaves_nothing(&self) {
        *self.shield.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }

    /// Runs work that must not be broken off.
    pub(crate) fn shielded<T>(&self, work: impl FnOnce() -> T) -> T {
        let _held = self.shield.lock().unwrap_or_else(PoisonError::into_inner);
        work()
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
fn insist(came: &AtomicBool, shield: &Weak<Mutex<Option<PathBuf>>>) {
    while !came.load(Ordering::Relaxed) {
        thread::sleep(LOOK);
    }
    thread::sleep(PATIENCE);
    let Some(shield) = shield.upgrade() else { return };
    let held = shield.lock().unwrap_or_else(PoisonError::into_inner);
    let error = CliError::WithinStep { directory: held.clone() };
    error.lines().iter().for_each(|line| say("error", line));
    process::exit(error.exit_code().into());
}
