//! The time of both stacks.

use core::sync::atomic::{AtomicU32, Ordering};
use core::task::Waker;

use embassy_time_driver::{Driver, TICK_HZ};

/// Time since the start (us).
static NOW_US: AtomicU32 = AtomicU32::new(0);

/// Time of the earliest timer (us).
static NEXT_US: AtomicU32 = AtomicU32::new(u32::MAX);

/// The time of embassy.
struct Clock;

embassy_time_driver::time_driver_impl!(static CLOCK: Clock = Clock);

impl Driver for Clock {
    fn now(&self) -> u64 {
        u64::from(now_us()) * TICK_HZ / 1_000_000
    }

    fn schedule_wake(&self, at: u64, _: &Waker) {
        let at_us = at.saturating_mul(1_000_000).div_ceil(TICK_HZ);
        NEXT_US.fetch_min(at_us.try_into().unwrap_or(u32::MAX), Ordering::Relaxed);
    }
}

/// Time since the start (us).
pub fn now_us() -> u32 {
    NOW_US.load(Ordering::Relaxed)
}

/// Lets time pass (us). Returns true if a timer is due: then wake every task.
pub fn advance(by_us: u32) -> bool {
    let now = now_us() + by_us;
    NOW_US.store(now, Ordering::Relaxed);
    let due = NEXT_US.load(Ordering::Relaxed) <= now;
    if due {
        NEXT_US.store(u32::MAX, Ordering::Relaxed);
    }
    due
}
