//! The report of `dashpot pil`.

use std::io::{self, Write};

use serde::Serialize;

use crate::commands::gap_report::write_gaps;
use crate::commands::print::counted;
use dashpot_host_link::{FaultCounts, Report};
use dashpot_realtime::timing::{optional_span, span};
use dashpot_recording::Gaps;

/// A run and what it was of.
#[derive(Serialize)]
pub(super) struct Found {
    /// One for all places, or one for each.
    pub(super) dampers: Vec<String>,
    pub(super) step_us: f64,
    #[serde(flatten)]
    pub(super) report: Report,
    pub(super) gaps: Gaps,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) injected_faults: Option<FaultCounts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) seed: Option<u64>,
    /// Files written.
    pub(super) files: Vec<String>,
}

impl Found {
    /// The damper at a place.
    pub(super) fn damper(&self, place: usize) -> &str {
        let place = if self.dampers.len() == 1 { 0 } else { place };
        self.dampers.get(place).map_or("", String::as_str)
    }

    /// What was run.
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

    /// The results: what each is, and the result.
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
            lines.push(("  the first at", text));
        }
        let trip = &report.round_trip;
        let text = format!(
            "{} at the median, {} at 99 %, {} at 99.9 %, {} at most",
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
            0 => "none: every force, status and state has the host's bits".into(),
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
            "{} of {}, {:.2} %: answered after the next tick was due",
            pacing.missed_deadlines,
            counted(self.report.ticks.into(), "tick"),
            1e2 * pacing.missed_share
        );
        let sent = format!(
            "{} at the median, {} at 99 %, {} at most",
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
                "{:.0} ({:.0} to {:.0}), {:.1} a damper",
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
                    "{} timeouts, {} broken requests, {} broken answers, {} stale answers, {} lost sessions",
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
            lines.push(("link faults made", text));
        }
        lines
    }
}

/// The results for people.
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
