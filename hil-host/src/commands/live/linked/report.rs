//! Report of a target.

use std::io::{self, Write};

use dashpot_realtime::timing::{optional_span, span};
use serde::Serialize;

use crate::commands::counted;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::live::recorded::Recorded;
use crate::commands::live::viewers::Viewers;

/// How it ended.
#[derive(Serialize)]
#[serde(tag = "mode", rename_all = "snake_case")]
pub(super) enum Ended {
    /// The target was driven from here.
    Driven {
        /// Target and host compared.
        #[serde(flatten)]
        report: Box<dashpot_host_link::Report>,
        /// True if the emergency stop was pressed.
        is_stopped: bool,
    },
    /// The target ran free.
    Watched {
        /// Ticks that were fetched.
        ticks: u64,
        /// True if the emergency stop was pressed, which stopped the target, too.
        is_stopped: bool,
    },
}

/// The report.
#[derive(Serialize)]
pub(super) struct Report {
    pub link: String,
    pub core_version: String,
    pub step_us: f64,
    #[serde(flatten)]
    pub ended: Ended,
    pub warnings: Vec<String>,
    pub viewers: Viewers,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recording: Option<Recorded>,
}

impl Ended {
    /// The end in words.
    pub fn in_words(&self) -> String {
        match self {
            Self::Driven {
                is_stopped: true, ..
            } => "the emergency stop ended the motion".into(),
            Self::Watched {
                is_stopped: true, ..
            } => "the emergency stop stopped the target".into(),
            _ => "dashpot live has ended".into(),
        }
    }
}

impl Report {
    /// Judges the run.
    ///
    /// # Errors
    /// A force of the target differs from that of this host, or the recording failed.
    pub fn verdict(&self) -> Outcome<()> {
        let recording = self.recording.as_ref();
        if let Some(error) = recording.and_then(|recording| recording.error.as_ref()) {
            return Err(Failure::new(error.clone()));
        }
        match &self.ended {
            Ended::Driven { report, .. }
                if report.mismatches > 0 || report.state_mismatches > 0 =>
            {
                Err(Failure::new(format!(
                    "{} forces or status words and {} states differ from those of the host",
                    report.mismatches, report.state_mismatches
                )))
            }
            _ => Ok(()),
        }
    }
}

/// Prints the report as text.
pub(super) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "target at {}: dashpot-core {}, step {} us",
        report.link, report.core_version, report.step_us
    )?;
    match &report.ended {
        Ended::Driven { report, .. } => {
            let ticks = counted(report.ticks.into(), "tick");
            let trip = &report.round_trip;
            writeln!(
                out,
                "{ticks} driven; {} of its forces differ from those of this host",
                report.mismatches
            )?;
            writeln!(
                out,
                "round trip: median {}, 99 % {}, maximum {}; {} deadlines missed",
                optional_span(trip.p50_ns),
                optional_span(trip.p99_ns),
                span(trip.worst_ns),
                report
                    .pacing
                    .as_ref()
                    .map_or(0, |pacing| pacing.missed_deadlines)
            )?;
        }
        Ended::Watched { ticks, .. } => {
            writeln!(out, "{} watched; it runs free", counted(*ticks, "tick"))?;
        }
    }
    writeln!(out, "{}", report.ended.in_words())?;
    report.viewers.print(out)?;
    if let Some(recording) = &report.recording {
        recording.print(out)?;
    }
    for warning in &report.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    Ok(())
}
