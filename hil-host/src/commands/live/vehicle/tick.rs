//! A tick on its way from the real-time thread to the thread that makes frames.

use dashpot_vehicle_run::{Run, TickRecord};

/// Ticks that the thread that makes frames may fall behind: 2 s at 1 ms, about 20 MB for a locomotive.
const RECORDS: usize = 2048;

/// A tick.
#[derive(Debug, Clone)]
pub(super) struct Tick {
    /// Number of the run, from 1; another one after each start.
    pub epoch: u32,
    /// 0, or 1 for the vehicle as new beside it, whose tick comes before that of the vehicle.
    pub run: u32,
    /// Number of the comparison with the vehicle as new, from 1; 0 without.
    pub comparison: u32,
    /// Ticks since the start.
    pub ticks: u64,
    /// Time that the tick took, ns.
    pub work_ns: u64,
    /// Flags of the frame, see [`dashpot_live::flags`].
    pub flags: u32,
    /// State of the vehicle.
    pub record: TickRecord,
}

impl Tick {
    /// Takes the state of a run; `epoch` are the numbers of the run and of the comparison.
    pub fn put(&mut self, epoch: (u32, u32), number: u32, run: &Run, work_ns: u64, flags: u32) {
        (self.epoch, self.comparison) = epoch;
        self.run = number;
        self.ticks = run.state().ticks();
        self.work_ns = work_ns;
        self.flags = flags;
        self.record.copy(run.time_s(), run.state());
    }
}

/// Room for ticks of this run.
pub(super) fn room(run: &Run) -> Vec<Tick> {
    let tick = Tick {
        epoch: 0,
        run: 0,
        comparison: 0,
        ticks: 0,
        work_ns: 0,
        flags: 0,
        record: TickRecord::new(run.time_s(), run.state()),
    };
    vec![tick; RECORDS]
}
