//! Real-time options of a thread.

use std::fmt;

use serde::Serialize;

/// Real-time properties of the thread that steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct RealtimeOptions {
    /// Priority under SCHED_FIFO, 1 to 99.
    pub fifo_priority: Option<u8>,
    /// All memory locked, present and future: no page fault.
    pub lock_memory: bool,
    /// Core the thread is pinned to.
    pub core: Option<usize>,
}

/// One of [`RealtimeOptions`], with its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RealtimeOption {
    /// Priority under SCHED_FIFO.
    FifoPriority(u8),
    /// All memory locked.
    LockMemory,
    /// Core the thread is pinned to.
    Core(usize),
}

impl fmt::Display for RealtimeOption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FifoPriority(priority) => write!(f, "SCHED_FIFO priority {priority}"),
            Self::LockMemory => f.write_str("locked memory"),
            Self::Core(core) => write!(f, "core {core}"),
        }
    }
}
