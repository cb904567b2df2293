//! The record of one tick of a run.

use std::fmt;

/// A tick that both sides stepped. Lists have one number a place.
#[derive(Clone, Copy, Debug)]
pub struct TickRecord<'a> {
    /// Tick, from 1.
    pub tick: u32,
    /// Displacements sent (m).
    pub displacements_m: &'a [f32],
    /// Forces of the target (N).
    pub target_forces_n: &'a [f32],
    /// Forces of the host (N).
    pub host_forces_n: &'a [f32],
    /// Status bits of the target.
    pub target_status: &'a [u16],
    /// Clock ticks of the target that the step of the whole bank took.
    pub clock_ticks: u32,
    /// From the step's request to its answer, repetitions and recoveries included (ns).
    pub round_trip_ns: u64,
    /// What happened besides.
    pub events: &'a [Event],
}

/// What can happen in a tick besides its step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Made on purpose: a frame was lost.
    Drop,
    /// Made on purpose: a frame had a wrong bit.
    Corrupt,
    /// Made on purpose: a frame came late.
    Delay,
    /// Made on purpose: a frame came twice.
    Duplicate,
    /// Made on purpose: a frame came after the one sent after it.
    Reorder,
    /// Made on purpose: the target was reset.
    Reset,
    /// The host sent a request again.
    Repeat,
    /// The host gave the target its dampers and states again.
    Recovery,
    /// A paced tick was answered after the next was due.
    Late,
    /// A force or status word differs from the host's.
    Mismatch,
}

impl Event {
    /// Whether it was made on purpose.
    pub fn is_made(self) -> bool {
        matches!(
            self,
            Self::Drop
                | Self::Corrupt
                | Self::Delay
                | Self::Duplicate
                | Self::Reorder
                | Self::Reset
        )
    }
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Drop => "drop",
            Self::Corrupt => "corrupt",
            Self::Delay => "delay",
            Self::Duplicate => "duplicate",
            Self::Reorder => "reorder",
            Self::Reset => "reset",
            Self::Repeat => "repeat",
            Self::Recovery => "recovery",
            Self::Late => "late",
            Self::Mismatch => "mismatch",
        })
    }
}
