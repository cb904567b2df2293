//! Tasks that run only when they are woken, as under an executor.

use core::future::Future;
use core::pin::Pin;
use core::sync::atomic::{AtomicBool, Ordering};
use core::task::{Context, RawWaker, RawWakerVTable, Waker};

/// Whether a task is woken.
#[derive(Debug)]
pub struct Woken(AtomicBool);

static FUNCTIONS: RawWakerVTable = RawWakerVTable::new(clone, wake, wake, |_| ());

fn clone(woken: *const ()) -> RawWaker {
    RawWaker::new(woken, &FUNCTIONS)
}

fn wake(woken: *const ()) {
    // SAFETY: `Woken::run` made the pointer from a static reference.
    unsafe { &*woken.cast::<Woken>() }.wake();
}

impl Woken {
    /// Woken for the first time.
    pub const fn new() -> Self {
        Self(AtomicBool::new(true))
    }

    /// Wakes the task.
    pub fn wake(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Runs the task if it is woken. Returns true if it ran.
    pub fn run(&'static self, task: Pin<&mut dyn Future<Output = ()>>) -> bool {
        let is_woken = self.0.swap(false, Ordering::Relaxed);
        if is_woken {
            // SAFETY: the functions take a `Woken`, and this one is static.
            let waker = unsafe { Waker::from_raw(clone((&raw const *self).cast())) };
            // No task of ours ends.
            let _ = task.poll(&mut Context::from_waker(&waker));
        }
        is_woken
    }
}

impl Default for Woken {
    fn default() -> Self {
        Self::new()
    }
}

/// Runs tasks until none is woken. Returns true if any ran.
pub fn run_woken(tasks: &mut [(&'static Woken, Pin<&mut dyn Future<Output = ()>>)]) -> bool {
    let mut any = false;
    loop {
        let mut ran = false;
        for (woken, task) in &mut *tasks {
            ran |= woken.run(task.as_mut());
        }
        if !ran {
            return any;
        }
        any = true;
    }
}
