//! Numbers of injected faults.

use serde::Serialize;

/// Numbers of faults injected so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FaultCounts {
    /// Lost frames.
    pub dropped: u64,
    /// Frames with a flipped bit.
    pub corrupted: u64,
    /// Late frames.
    pub delayed: u64,
    /// Frames delivered twice.
    pub duplicated: u64,
    /// Frames delivered after the next frame.
    pub reordered: u64,
    /// Resets of the target.
    pub resets: u64,
}
