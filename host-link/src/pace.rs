//! When the ticks of a run are sent.

use dashpot_realtime::pacing::{Clock, FinishedTick, MonotonicClock, Pacer, TickTiming};

/// Ticks sent as soon as the one before is answered, or each when it is due.
pub enum Pace<C: Clock = MonotonicClock> {
    /// As soon as the one before is answered; the clock measures round trips.
    Free(C),
    /// Each a step after the one before, as a rig does.
    Paced(Box<Pacer<C>>),
}

impl Default for Pace {
    fn default() -> Self {
        Self::Free(MonotonicClock::default())
    }
}

impl<C: Clock> Pace<C> {
    /// The pacer, where the ticks are paced.
    pub fn pacer(&self) -> Option<&Pacer<C>> {
        match self {
            Self::Free(_) => None,
            Self::Paced(pacer) => Some(pacer),
        }
    }

    /// Returns when `tick` is to be sent.
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

    /// The tick is answered.
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
