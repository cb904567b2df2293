//! Report of a plan.

use std::io::{self, Write};

use serde::Serialize;

use super::demand::Demand;
use crate::commands::margin::Margin;
use dashpot_report::verdict::Verdict;

/// Plan of a hybrid test.
#[derive(Serialize)]
pub(super) struct Report {
    pub(super) case: String,
    pub(super) vehicle: String,
    pub(super) speed_km_h: f64,
    pub(super) actuator: String,
    pub(super) compensation: String,
    pub(super) positions: Vec<Position>,
}

/// Plan of one damper position.
#[derive(Serialize)]
pub(super) struct Position {
    pub(super) damper: String,
    /// Pure delay of the force that the vehicle bears at this position.
    pub(super) critical: Margin,
    /// Delay of the actuator at the critical frequency, s; `None` if there is none.
    pub(super) actuator_delay_s: Option<f64>,
    /// Gain of the actuator at that frequency.
    pub(super) actuator_gain: Option<f64>,
    /// Margin with the actuator and without compensation.
    pub(super) uncompensated: Margin,
    /// Margin with the actuator and the chosen compensation.
    pub(super) margin: Margin,
    /// What the case asks for; `None` with `--no-run`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) demand: Option<Demand>,
    /// What the actuator cannot give.
    pub(super) exceeded: Vec<String>,
}

impl Position {
    /// Why a test must not start; `None` if it may.
    pub(super) fn refusal(&self, step_s: f64) -> Option<String> {
        let mut reasons = self.exceeded.clone();
        if !self.margin.bears(step_s) {
            reasons.insert(0, format!("no margin ({})", self.margin.text()));
        }
        (!reasons.is_empty()).then(|| format!("{}: {}", self.damper, reasons.join(", ")))
    }
}

pub(super) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "{}: {} at {:.1} km/h; {}, compensation: {}\n",
        report.case, report.vehicle, report.speed_km_h, report.actuator, report.compensation
    )?;
    writeln!(
        out,
        "damper                    critical delay       actuator there   uncompensated    compensated"
    )?;
    for position in &report.positions {
        let critical = match &position.critical {
            Margin::Below {
                delay_s,
                frequency_hz,
            } => format!("{:.1} ms, {frequency_hz:.2} Hz", 1e3 * delay_s),
            other => other.text(),
        };
        let there = match (position.actuator_delay_s, position.actuator_gain) {
            (Some(delay_s), Some(gain)) => format!("{:.1} ms, x {gain:.2}", 1e3 * delay_s),
            _ => "-".into(),
        };
        let has_margin = !matches!(
            position.margin,
            Margin::None { .. } | Margin::Unknown { .. }
        );
        writeln!(
            out,
            "{:<25} {critical:<20} {there:<16} {:<16} {}",
            position.damper,
            position.uncompensated.text(),
            Verdict::of(has_margin).mark(position.margin.text())
        )?;
    }
    if report
        .positions
        .iter()
        .any(|position| position.demand.is_some())
    {
        writeln!(
            out,
            "\nthe case asks for         stroke, mm  velocity, m/s  force, kN  bandwidth, Hz"
        )?;
    }
    for position in &report.positions {
        let Some(demand) = &position.demand else {
            continue;
        };
        let bandwidth = demand
            .bandwidth_hz
            .map_or_else(|| "-".into(), |hz| format!("{hz:.1}"));
        writeln!(
            out,
            "{:<25} {:>10.2} {:>14.3} {:>10.2} {bandwidth:>14}",
            position.damper,
            1e3 * demand.stroke_m,
            demand.velocity_m_per_s,
            1e-3 * demand.force_n
        )?;
    }
    writeln!(
        out,
        "\ncritical delay: pure delay at which motion begins to grow; any: no pure delay makes it grow, but an\n\
         actuator, whose gain changes too, still may; actuator there: its delay and gain at that frequency;\n\
         margin: further delay that the loop with the actuator bears. Linear vehicle on straight track with rigid\n\
         rails. Bandwidth: 99 % of the power of the velocity."
    )
}
