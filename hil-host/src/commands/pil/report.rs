//! Report of `dashpot pil`.

use std::io::{self, Write};

use serde::Serialize;

use crate::commands::gap_report::write_gaps;
use crate::commands::print::counted;
use dashpot_host_link::xcp::Summary;
use dashpot_host_link::{FaultCounts, Report};
use dashpot_realtime::timing::{optional_span, span};
use dashpot_recording::Gaps;

/// Results of a run with its inputs.
#[derive(Serialize)]
pub(super) struct Found {
    /// One for all slots, or one per slot.
    pub(super) dampers: Vec<String>,
    pub(super) step_us: f64,
    #[serde(flatten)]
    pub(super) report: Report,
    pub(super) gaps: Gaps,
    /// What a measurement and calibration tool did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) xcp: Option<Summary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) injected_faults: Option<FaultCounts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) seed: Option<u64>,
    /// Output files.
    pub(super) files: Vec<String>,
}

impl Found {
    /// Returns the name of the damper in a slot.
    pub(super) fn damper(&self, slot: usize) -> &str {
        let slot = if self.dampers.len() == 1 { 0 } else { slot };
        self.dampers.get(slot).map_or("", String::as_str)
    }

    /// Describes the run in one line.
    pub(super) fn title(&self) -> String {
        let target = &self.report.target;
        let dampers = match &self.dampers[..] {
            [one] => format!("{} x {one}", target.dampers),
            each => each.join(", "),
        };
        format!(
            "{} of {} us through {dampers} on the target (dashpot-core {})",
            counted(self.report.ticks.into(), "tick"),
            self.step_us,
            target.core_version
        )
    }

    /// Returns the results as pairs of label and text.
    pub(super) fn lines(&self) -> Vec<(&'static str, String)> {
        let report = &self.report;
        let mut lines = vec![("mismatches", self.mismatches())];
        if let Some(first) = report.first_mismatch {
            let text = format!(
                "tick {}, damper {}: target {} N status {:#x}, host {} N status {:#x}",
                first.tick,
                first.damper,
                first.target_force_n,
                first.target_status,
                first.host_force_n,
                first.host_status
            );
            lines.push(("  first at", text));
        }
        let trip = &report.round_trip;
        let text = format!(
            "median {}, 99 % {}, 99.9 % {}, maximum {}",
            optional_span(trip.p50_ns),
            optional_span(trip.p99_ns),
            optional_span(trip.p99_9_ns),
            span(trip.worst_ns)
        );
        lines.push(("round trip", text));
        lines.extend(self.pacing_lines());
        lines.extend(self.cost_lines());
        lines.extend(self.fault_lines());
        lines
    }

    fn mismatches(&self) -> String {
        let report = &self.report;
        match report.mismatches + report.state_mismatches as u64 {
            0 => "none: every force, status and state is bit-identical to the host's".into(),
            _ => format!(
                "{} forces or status words, {} states",
                report.mismatches, report.state_mismatches
            ),
        }
    }

    fn pacing_lines(&self) -> Vec<(&'static str, String)> {
        let Some(pacing) = &self.report.pacing else {
            return Vec::new();
        };
        let missed = format!(
            "{} of {}, {:.2} %: the response came after the next tick was due",
            pacing.missed_deadlines,
            counted(self.report.ticks.into(), "tick"),
            1e2 * pacing.missed_share
        );
        let sent = format!(
            "median {}, 99 % {}, maximum {}",
            optional_span(pacing.lateness.p50_ns),
            optional_span(pacing.lateness.p99_ns),
            span(pacing.lateness.worst_ns)
        );
        vec![("missed deadlines", missed), ("  sent late by", sent)]
    }

    fn cost_lines(&self) -> Vec<(&'static str, String)> {
        let report = &self.report;
        let clock = &report.clock_ticks;
        let text = format!(
            "{:.1} clock ticks of {:.0} MHz ({:.0} to {:.0})",
            clock.mean,
            f64::from(report.target.clock_hz) * 1e-6,
            clock.min,
            clock.max
        );
        let mut lines = vec![("step of the bank", text)];
        if let Some(instructions) = &report.instructions {
            let text = format!(
                "{:.0} ({:.0} to {:.0}), {:.1} per damper",
                instructions.mean,
                instructions.min,
                instructions.max,
                instructions.mean / report.target.dampers as f64
            );
            lines.push(("  in instructions", text));
        }
        lines
    }

    fn fault_lines(&self) -> Vec<(&'static str, String)> {
        let seen = &self.report.link_faults;
        let mut lines = vec![
            (
                "link faults seen",
                format!(
                    "{} timeouts, {} corrupt requests, {} corrupt responses, {} stale responses, {} lost sessions",
                    seen.timeouts,
                    seen.corrupt_requests,
                    seen.corrupt_answers,
                    seen.stale_answers,
                    seen.lost_sessions
                ),
            ),
            (
                "  repaired by",
                format!(
                    "{} repeated requests, {} restored states",
                    seen.repeated_requests, self.report.recoveries
                ),
            ),
        ];
        if let (Some(made), Some(seed)) = (&self.injected_faults, self.seed) {
            let text = format!(
                "{} dropped, {} corrupted, {} delayed, {} duplicated, {} reordered, {} resets (seed {seed})",
                made.dropped,
                made.corrupted,
                made.delayed,
                made.duplicated,
                made.reordered,
                made.resets
            );
            lines.push(("injected link faults", text));
        }
        lines
    }
}

/// Prints the results as text.
pub(super) fn print(out: &mut dyn Write, found: &Found) -> io::Result<()> {
    writeln!(out, "{}", found.title())?;
    write_gaps(out, &found.gaps)?;
    for (what, text) in found.lines() {
        writeln!(out, "{what:<21} {text}")?;
    }
    for file in &found.files {
        writeln!(out, "wrote {file}")?;
    }
    Ok(())
}
