//! A tick on its way from the real-time thread to the thread that makes frames.

use dashpot_vehicle_run::{Run, TickRecord};

/// Ticks that the thread that makes frames may fall behind: 2 s at 1 ms, about 20 MB for a locomotive.
const RECORDS: usize = 2048;

/// A tick.
#[derive(Debug, Clone)]
pub(super) struct Tick {
    /// Number of the run, from 1; another one after each start.
    pub epoch: u32,
    /// Ticks since the start.
    pub ticks: u64,
    /// Time that the tick took, ns.
    pub work_ns: u64,
    /// Flags of the frame, see [`dashpot_live::flags`].
    pub flags: u32,
    /// State of the vehicle.
    pub record: TickRecord,
}

/// Room for ticks of this run.
pub(super) fn room(run: &Run) -> Vec<Tick> {
    let tick = Tick {
        epoch: 0,
        ticks: 0,
        work_ns: 0,
        flags: 0,
        record: TickRecord::new(run.time_s(), run.state()),
    };
    vec![tick; RECORDS]
}
