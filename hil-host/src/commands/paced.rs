//! Report of a real-time run.

use std::io::{self, Write};

use serde::Serialize;

use super::counted;
use super::tick_times::TickTimes;
use dashpot_realtime::budget::Run;
use dashpot_realtime::limits::TICKS_PER_ALLOWED_MISS;
use dashpot_realtime::pacing::PacingReport;
use dashpot_realtime::timing::{Figures, optional_span, span};
use dashpot_report::verdict::Verdict;

/// Deadlines, lateness and computing time of the ticks.
#[derive(Serialize)]
pub(super) struct Paced {
    ticks: u64,
    missed_deadlines: u64,
    /// Largest accepted number of missed deadlines.
    allowed_missed_deadlines: u64,
    lateness: Figures,
    work: Figures,
    /// Number of ticks that waited for the writing thread.
    #[serde(skip_serializing_if = "Option::is_none")]
    waits_for_writing: Option<u64>,
    /// Times of the ticks, as `dashpot budget` reports them.
    #[serde(flatten)]
    times: Option<TickTimes>,
}

impl From<&PacingReport> for Paced {
    fn from(report: &PacingReport) -> Self {
        Self {
            ticks: report.ticks,
            allowed_missed_deadlines: report.ticks / TICKS_PER_ALLOWED_MISS,
            missed_deadlines: report.missed_deadlines,
            lateness: report.lateness.figures(),
            work: report.work.figures(),
            waits_for_writing: None,
            times: None,
        }
    }
}

impl Paced {
    /// Creates the report of a run with the times of its ticks of `step_s` (s). Another thread writes its results, for
    /// which `waits` ticks waited.
    pub(super) fn with_times(report: &PacingReport, step_s: f64, waits: u64) -> Self {
        Self {
            waits_for_writing: Some(waits),
            times: Some(TickTimes::new(&Run::from(report.clone()), step_s)),
            ..Self::from(report)
        }
    }

    /// Prints one line of text, and the times if there are any; `work` describes the work of a tick.
    pub(super) fn write(&self, out: &mut dyn Write, work: &str) -> io::Result<()> {
        let missed = format!(
            "{} of {} deadlines missed",
            self.missed_deadlines, self.ticks
        );
        writeln!(
            out,
            "real time: {} (allowed {}); lateness at most {}, 99th percentile {}; {work}: at most {}, in tick {}",
            Verdict::of(self.missed_deadlines <= self.allowed_missed_deadlines).mark(missed),
            self.allowed_missed_deadlines,
            span(self.lateness.worst_ns),
            optional_span(self.lateness.p99_ns),
            span(self.work.worst_ns),
            self.work.worst_index
        )?;
        if let Some(waits) = self.waits_for_writing.filter(|waits| *waits > 0) {
            writeln!(
                out,
                "warning: {} waited for the thread that writes the history",
                counted(waits, "tick")
            )?;
        }
        match &self.times {
            Some(times) => times.print(out),
            None => Ok(()),
        }
    }
}
