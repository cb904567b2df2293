//! Times of the ticks of a run: the slow tick that ended it, the first ticks, percentiles and histograms.

use std::io::{self, Write};

use serde::Serialize;

use dashpot_realtime::budget::{Run, Series};
use dashpot_realtime::stop::Stop;
use dashpot_realtime::timing::{Bin, Figures, optional_span, span};

/// Explains the histograms in the help of a command.
macro_rules! histogram_help {
    () => {
        "Histogram bins are the same in every run, with edges at 1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3 and 8 times \
powers of ten
from 1 ns to 10 s (R10 of ISO 3). A value on an edge belongs to the bin above. Empty bins are omitted.
A percentile is printed only if at least ten values are expected beyond it: p50 needs 20 values, p90 100, p99 1000,
p99.9 10000 and p99.99 100000. Otherwise it is - in text and null in JSON."
    };
}
pub(super) use histogram_help;

/// Times of the ticks of a run.
#[derive(Serialize)]
pub(super) struct TickTimes {
    /// The tick that took longer than `--stop-above-ns`.
    stopped: Option<Stop>,
    first_ticks_ns: Vec<u64>,
    spreads: Vec<Spread>,
}

/// Distribution of one kind of time.
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

impl TickTimes {
    /// Returns the times of a run with ticks of `step_s` (s).
    pub(super) fn new(run: &Run, step_s: f64) -> Self {
        Self {
            stopped: run.stopped,
            first_ticks_ns: run.first_ticks_ns.clone(),
            spreads: run
                .series
                .iter()
                .map(|series| Spread::new(series, step_s))
                .collect(),
        }
    }

    /// Prints the times as text, except the tick that ended the run: its message follows as an error.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let first: Vec<String> = self
            .first_ticks_ns
            .iter()
            .map(|ns| span(*ns as f64))
            .collect();
        writeln!(
            out,
            "first ticks, including clock readings: {}",
            first.join(", ")
        )?;
        for spread in &self.spreads {
            print_spread(out, spread)?;
        }
        let sparse = |spread: &Spread| spread.figures.p99_99_ns.is_none();
        if self.spreads.iter().any(sparse) {
            writeln!(
                out,
                "\n-: too few values for this percentile (fewer than ten would lie beyond it)"
            )?;
        }
        Ok(())
    }
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
