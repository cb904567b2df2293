//! Counts of faults injected into a link.

use serde::Serialize;

/// Faults made so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FaultCounts {
    /// Frames lost.
    pub dropped: u64,
    /// Frames with a wrong bit.
    pub corrupted: u64,
    /// Frames late.
    pub delayed: u64,
    /// Frames twice.
    pub duplicated: u64,
    /// Frames after the one sent after them.
    pub reordered: u64,
    /// Resets of the target.
    pub resets: u64,
}
