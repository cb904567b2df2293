//! Clocks of a pacer.

/// A monotonic clock that can sleep until an absolute time.
pub trait Clock {
    /// Time since an arbitrary origin (ns).
    fn now_ns(&self) -> u64;
    /// Sleeps until `deadline_ns` or, depending on the scheduler of the system, slightly longer.
    fn sleep_until_ns(&self, deadline_ns: u64);
}

/// Monotonic clock of the system. It sleeps until an absolute deadline on Linux and for a duration on other systems.
#[derive(Debug, Clone, Copy)]
pub struct MonotonicClock {
    origin: std::time::Instant,
}

impl Default for MonotonicClock {
    fn default() -> Self {
        Self {
            origin: std::time::Instant::now(),
        }
    }
}

impl Clock for MonotonicClock {
    fn now_ns(&self) -> u64 {
        u64::try_from(self.origin.elapsed().as_nanos()).unwrap_or(u64::MAX)
    }

    #[cfg(target_os = "linux")]
    fn sleep_until_ns(&self, deadline_ns: u64) {
        use nix::errno::Errno;
        use nix::sys::time::TimeSpec;
        use nix::time::{ClockId, ClockNanosleepFlags, clock_gettime, clock_nanosleep};

        // The origin of `Instant` is private, so each deadline is converted to CLOCK_MONOTONIC.
        let Some(left) = deadline_ns.checked_sub(self.now_ns()) else {
            return;
        };
        let Ok(now) = clock_gettime(ClockId::CLOCK_MONOTONIC) else {
            return std::thread::sleep(std::time::Duration::from_nanos(left));
        };
        let deadline = now + TimeSpec::from(std::time::Duration::from_nanos(left));
        let absolute = ClockNanosleepFlags::TIMER_ABSTIME;
        while let Err(Errno::EINTR) = clock_nanosleep(ClockId::CLOCK_MONOTONIC, absolute, &deadline)
        {
        }
    }

    #[cfg(not(target_os = "linux"))]
    fn sleep_until_ns(&self, deadline_ns: u64) {
        while let Some(left) = deadline_ns
            .checked_sub(self.now_ns())
            .filter(|left| *left > 0)
        {
            std::thread::sleep(std::time::Duration::from_nanos(left));
        }
    }
}

/// Measures the cost of two consecutive clock readings (ns), as the median of ten thousand measurements. Every span
/// measured with the clock includes this cost.
pub fn overhead_ns(clock: &impl Clock) -> u64 {
    let mut spans: Vec<u64> = (0..10_000)
        .map(|_| {
            let before = clock.now_ns();
            clock.now_ns() - before
        })
        .collect();
    spans.sort_unstable();
    spans[spans.len() / 2]
}
