//! What a master did during a run.

use std::io::{self, Write};

use serde::Serialize;

use dashpot_host_link::xcp::Summary;

use crate::commands::counted;

/// A change by a master. It acts from the tick after `time_s` on, in real time possibly some ticks later.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "change", rename_all = "kebab-case")]
pub(super) enum Calibration {
    /// A parameter was written.
    Value {
        /// Time of the last measured tick, s.
        time_s: f64,
        page: &'static str,
        damper: String,
        key: &'static str,
        value: f64,
    },
    /// The vehicle uses another page.
    Page {
        /// Time of the last measured tick, s.
        time_s: f64,
        page: &'static str,
    },
}

/// What a master did during a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::commands::vehicle) struct XcpReport {
    /// Address of the server.
    pub(super) address: String,
    pub(super) is_read_only: bool,
    #[serde(flatten)]
    pub(super) summary: Summary,
    /// The first thousand changes.
    pub(super) changes: Vec<Calibration>,
}

impl XcpReport {
    /// True if a master changed the vehicle.
    pub(in crate::commands::vehicle) fn has_changes(&self) -> bool {
        !self.changes.is_empty()
    }

    /// Prints the report as text.
    pub(in crate::commands::vehicle) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let Summary {
            sessions,
            commands,
            refused_commands,
            measured_ticks,
            lost_ticks,
        } = self.summary;
        writeln!(
            out,
            "\nXCP on {}: {}, {} ({refused_commands} refused), {} measured, {lost_ticks} lost, {}",
            self.address,
            counted(sessions, "session"),
            counted(commands, "command"),
            counted(measured_ticks, "tick"),
            counted(self.changes.len() as u64, "change")
        )?;
        for change in &self.changes {
            match change {
                Calibration::Value {
                    time_s,
                    page,
                    damper,
                    key,
                    value,
                } => writeln!(out, "at {time_s} s: {damper}, {key} = {value} ({page})")?,
                Calibration::Page { time_s, page } => {
                    writeln!(out, "at {time_s} s: the dampers are {page}")?;
                }
            }
        }
        Ok(())
    }
}
