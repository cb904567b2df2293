//! `dashpot budget`: time per step on this host, free running or in real ticks.

use std::hint::black_box;
use std::io::{self, Write};

use dashpot_core::{Damper, DamperState, Real};
use serde::Serialize;

use super::{DamperArguments, Format, Scalar, print_report};
use crate::excitation::Excitation;
use crate::failure::Outcome;
use crate::pacing::{Clock, FIRST_TICKS, MonotonicClock, Pacer, RealtimeOptions, overhead_ns};
use crate::timing::{Bar, Distribution, Figures};

/// Ticks timed together, so that reading the clock costs each a hundredth of itself.
const BATCH: usize = 100;

/// Real-time options of a paced run.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct RealtimeArguments {
    /// Run under SCHED_FIFO with this priority.
    #[arg(long, value_name = "PRIORITY", value_parser = clap::value_parser!(u8).range(1..=99))]
    pub fifo: Option<u8>,
    /// Lock all memory.
    #[arg(long)]
    pub lock_memory: bool,
    /// Pin to this core.
    #[arg(long, value_name = "N")]
    pub core: Option<usize>,
}

impl RealtimeArguments {
    /// The options as the pacer takes them.
    pub fn options(&self) -> RealtimeOptions {
        RealtimeOptions {
            fifo_priority: self.fifo,
            lock_memory: self.lock_memory,
            core: self.core,
        }
    }
}

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

fn measure<T: Real>(arguments: &BudgetArguments, scalar: &'static str) -> Outcome<Report> {
    let step_s = 1.0 / f64::from(arguments.rate_hz.unwrap_or(1000));
    let damper: Damper<T> = arguments.damper.load()?.build(step_s)?;
    let mut bench = Bench::new(damper, arguments.dampers, step_s);
    let options = arguments.realtime.options();
    let mut report = Report {
        mode: "free",
        damper: arguments.damper.damper.clone(),
        scalar,
        dampers: arguments.dampers,
        ticks: 0,
        step_s,
        clock_overhead_ns: overhead_ns(&MonotonicClock::default()),
        realtime: options,
        missed_deadlines: None,
        first_ticks_ns: Vec::new(),
        spreads: Vec::new(),
    };
    let spread = |name, distribution: &Distribution| {
        let figures = distribution.figures();
        Spread {
            name,
            worst_share_of_tick: figures.worst_ns * 1e-9 / step_s,
            figures,
            histogram: distribution.bars(16),
        }
    };
    if let Some(rate) = arguments.rate_hz {
        let mut pacer = Pacer::new(step_s, &options)?;
        for tick in 0..arguments.steps.unwrap_or(5 * u64::from(rate)) {
            let timing = pacer.wait(tick);
            bench.tick();
            pacer.finish(timing);
        }
        let seen = pacer.report();
        report.mode = "paced";
        report.ticks = seen.ticks;
        report.missed_deadlines = Some(seen.missed_deadlines);
        report.first_ticks_ns = seen.first_work_ns.clone();
        report.spreads = vec![
            spread("work", &seen.work),
            spread("lateness", &seen.lateness),
            spread("response", &seen.response),
        ];
        return Ok(report);
    }
    options.apply()?;
    let clock = MonotonicClock::default();
    let steps = arguments.steps.unwrap_or(1_000_000);
    let overhead = report.clock_overhead_ns as f64;
    let (mut single, mut batched) = (Distribution::new(), Distribution::new());
    for tick in 0..steps {
        let begin = clock.now_ns();
        bench.tick();
        let span = clock.now_ns() - begin;
        single.record_ns((span as f64 - overhead).max(0.0));
        if tick < FIRST_TICKS as u64 {
            report.first_ticks_ns.push(span);
        }
    }
    for _ in 0..steps.div_ceil(BATCH as u64) {
        let begin = clock.now_ns();
        (0..BATCH).for_each(|_| bench.tick());
        let span = (clock.now_ns() - begin) as f64 - overhead;
        batched.record_ns(span.max(0.0) / BATCH as f64);
    }
    report.ticks = steps;
    report.spreads = vec![spread("batched", &batched), spread("single", &single)];
    Ok(report)
}

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
            writeln!(
                out,
                "  {:>12.1} to {:>12.1}  {:>9}  {bars}",
                bar.from_ns, bar.to_ns, bar.count
            )?;
        }
    }
    Ok(())
}
