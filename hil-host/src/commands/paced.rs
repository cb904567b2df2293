//! What is told of a run in real ticks.

use std::io::{self, Write};

use serde::Serialize;

use super::counted;
use dashpot_realtime::limits::TICKS_PER_ALLOWED_MISS;
use dashpot_realtime::pacing::PacingReport;
use dashpot_realtime::timing::{Figures, optional_span, span};

/// Deadlines, lateness and work of the ticks.
#[derive(Serialize)]
pub(super) struct Paced {
    ticks: u64,
    missed_deadlines: u64,
    /// Missed deadlines with which the run is still on time.
    allowed_missed_deadlines: u64,
    lateness: Figures,
    work: Figures,
    /// Ticks that waited, because the thread that writes had fallen behind.
    #[serde(skip_serializing_if = "Option::is_none")]
    waits_for_writing: Option<u64>,
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
        }
    }
}

impl Paced {
    /// Of ticks whose results another thread writes, `waits` of which waited for it.
    pub(super) fn of_report(report: &PacingReport, waits: u64) -> Self {
        Self {
            waits_for_writing: Some(waits),
            ..Self::from(report)
        }
    }

    /// One line for people; `work` is what a tick does.
    pub(super) fn write(&self, out: &mut dyn Write, work: &str) -> io::Result<()> {
        writeln!(
            out,
            "real ticks: {} of {} deadlines missed, allowed {}; late by {} at most, {} at the 99th percentile; {work}: {} at most, in \
             tick {}",
            self.missed_deadlines,
            self.ticks,
            self.allowed_missed_deadlines,
            span(self.lateness.worst_ns),
            optional_span(self.lateness.p99_ns),
            span(self.work.worst_ns),
            self.work.worst_index
        )?;
        match self.waits_for_writing {
            Some(waits) if waits > 0 => writeln!(
                out,
                "warning: {} waited for the thread that writes the history",
                counted(waits, "tick")
            ),
            _ => Ok(()),
        }
    }
}
