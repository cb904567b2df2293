//! Pace of a run: free or real time.

use dashpot_realtime::pacing::{Clock, FinishedTick, MonotonicClock, Pacer, TickTiming};

/// Pace at which the ticks of a run are sent.
pub enum Pace<C: Clock = MonotonicClock> {
    /// Each tick is sent as soon as the previous one is answered; the clock measures round trips.
    Free(C),
    /// Each tick is sent one step after the previous one, as on a rig.
    Paced(Box<Pacer<C>>),
}

impl Default for Pace {
    fn default() -> Self {
        Self::Free(MonotonicClock::default())
    }
}

impl<C: Clock> Pace<C> {
    /// Returns the pacer if the ticks are paced.
    pub fn pacer(&self) -> Option<&Pacer<C>> {
        match self {
            Self::Free(_) => None,
            Self::Paced(pacer) => Some(pacer),
        }
    }

    /// Waits until it is time to send `tick`.
    pub(super) fn begin(&mut self, tick: u64) -> TickTiming {
        match self {
            Self::Free(clock) => TickTiming {
                tick,
                due_ns: clock.now_ns(),
                late_ns: 0,
            },
            Self::Paced(pacer) => pacer.wait(tick),
        }
    }

    /// Records that the tick has been answered.
    pub(super) fn end(&mut self, timing: TickTiming) -> FinishedTick {
        match self {
            Self::Free(clock) => FinishedTick {
                work_ns: clock.now_ns().saturating_sub(timing.due_ns),
                met_deadline: true,
            },
            Self::Paced(pacer) => pacer.finish(timing),
        }
    }
}
