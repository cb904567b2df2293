//! Record of one tick of a run.

use std::fmt;

/// A tick that both target and host have stepped. Lists of values have one entry per slot.
#[derive(Clone, Copy, Debug)]
pub struct TickRecord<'a> {
    /// Tick, from 1.
    pub tick: u32,
    /// Displacements sent to the target (m).
    pub displacements_m: &'a [f32],
    /// Forces of the target (N).
    pub target_forces_n: &'a [f32],
    /// Forces of the host (N).
    pub host_forces_n: &'a [f32],
    /// Status bits of the target.
    pub target_status: &'a [u16],
    /// Clock ticks of the target for the step of the whole bank.
    pub clock_ticks: u32,
    /// Time from the request to its answer, including repetitions and recoveries (ns).
    pub round_trip_ns: u64,
    /// Other events during the tick.
    pub events: &'a [Event],
}

/// Events that can happen during a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Injected: a frame was lost.
    Drop,
    /// Injected: a bit of a frame was flipped.
    Corrupt,
    /// Injected: a frame arrived late.
    Delay,
    /// Injected: a frame arrived twice.
    Duplicate,
    /// Injected: a frame arrived after the next frame.
    Reorder,
    /// Injected: the target was reset.
    Reset,
    /// The host sent a request again.
    Repeat,
    /// The host sent the dampers and states to the target again.
    Recovery,
    /// A paced tick was answered after the next tick was due.
    Late,
    /// A force or status word of the target differs from that of the host.
    Mismatch,
}

impl Event {
    /// True if the event is an injected fault.
    pub fn is_injected(self) -> bool {
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
