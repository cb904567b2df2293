//! Report of `dashpot budget`.

use std::io::{self, Write};

use serde::Serialize;

use crate::commands::tick_times::TickTimes;
use dashpot_files::Scalar;
use dashpot_realtime::budget::Run;
use dashpot_realtime::options::RealtimeOptions;
use dashpot_realtime::timing::{Machine, span};
use dashpot_report::verdict::Verdict;

/// Settings of the run and the machine.
#[derive(Serialize)]
pub(super) struct Setting {
    pub(super) mode: &'static str,
    pub(super) damper: String,
    pub(super) scalar: Scalar,
    pub(super) dampers: u32,
    pub(super) step_s: f64,
    pub(super) clock_overhead_ns: u64,
    pub(super) realtime: RealtimeOptions,
    pub(super) machine: Machine,
}

#[derive(Serialize)]
pub(super) struct Report {
    #[serde(flatten)]
    setting: Setting,
    ticks: u64,
    missed_deadlines: Option<u64>,
    #[serde(flatten)]
    times: TickTimes,
}

impl Report {
    /// Creates the report of a run.
    pub(super) fn new(setting: Setting, run: &Run) -> Self {
        Self {
            ticks: run.ticks,
            missed_deadlines: run.missed_deadlines,
            times: TickTimes::new(run, setting.step_s),
            setting,
        }
    }
}

/// Prints the report as text.
pub(super) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let setting = &report.setting;
    writeln!(
        out,
        "{} {}, dampers per tick: {}, {} ticks, {}; tick {}; two clock readings take {}{}",
        setting.damper,
        setting.scalar,
        setting.dampers,
        report.ticks,
        setting.mode,
        span(setting.step_s * 1e9),
        span(setting.clock_overhead_ns as f64),
        if cfg!(debug_assertions) {
            "; built without optimisation"
        } else {
            ""
        }
    )?;
    writeln!(out, "{}", setting.machine)?;
    if let Some(missed) = report.missed_deadlines {
        let verdict = match missed {
            0 => Verdict::Passed,
            _ => Verdict::Warning,
        };
        let missed = format!("{missed} of {}", report.ticks);
        writeln!(out, "missed deadlines: {}", verdict.mark(missed))?;
    }
    report.times.print(out)
}
