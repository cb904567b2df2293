//! Ticks that a timer interrupt counts and the server runs.

use core::future::poll_fn;
use core::sync::atomic::{AtomicU32, Ordering};
use core::task::Poll;

use atomic_waker::AtomicWaker;

/// Number of ticks that are due but not yet run.
///
/// ```
/// use dashpot_device::Ticks;
///
/// static TICKS: Ticks = Ticks::new();
/// TICKS.count(); // in the timer interrupt
/// TICKS.count();
/// assert_eq!((TICKS.take(), TICKS.take()), (2, 0));
/// ```
#[derive(Debug, Default)]
pub struct Ticks {
    due: AtomicU32,
    waker: AtomicWaker,
}

impl Ticks {
    /// No tick is due.
    pub const fn new() -> Self {
        Self {
            due: AtomicU32::new(0),
            waker: AtomicWaker::new(),
        }
    }

    /// Counts a tick and wakes the server. Call it in the timer interrupt, once in each step of the dampers.
    pub fn count(&self) {
        self.due.fetch_add(1, Ordering::Relaxed);
        self.waker.wake();
    }

    /// Takes all ticks that are due.
    pub fn take(&self) -> u32 {
        self.due.swap(0, Ordering::Relaxed)
    }

    /// Waits until at least one tick is due and takes all of them. Only one task may wait.
    pub async fn wait(&self) -> u32 {
        poll_fn(|context| {
            self.waker.register(context.waker());
            match self.take() {
                0 => Poll::Pending,
                due => Poll::Ready(due),
            }
        })
        .await
    }
}
