//! What is told of the dampers outside.

use std::io::{self, Write};

use serde::Serialize;

use super::choice::{Choice, Source};
use crate::commands::gap_report::unended;
use dashpot_files::case::Case;
use dashpot_realtime::timing::{optional_span, span};
use dashpot_recording::ForceHistory;
use dashpot_study::verification::Effect;

/// What is told of the dampers outside.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct OutsideReport {
    pub(crate) dampers: Vec<OutsideDamper>,
    /// Displacements and forces are exchanged so often, s.
    pub(crate) exchange_step_s: f64,
    /// From a displacement to the moment its force has come in, s; a recorded force has none.
    pub(crate) delay_s: f64,
    /// Links that lasted to the end.
    pub(crate) targets: Vec<Target>,
    /// Against the same run with all dampers inside.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) effect: Option<Effect>,
}

/// A damper outside.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct OutsideDamper {
    pub(crate) damper: String,
    /// The link or file.
    pub(crate) source: String,
    pub(crate) is_recorded: bool,
    /// The last line of the file, where it has no line end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) unended_line: Option<u64>,
}

/// A target that dampers are on.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Target {
    pub(crate) link: String,
    /// Its steps in one exchange.
    pub(crate) steps_a_tick: u32,
    #[serde(flatten)]
    pub(crate) found: dashpot_host_link::Report,
}

impl OutsideReport {
    pub(super) fn new(
        choices: &[Choice],
        case: &Case,
        targets: Vec<Target>,
        effect: Option<Effect>,
    ) -> Self {
        let dampers = choices.iter().map(|choice| OutsideDamper {
            damper: choice.damper.clone(),
            source: choice.name.clone(),
            is_recorded: matches!(choice.source, Source::File(_)),
            unended_line: None,
        });
        Self {
            dampers: dampers.collect(),
            exchange_step_s: case.step_s,
            delay_s: case.step_s,
            targets,
            effect,
        }
    }

    /// Notes which recorded forces, in the order of their dampers, end with a line that has no line end.
    pub(super) fn add_unended<'a>(&mut self, histories: impl Iterator<Item = &'a ForceHistory>) {
        let recorded = self.dampers.iter_mut().filter(|damper| damper.is_recorded);
        for (damper, history) in recorded.zip(histories) {
            damper.unended_line = history.unended_line();
        }
    }

    /// What each is, and the result.
    pub(crate) fn lines(&self) -> Vec<(String, String)> {
        let mut lines = Vec::new();
        for OutsideDamper {
            damper,
            source,
            is_recorded,
            unended_line,
        } in &self.dampers
        {
            let text = if *is_recorded {
                let warning = unended_line.map(|line| format!("; {}", unended(line)));
                format!("recorded force of {source}{}", warning.unwrap_or_default())
            } else {
                format!(
                    "on {source}: exchanged every {} us, its force {} us late",
                    micro(self.exchange_step_s),
                    micro(self.delay_s)
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
    /// The exchange over the link in one line.
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
            steps => format!(", {steps} steps an exchange"),
        };
        let forces = match mismatches {
            0 => "every force has the bits of this host's".to_owned(),
            some => format!("{some} forces are not this host's"),
        };
        format!(
            "a step and its answer {} at the median, {} at most{steps}; {forces}; {} requests repeated, {recoveries} recoveries",
            optional_span(round_trip.p50_ns),
            span(round_trip.worst_ns),
            link_faults.repeated_requests,
        )
    }
}

/// The differences from the run with all dampers inside.
fn of_effect(effect: &Effect) -> Vec<(String, String)> {
    let worst = &effect.deviations;
    let mut lines = vec![(
        "effect".into(),
        format!(
            "against the same {:.3} s with all dampers inside, worst of all:",
            effect.duration_s
        ),
    )];
    for damper in &effect.dampers {
        let text = format!(
            "{:.1} N rms of {:.1} N: force of {}",
            damper.difference_rms_n, damper.force_rms_n, damper.damper
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

/// Microseconds, to the nanosecond.
fn micro(time_s: f64) -> f64 {
    (time_s * 1e9).round() * 1e-3
}

/// The results for people.
pub(crate) fn print(out: &mut dyn Write, report: &OutsideReport) -> io::Result<()> {
    writeln!(out, "\ndampers outside")?;
    for (what, text) in report.lines() {
        writeln!(out, "{what:<26} {text}")?;
    }
    Ok(())
}
