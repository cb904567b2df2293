//! What is told of a run in real ticks.

use std::io::{self, Write};

use serde::Serialize;

use crate::realtime::pacing::PacingReport;
use crate::realtime::timing::{Figures, optional_span, span};

/// Deadlines, lateness and work of the ticks.
#[derive(Serialize)]
pub(super) struct Paced {
    missed_deadlines: u64,
    lateness: Figures,
    work: Figures,
}

impl From<&PacingReport> for Paced {
    fn from(report: &PacingReport) -> Self {
        Self {
            missed_deadlines: report.missed_deadlines,
            lateness: report.lateness.figures(),
            work: report.work.figures(),
        }
    }
}

impl Paced {
    /// One line for people; `work` is what a tick does.
    pub(super) fn write(&self, out: &mut dyn Write, work: &str) -> io::Result<()> {
        writeln!(
            out,
            "real ticks: {} deadlines missed; late by {} at most, {} at the 99th percentile; {work} {} at most",
            self.missed_deadlines,
            span(self.lateness.worst_ns),
            optional_span(self.lateness.p99_ns),
            span(self.work.worst_ns)
        )
    }
}
