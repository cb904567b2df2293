//! Report on the external dampers.

use std::io::{self, Write};

use serde::Serialize;

use super::choice::{Choice, Source};
use super::rig::RigReport;
use super::silence::Silence;
use crate::commands::gap_report::{unended, unfinished};
use dashpot_files::case::Case;
use dashpot_realtime::timing::{optional_span, span};
use dashpot_recording::{ForceHistory, UnfinishedEnd};
use dashpot_study::verification::Effect;

/// Report on the external dampers.
#[derive(Debug, Clone, Serialize)]
pub(in crate::commands) struct OutsideReport {
    pub(in crate::commands) dampers: Vec<OutsideDamper>,
    /// Interval of the exchange of displacements and forces, s.
    pub(in crate::commands) exchange_step_s: f64,
    /// Delay from a displacement to the arrival of its force, s; does not apply to a recorded force.
    pub(in crate::commands) delay_s: f64,
    /// Rigs whose actuator moves a damper.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(in crate::commands) rigs: Vec<RigReport>,
    /// Targets whose link survived to the end.
    pub(in crate::commands) targets: Vec<Target>,
    /// Difference from the same run with all dampers simulated internally.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::commands) effect: Option<Effect>,
}

/// An external damper.
#[derive(Debug, Clone, Serialize)]
pub(in crate::commands) struct OutsideDamper {
    pub(in crate::commands) damper: String,
    /// Source of the force: a link or a file.
    pub(in crate::commands) source: String,
    pub(in crate::commands) is_recorded: bool,
    /// Number of the last line of the file, if it has no line end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::commands) unended_line: Option<u64>,
    /// End of the rows of the file, if it is an unfinished MDF4 file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::commands) unfinished: Option<UnfinishedEnd>,
    /// Answers that its target did not give; `None` for a recorded force.
    #[serde(flatten)]
    pub(in crate::commands) silence: Option<Silence>,
}

/// A target that runs external dampers.
#[derive(Debug, Clone, Serialize)]
pub(in crate::commands) struct Target {
    pub(in crate::commands) link: String,
    /// Number of its steps per exchange.
    pub(in crate::commands) steps_a_tick: u32,
    #[serde(flatten)]
    pub(crate) found: dashpot_host_link::Report,
}

impl OutsideReport {
    pub(super) fn new(
        choices: &[Choice],
        silences: &[Option<Silence>],
        case: &Case,
        targets: Vec<Target>,
        effect: Option<Effect>,
    ) -> Self {
        let dampers = choices.iter().zip(silences);
        let dampers = dampers.map(|(choice, silence)| OutsideDamper {
            damper: choice.damper.clone(),
            source: choice.name.clone(),
            is_recorded: matches!(choice.source, Source::File(_)),
            unended_line: None,
            unfinished: None,
            silence: *silence,
        });
        Self {
            dampers: dampers.collect(),
            exchange_step_s: case.step_s,
            delay_s: case.step_s,
            rigs: Vec::new(),
            targets,
            effect,
        }
    }

    /// Records which files of recorded forces have an uncertain end; `histories` is in the order of the
    /// dampers.
    pub(super) fn add_unended<'a>(&mut self, histories: impl Iterator<Item = &'a ForceHistory>) {
        let recorded = self.dampers.iter_mut().filter(|damper| damper.is_recorded);
        for (damper, history) in recorded.zip(histories) {
            damper.unended_line = history.unended_line();
            damper.unfinished = history.unfinished();
        }
    }

    /// Returns the lines of the report as pairs of label and text.
    pub(in crate::commands) fn lines(&self) -> Vec<(String, String)> {
        let mut lines = Vec::new();
        for OutsideDamper {
            damper,
            source,
            is_recorded,
            unended_line,
            unfinished: end,
            silence,
        } in &self.dampers
        {
            if let Some(rig) = self.rigs.iter().find(|rig| rig.damper == *damper) {
                lines.extend(rig.lines());
                continue;
            }
            let text = if *is_recorded {
                let warnings = [unended_line.map(unended), end.map(unfinished)];
                let warnings = warnings.into_iter().flatten();
                let warnings: String = warnings.map(|warning| format!("; {warning}")).collect();
                format!("recorded force from {source}{warnings}")
            } else {
                format!(
                    "on {source}: exchange every {} us, force delayed by {} us{}",
                    micro(self.exchange_step_s),
                    micro(self.delay_s),
                    silence.unwrap_or_default().text()
                )
            };
            lines.push((damper.clone(), text));
        }
        for target in &self.targets {
            lines.push((target.link.clone(), target.text()));
        }
        if let Some(effect) = &self.effect {
            lines.extend(of_effect(effect));
        }
        lines
    }
}

impl Target {
    /// Describes the exchange over the link in one line.
    fn text(&self) -> String {
        let dashpot_host_link::Report {
            round_trip,
            mismatches,
            recoveries,
            link_faults,
            ..
        } = &self.found;
        let steps = match self.steps_a_tick {
            1 => String::new(),
            steps => format!(", {steps} steps per exchange"),
        };
        let forces = match mismatches {
            0 => "every force is bit-identical to the host's".to_owned(),
            some => format!("{some} forces differ from the host's"),
        };
        format!(
            "round trip {} median, {} maximum{steps}; {forces}; {} requests repeated, {recoveries} recoveries",
            optional_span(round_trip.p50_ns),
            span(round_trip.worst_ns),
            link_faults.repeated_requests,
        )
    }
}

/// Describes the differences from the run with internal dampers.
fn of_effect(effect: &Effect) -> Vec<(String, String)> {
    let worst = &effect.deviations;
    let mut lines = vec![(
        "effect".into(),
        format!(
            "compared with the same {:.3} s with internal dampers, worst values:",
            effect.duration_s
        ),
    )];
    for damper in &effect.dampers {
        let text = format!(
            "{}: differs by {:.1} N rms, of {:.1} N rms",
            damper.damper, damper.difference_rms_n, damper.force_rms_n
        );
        lines.push(("  force".into(), text));
    }
    for (what, number, of) in [
        (
            "  acceleration",
            format!("{:.3} % NRMSE", 1e2 * worst.acceleration.deviation),
            &worst.acceleration.quantity,
        ),
        (
            "  wheelset lateral",
            format!("{:.3} um rms", 1e6 * worst.lateral_m.deviation),
            &worst.lateral_m.quantity,
        ),
        (
            "  wheel load",
            format!("{:.4} kN rms", 1e-3 * worst.load_n.deviation),
            &worst.load_n.quantity,
        ),
        (
            "  index",
            format!("{:.3} %", 1e2 * worst.index.deviation),
            &worst.index.quantity,
        ),
    ] {
        lines.push((what.into(), format!("{number}: {of}")));
    }
    lines
}

/// Converts to microseconds, rounded to the nanosecond.
fn micro(time_s: f64) -> f64 {
    (time_s * 1e9).round() * 1e-3
}

/// Prints the results as text.
pub(in crate::commands) fn print(out: &mut dyn Write, report: &OutsideReport) -> io::Result<()> {
    writeln!(out, "\nexternal dampers")?;
    for (what, text) in report.lines() {
        writeln!(out, "{what:<26} {text}")?;
    }
    Ok(())
}
