//! The user's Ctrl-C, asked for by work that has released Python's lock.

use std::cell::RefCell;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// What Python raised while work was going on.
#[derive(Default)]
pub struct Interruption(RefCell<Option<PyErr>>);

impl Interruption {
    /// Whether the work is no longer wanted: Python's handlers of signals, which act in its main thread only, raised something.
    pub fn is_wanted(&self) -> bool {
        let mut raised = self.0.borrow_mut();
        if raised.is_none() {
            *raised = Python::attach(|py| py.check_signals()).err();
        }
        raised.is_some()
    }

    /// What was raised.
    pub fn raised(self) -> PyResult<()> {
        self.0.into_inner().map_or(Ok(()), Err)
    }
}

/// Does work that asks whether it is unwanted, in this thread.
pub fn asking<T>(work: impl FnOnce(&dyn Fn() -> bool) -> T) -> PyResult<T> {
    let interruption = Interruption::default();
    let result = work(&|| interruption.is_wanted());
    interruption.raised()?;
    Ok(result)
}

/// Time between two looks while other threads work: shorter than a person notices.
const LOOK: Duration = Duration::from_millis(20);

/// Does work whose threads are not Python's, and which asks whether it is unwanted, in a thread beside this one: only Python's main thread can
/// look for an interruption.
pub fn beside<T: Send>(work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send) -> PyResult<T> {
    let (is_unwanted, interruption) = (AtomicBool::new(false), Interruption::default());
    let result = thread::scope(|scope| {
        let (done, is_done) = mpsc::channel::<()>();
        let worker = scope.spawn(|| {
            // Dropped with the work done, or with its panic.
            let _done = done;
            work(&|| is_unwanted.load(Ordering::Relaxed))
        });
        while is_done.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
            if interruption.is_wanted() {
                is_unwanted.store(true, Ordering::Relaxed);
            }
        }
        worker.join()
    });
    interruption.raised()?;
    result.map_err(|panic| resume_unwind(panic))
}
