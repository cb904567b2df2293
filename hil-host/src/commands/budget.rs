//! `dashpot budget`: time per step on this host, free running or in real ticks.

use std::hint::black_box;
use std::io::{self, Write};

use dashpot_core::{Damper, DamperState, Real};
use serde::Serialize;

use super::{DamperArguments, Format, RealtimeArguments, Scalar, print_report};
use crate::excitation::Excitation;
use crate::failure::Outcome;
use crate::pacing::{Clock, FIRST_TICKS, MonotonicClock, Pacer, RealtimeOptions, overhead_ns};
use crate::timing::{Bar, Distribution, Figures};

/// Ticks timed together, so that reading the clock costs each a hundredth of itself.
const BATCH: usize = 100;

/// Time per step on this host: histogram, percentiles, worst case, missed deadlines.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot budget --damper paper --steps 1000000
  dashpot budget --rate-hz 10000 --fifo 80 --lock-memory --core 1 --format json")]
pub struct BudgetArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Floating-point type.
    #[arg(long, value_enum, default_value_t = Scalar::F32)]
    scalar: Scalar,
    /// Ticks to run; 1000000 free running, five seconds paced when not given.
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=10_000_000_000))]
    steps: Option<u64>,
    /// Dampers stepped each tick.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    dampers: u32,
    /// Run in real ticks at this rate, Hz; free running, built for 1000 Hz, when not given.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1000..=10_000))]
    rate_hz: Option<u32>,
    #[command(flatten)]
    realtime: RealtimeArguments,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Spread {
    name: &'static str,
    figures: Figures,
    worst_share_of_tick: f64,
    histogram: Vec<Bar>,
}

#[derive(Serialize)]
struct Report {
    mode: &'static str,
    damper: String,
    scalar: &'static str,
    dampers: u32,
    ticks: u64,
    step_s: f64,
    clock_overhead_ns: u64,
    realtime: RealtimeOptions,
    missed_deadlines: Option<u64>,
    first_ticks_ns: Vec<u64>,
    spreads: Vec<Spread>,
}

/// Runs the budget and prints it.
///
/// # Errors
/// The damper is refused, or the system refuses a real-time option.
pub fn run(arguments: &BudgetArguments) -> Outcome<()> {
    let report = match arguments.scalar {
        Scalar::F32 => measure::<f32>(arguments, "f32"),
        Scalar::F64 => measure::<f64>(arguments, "f64"),
    }?;
    print_report(arguments.format, &report, print)
}

/// Dampers on a ride that ends where it began, a decay, then rest.
struct Bench<T> {
    damper: Damper<T>,
    states: Vec<DamperState<T>>,
    motion: Vec<T>,
    tick: usize,
}

impl<T: Real> Bench<T> {
    fn new(damper: Damper<T>, dampers: u32, step_s: f64) -> Self {
        let mut motion = Excitation::Ride.displacements_m(step_s);
        let last = motion.len() - 1;
        let end = motion[last];
        for (tick, x) in motion.iter_mut().enumerate() {
            *x -= end * tick as f64 / last as f64;
        }
        motion.extend(Excitation::Decay.displacements_m(step_s));
        motion.resize(motion.len() + (1.0 / step_s) as usize, 0.0);
        Self {
            states: vec![damper.at_rest(T::ZERO); dampers as usize],
            damper,
            motion: motion.into_iter().map(T::from_f64).collect(),
            tick: 0,
        }
    }

    fn tick(&mut self) {
        let x = black_box(self.motion[self.tick]);
        for state in &mut self.states {
            black_box(self.damper.step(state, x));
        }
        self.tick = (self.tick + 1) % self.motion.len();
    }
}

/// What a run saw.
struct Seen {
    ticks: u64,
    missed_deadlines: Option<u64>,
    first_ticks_ns: Vec<u64>,
    spreads: Vec<(&'static str, Distribution)>,
}

fn measure<T: Real>(arguments: &BudgetArguments, scalar: &'static str) -> Outcome<Report> {
    let step_s = 1.0 / f64::from(arguments.rate_hz.unwrap_or(1000));
    let damper: Damper<T> = arguments.damper.load()?.build(step_s)?;
    let mut bench = Bench::new(damper, arguments.dampers, step_s);
    let options = arguments.realtime.options();
    let clock_overhead_ns = overhead_ns(&MonotonicClock::default());
    let (mode, seen) = if let Some(rate) = arguments.rate_hz {
        let ticks = arguments.steps.unwrap_or(5 * u64::from(rate));
        let pacer = Pacer::new(step_s, &options)?;
        ("paced", paced(&mut bench, ticks, pacer))
    } else {
        let ticks = arguments.steps.unwrap_or(1_000_000);
        options.apply()?;
        ("free", free(&mut bench, ticks, clock_overhead_ns as f64))
    };
    let spreads = seen.spreads.iter().map(|(name, distribution)| {
        let figures = distribution.figures();
        Spread {
            name,
            worst_share_of_tick: figures.worst_ns * 1e-9 / step_s,
            figures,
            histogram: distribution.bars(16),
        }
    });
    Ok(Report {
        mode,
        damper: arguments.damper.damper.clone(),
        scalar,
        dampers: arguments.dampers,
        ticks: seen.ticks,
        step_s,
        clock_overhead_ns,
        realtime: options,
        missed_deadlines: seen.missed_deadlines,
        first_ticks_ns: seen.first_ticks_ns,
        spreads: spreads.collect(),
    })
}

/// In real ticks.
fn paced<T: Real>(bench: &mut Bench<T>, ticks: u64, mut pacer: Pacer) -> Seen {
    for tick in 0..ticks {
        let timing = pacer.wait(tick);
        bench.tick();
        pacer.finish(timing);
    }
    let report = pacer.report().clone();
    Seen {
        ticks: report.ticks,
        missed_deadlines: Some(report.missed_deadlines),
        first_ticks_ns: report.first_work_ns,
        spreads: vec![
            ("work", report.work),
            ("lateness", report.lateness),
            ("response", report.response),
        ],
    }
}

/// One tick after another: each timed alone, then in batches; without what the clock takes.
fn free<T: Real>(bench: &mut Bench<T>, ticks: u64, overhead_ns: f64) -> Seen {
    let clock = MonotonicClock::default();
    let mut first_ticks_ns = Vec::new();
    let (mut single, mut batched) = (Distribution::new(), Distribution::new());
    for tick in 0..ticks {
        let begin = clock.now_ns();
        bench.tick();
        let span = clock.now_ns() - begin;
        single.record_ns((span as f64 - overhead_ns).max(0.0));
        if tick < FIRST_TICKS as u64 {
            first_ticks_ns.push(span);
        }
    }
    for _ in 0..ticks.div_ceil(BATCH as u64) {
        let begin = clock.now_ns();
        (0..BATCH).for_each(|_| bench.tick());
        let span = (clock.now_ns() - begin) as f64 - overhead_ns;
        batched.record_ns(span.max(0.0) / BATCH as f64);
    }
    Seen {
        ticks,
        missed_deadlines: None,
        first_ticks_ns,
        spreads: vec![("batched", batched), ("single", single)],
    }
}

/// The report for people.
fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "{} {}, dampers a tick: {}, {} ticks, {}; tick {:.0} us; two clock readings {} ns{}",
        report.damper,
        report.scalar,
        report.dampers,
        report.ticks,
        report.mode,
        report.step_s * 1e6,
        report.clock_overhead_ns,
        if cfg!(debug_assertions) {
            "; built without optimisation"
        } else {
            ""
        }
    )?;
    if let Some(missed) = report.missed_deadlines {
        writeln!(out, "missed deadlines: {missed} of {}", report.ticks)?;
    }
    writeln!(
        out,
        "first ticks, clock within, ns: {:?}",
        report.first_ticks_ns
    )?;
    for spread in &report.spreads {
        let f = &spread.figures;
        writeln!(
            out,
            "\n{} ns a tick: min {:.1}, mean {:.1}, p50 {:.1}, p90 {:.1}, p99 {:.1}, p99.9 {:.1}, p99.99 {:.1}, \
             worst {:.1} ({:.3} % of the tick)",
            spread.name,
            f.min_ns,
            f.mean_ns,
            f.p50_ns,
            f.p90_ns,
            f.p99_ns,
            f.p99_9_ns,
            f.p99_99_ns,
            f.worst_ns,
            100.0 * spread.worst_share_of_tick
        )?;
        for bar in &spread.histogram {
            let length = (40 * bar.count).div_ceil(f.count.max(1)) as usize;
            let bars = "#".repeat(length);
            let row = format!(
                "  {:>12.1} to {:>12.1}  {:>9}  {bars}",
                bar.from_ns, bar.to_ns, bar.count
            );
            writeln!(out, "{}", row.trim_end())?;
        }
    }
    Ok(())
}
