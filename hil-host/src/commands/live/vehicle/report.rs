//! Report of a run.

use std::io::{self, Write};

use serde::Serialize;

use crate::commands::counted;
use crate::commands::live::recorded::Recorded;
use crate::commands::live::viewers::Viewers;
use crate::commands::paced::Paced;
use crate::commands::vehicle::outside::{self, OutsideReport};
use dashpot_vehicle_run::Ending;

/// Report of a run.
#[derive(Serialize)]
pub(super) struct Report {
    pub case: String,
    pub vehicle: String,
    pub track: String,
    pub step_s: f64,
    /// Ticks of the vehicle, of all runs.
    pub ticks: u64,
    pub actions: u64,
    pub ending: Ending,
    /// True if somebody pressed the emergency stop, and the run ended because of it.
    pub is_stopped: bool,
    pub realtime: Paced,
    pub viewers: Viewers,
    /// Ticks that are in no frame and no recording, because the machine was too slow.
    pub unobserved_ticks: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recording: Option<Recorded>,
    pub warnings: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outside: Option<OutsideReport>,
}

/// Prints the report as text.
pub(super) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let Report {
        case,
        vehicle,
        track,
        ..
    } = report;
    writeln!(out, "{case}: {vehicle} on {track}")?;
    writeln!(
        out,
        "{} of {} us with {}; {}",
        counted(report.ticks, "tick"),
        (1e9 * report.step_s).round() * 1e-3,
        counted(report.actions, "action"),
        report.ending
    )?;
    if report.is_stopped {
        writeln!(out, "the emergency stop was pressed")?;
    }
    report.viewers.print(out)?;
    if report.unobserved_ticks > 0 {
        let unobserved = counted(report.unobserved_ticks, "tick");
        writeln!(
            out,
            "warning: {unobserved} in no frame and no recording: the machine was too slow"
        )?;
    }
    if let Some(recording) = &report.recording {
        recording.print(out)?;
    }
    for warning in &report.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    report.realtime.write(out, "work of a tick")?;
    match &report.outside {
        Some(found) => outside::print(out, found),
        None => Ok(()),
    }
}
