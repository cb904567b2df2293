//! Report of `dashpot budget`.

use std::io::{self, Write};

use serde::Serialize;

use dashpot_files::Scalar;
use dashpot_realtime::budget::{Run, Series};
use dashpot_realtime::options::RealtimeOptions;
use dashpot_realtime::stop::Stop;
use dashpot_realtime::timing::{Bin, Figures, Machine, optional_span, span};

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
    stopped: Option<Stop>,
    first_ticks_ns: Vec<u64>,
    spreads: Vec<Spread>,
}

#[derive(Serialize)]
struct Spread {
    name: &'static str,
    figures: Figures,
    /// Tick that took longest, or the first tick of the batch that took longest; counted from 0.
    worst_tick: u64,
    /// Time of that tick along the motion (tick times step).
    worst_time_s: f64,
    worst_share_of_tick: f64,
    histogram: Vec<Bin>,
}

impl Spread {
    fn new(series: &Series, step_s: f64) -> Self {
        let figures = series.spans.figures();
        let worst_tick = figures.worst_index * series.ticks_per_span;
        Self {
            name: series.name,
            worst_tick,
            worst_time_s: worst_tick as f64 * step_s,
            worst_share_of_tick: figures.worst_ns * 1e-9 / step_s,
            figures,
            histogram: series.spans.bins(),
        }
    }
}

impl Report {
    /// Creates the report of a run.
    pub(super) fn new(setting: Setting, run: &Run) -> Self {
        let spread = |series| Spread::new(series, setting.step_s);
        Self {
            ticks: run.ticks,
            missed_deadlines: run.missed_deadlines,
            stopped: run.stopped,
            first_ticks_ns: run.first_ticks_ns.clone(),
            spreads: run.series.iter().map(spread).collect(),
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
        writeln!(out, "missed deadlines: {missed} of {}", report.ticks)?;
    }
    let first: Vec<String> = report
        .first_ticks_ns
        .iter()
        .map(|ns| span(*ns as f64))
        .collect();
    writeln!(
        out,
        "first ticks, including clock readings: {}",
        first.join(", ")
    )?;
    for spread in &report.spreads {
        print_spread(out, spread)?;
    }
    let sparse = |spread: &Spread| spread.figures.p99_99_ns.is_none();
    if report.spreads.iter().any(sparse) {
        writeln!(
            out,
            "\n-: too few values for this percentile (fewer than ten would lie beyond it)"
        )?;
    }
    Ok(())
}

fn print_spread(out: &mut dyn Write, spread: &Spread) -> io::Result<()> {
    let f = &spread.figures;
    writeln!(
        out,
        "\n{}, per tick: min {}, mean {}, p50 {}, p90 {}, p99 {}, p99.9 {}, p99.99 {}",
        spread.name,
        span(f.min_ns),
        span(f.mean_ns),
        optional_span(f.p50_ns),
        optional_span(f.p90_ns),
        optional_span(f.p99_ns),
        optional_span(f.p99_9_ns),
        optional_span(f.p99_99_ns),
    )?;
    writeln!(
        out,
        "  worst {}, {:.3} % of the tick, at tick {}, {:.6} s along the motion",
        span(f.worst_ns),
        100.0 * spread.worst_share_of_tick,
        spread.worst_tick,
        spread.worst_time_s
    )?;
    for bin in &spread.histogram {
        let length = (40 * bin.count).div_ceil(f.count.max(1)) as usize;
        let upper = bin
            .to_ns
            .map_or_else(|| "more".into(), |to_ns| format!("to {}", span(to_ns)));
        writeln!(
            out,
            "  {:>8} {upper:<11}  {:>9}  {}",
            span(bin.from_ns),
            bin.count,
            "#".repeat(length)
        )?;
    }
    Ok(())
}
