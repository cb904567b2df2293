//! Time per tick on this machine, in free or paced runs.

mod free;
mod histogram;
mod paced;

pub use free::free;
pub use histogram::histogram;
pub use paced::paced;

use crate::RealtimeError;
use crate::pacing::PacingReport;
use crate::stop::Stop;
use crate::timing::Distribution;

/// Length of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Length {
    /// Number of ticks.
    Ticks(u64),
    /// Duration on the clock (ns).
    Nanoseconds(u64),
}

/// Time spans of one kind.
#[derive(Debug, Clone)]
pub struct Series {
    /// What was timed.
    pub name: &'static str,
    /// Number of ticks per span.
    pub ticks_per_span: u64,
    /// Distribution of the spans.
    pub spans: Distribution,
}

/// Result of a run.
#[derive(Debug, Clone)]
pub struct Run {
    /// Number of timed ticks.
    pub ticks: u64,
    /// Number of ticks whose work ended after the next tick was due; `None` in free runs.
    pub missed_deadlines: Option<u64>,
    /// Tick that ended the run early, if any.
    pub stopped: Option<Stop>,
    /// Durations of the first ticks, with cold caches (ns).
    pub first_ticks_ns: Vec<u64>,
    /// Spans by kind; kinds without spans are omitted.
    pub series: Vec<Series>,
}

/// The result of a paced run, from the statistics of its pacer.
impl From<PacingReport> for Run {
    fn from(report: PacingReport) -> Self {
        let series = [
            ("work", report.work),
            ("lateness", report.lateness),
            ("response", report.response),
        ];
        Self {
            ticks: report.ticks,
            missed_deadlines: Some(report.missed_deadlines),
            stopped: report.stopped,
            first_ticks_ns: report.first_work_ns,
            series: series
                .into_iter()
                .map(|(name, spans)| Series {
                    name,
                    ticks_per_span: 1,
                    spans,
                })
                .collect(),
        }
    }
}

impl Run {
    /// Checks that the run met its limits.
    ///
    /// # Errors
    /// A slow tick ended the run, or with `fail_on_miss` a deadline was missed.
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
