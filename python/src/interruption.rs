//! Ctrl-C handling for work that has released the GIL.

use std::cell::RefCell;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// The exception that Python raised during the work.
#[derive(Default)]
pub struct Interruption(RefCell<Option<PyErr>>);

impl Interruption {
    /// Returns true if the work must be cancelled because one of Python's signal handlers raised an exception. The
    /// handlers run only in Python's main thread.
    pub fn is_requested(&self) -> bool {
        let mut raised = self.0.borrow_mut();
        if raised.is_none() {
            *raised = Python::attach(|py| py.check_signals()).err();
        }
        raised.is_some()
    }

    /// Returns the raised exception as an error.
    pub fn raised(self) -> PyResult<()> {
        self.0.into_inner().map_or(Ok(()), Err)
    }
}

/// Runs cancellable work in this thread.
pub fn run_cancellable<T>(work: impl FnOnce(&dyn Fn() -> bool) -> T) -> PyResult<T> {
    let interruption = Interruption::default();
    let result = work(&|| interruption.is_requested());
    interruption.raised()?;
    Ok(result)
}

/// Time between two checks while other threads work; too short for a person to notice.
const LOOK: Duration = Duration::from_millis(20);

/// Runs cancellable work with its own threads in another thread, because only Python's main thread can check
/// for an interruption.
pub fn run_in_thread<T: Send>(
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send,
) -> PyResult<T> {
    let (is_unwanted, interruption) = (AtomicBool::new(false), Interruption::default());
    let result = thread::scope(|scope| {
        let (done, is_done) = mpsc::channel::<()>();
        let worker = scope.spawn(|| {
            // When the work ends or panics, this is dropped and ends the loop below.
            let _done = done;
            work(&|| is_unwanted.load(Ordering::Relaxed))
        });
        while is_done.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
            if interruption.is_requested() {
                is_unwanted.store(true, Ordering::Relaxed);
            }
        }
        worker.join()
    });
    interruption.raised()?;
    result.map_err(|panic| resume_unwind(panic))
}
