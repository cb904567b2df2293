//! Time per tick on this host, free running or in real ticks.

mod free;
mod paced;

pub use free::free;
pub use paced::paced;

use crate::RealtimeError;
use crate::stop::Stop;
use crate::timing::Distribution;

/// How long a run lasts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Length {
    /// So many ticks.
    Ticks(u64),
    /// So many nanoseconds of the clock.
    Nanoseconds(u64),
}

/// Time spans of one kind.
#[derive(Debug, Clone)]
pub struct Series {
    /// What they are spans of.
    pub name: &'static str,
    /// Ticks from one span to the next.
    pub ticks_per_span: u64,
    /// The spans.
    pub spans: Distribution,
}

/// What a run found.
#[derive(Debug, Clone)]
pub struct Run {
    /// Ticks timed.
    pub ticks: u64,
    /// Ticks whose work ended after the next tick was due; `None` free running.
    pub missed_deadlines: Option<u64>,
    /// Why the run ended early, if it did.
    pub stopped: Option<Stop>,
    /// Work of the first ticks, caches cold (ns).
    pub first_ticks_ns: Vec<u64>,
    /// The spans by kind, those that were counted.
    pub series: Vec<Series>,
}

/// The stop that a tick's work calls for under a limit.
fn stop(tick: u64, step_s: f64, work_ns: f64, limit_ns: Option<u64>) -> Option<Stop> {
    let limit_ns = limit_ns.filter(|limit| work_ns > *limit as f64)?;
    Some(Stop {
        tick,
        time_s: tick as f64 * step_s,
        work_ns,
        limit_ns,
    })
}

impl Run {
    /// Whether the run met its limits.
    ///
    /// # Errors
    /// It was stopped, or with `fail_on_miss` a deadline was missed.
    pub fn verdict(&self, fail_on_miss: bool) -> Result<(), RealtimeError> {
        if let Some(stop) = self.stopped {
            return Err(RealtimeError::Stopped(stop));
        }
        match self.missed_deadlines {
            Some(missed) if fail_on_miss && missed > 0 => Err(RealtimeError::MissedDeadlines {
                missed,
                ticks: self.ticks,
            }),
            _ => Ok(()),
        }
    }
}
