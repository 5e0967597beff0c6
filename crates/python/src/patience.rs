//! Whether somebody has pressed Ctrl-C in Python.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

use nboom_cli::Interrupt;
use pyo3::prelude::*;

/// Time between two looks, each of which waits for Python's lock.
const LOOK: Duration = Duration::from_millis(50);

/// Looks for signals now and then.
pub(crate) struct Patience {
    looked: Instant,
}

impl Patience {
    pub fn new() -> Self {
        Self { looked: Instant::now() }
    }

    /// Looks, if the last time is long enough ago; without Python's lock.
    ///
    /// # Errors
    /// What Python makes of a signal: `KeyboardInterrupt`.
    pub fn look(&mut self) -> PyResult<()> {
        if self.looked.elapsed() < LOOK {
            return Ok(());
        }
        self.looked = Instant::now();
        Python::attach(|py| py.check_signals())
    }
}

/// Time between two tries to get what another thread has.
const TRY: Duration = Duration::from_millis(1);

/// Waits until no other thread has it, and meanwhile looks for signals; without Python's lock.
///
/// # Errors
/// What Python makes of a signal.
pub(crate) fn wait<T>(mutex: &Mutex<T>) -> PyResult<MutexGuard<'_, T>> {
    let mut patience = Patience::new();
    loop {
        match mutex.try_lock() {
            Ok(found) => return Ok(found),
            Err(TryLockError::Poisoned(found)) => return Ok(found.into_inner()),
            Err(TryLockError::WouldBlock) => thread::sleep(TRY),
        }
        patience.look()?;
    }
}

/// The first signal that came, shared with what it shall end.
#[derive(Clone)]
pub(crate) struct Signals(Arc<Mutex<(Patience, Option<PyErr>)>>);

impl Signals {
    pub fn new() -> Self {
        Self(Arc::new(Mutex::new((Patience::new(), None))))
    }

    /// Whether a signal has come.
    pub fn came(&self) -> bool {
        let (patience, found) = &mut *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if found.is_none() {
            *found = patience.look().err();
        }
        found.is_some()
    }

    /// The same for commands.
    pub fn interrupt(&self) -> Interrupt {
        let signals = self.clone();
        Interrupt::when(move || signals.came())
    }

    /// What Python makes of the signal, if one came.
    pub fn taken(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).1.take()
    }
}
