//! Real-time options of a thread.

use std::fmt;

use serde::Serialize;

/// Real-time options of the thread that steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct RealtimeOptions {
    /// Priority under SCHED_FIFO, 1 to 99.
    pub fifo_priority: Option<u8>,
    /// If true, locks all present and future memory, which prevents page faults.
    pub lock_memory: bool,
    /// Core to which the thread is pinned.
    pub core: Option<usize>,
    /// If true, keeps the processors out of sleep states from which they wake slowly, until the process ends.
    pub no_deep_sleep: bool,
}

/// One of the [`RealtimeOptions`] with its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RealtimeOption {
    /// Priority under SCHED_FIFO.
    FifoPriority(u8),
    /// Locked memory.
    LockMemory,
    /// Core to which the thread is pinned.
    Core(usize),
    /// No deep sleep states.
    NoDeepSleep,
}

impl fmt::Display for RealtimeOption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FifoPriority(priority) => write!(f, "SCHED_FIFO priority {priority}"),
            Self::LockMemory => f.write_str("locked memory"),
            Self::Core(core) => write!(f, "core {core}"),
            Self::NoDeepSleep => f.write_str("no deep sleep"),
        }
    }
}
