//! `dashpot budget`: measures the time per step on this host, free-running or in real time.

mod bench;
mod report;

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use bench::Bench;
use dashpot_core::Damper;
use dashpot_testbench::compiled::Compiled;
use report::{Report, Setting, print};

use super::named_values;
use super::tick_times::histogram_help;
use super::{
    DamperArguments, Format, RealtimeArguments, TickLimitArguments, print_report,
    print_report_beside,
};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::{Scalar, output};
use dashpot_realtime::budget::{Length, free, histogram, paced};
use dashpot_realtime::limits::RATE_RANGE_HZ;
use dashpot_realtime::pacing::{MonotonicClock, Pacer, overhead_ns};
use dashpot_realtime::timing::Machine;

/// Measure the time per step on this host: histogram, percentiles, worst case, missed deadlines.
///
/// The dampers follow a synthetic motion that repeats: a random ride, a decay, then rest.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = concat!("Examples:
  dashpot budget --damper paper --steps 1000000
  dashpot budget --rate-hz 10000 --duration-s 60 --fifo 80 --lock-memory --core 1 --fail-on-miss
  dashpot budget --rate-hz 1000 --stop-above-ns 100000 --format json
  dashpot budget --paced --duration-s 60 --fifo 80 --lock-memory --histogram latency.txt

", histogram_help!()))]
pub struct BudgetArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Floating-point type.
    #[arg(long, value_parser = named_values::scalar(), default_value_t = Scalar::F32)]
    scalar: Scalar,
    /// Number of ticks to run [default: 1000000 free-running, five seconds in real time].
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=10_000_000_000))]
    steps: Option<u64>,
    /// Duration instead of --steps, s; in a free-running measurement, half of it is for single ticks and half for
    /// batches.
    #[arg(long, conflicts_with = "steps", value_name = "S",
        value_parser = clap::value_parser!(u64).range(1..=604_800))]
    duration_s: Option<u64>,
    /// Number of dampers stepped per tick.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    dampers: u32,
    /// Run in real time at this rate, Hz [default: free-running, with dampers built for 1000 Hz].
    #[arg(long, value_parser = clap::value_parser!(u32).range(rates_hz()))]
    rate_hz: Option<u32>,
    /// Run in real time at 1000 Hz, or at the rate of --rate-hz, which alone has the same effect.
    #[arg(long)]
    paced: bool,
    /// Write the number of ticks for each microsecond of work, lateness and response, in the layout of
    /// `cyclictest --histogram`; `-` for standard output. Needs a run in real time.
    #[arg(long, value_name = "FILE")]
    histogram: Option<PathBuf>,
    #[command(flatten)]
    limits: TickLimitArguments,
    #[command(flatten)]
    realtime: RealtimeArguments,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Rate for which dampers are built, and of `--paced`, without `--rate-hz` (Hz).
const DEFAULT_RATE_HZ: u32 = 1000;

/// Returns the allowed tick rates (Hz) as a range for clap.
fn rates_hz() -> RangeInclusive<i64> {
    i64::from(*RATE_RANGE_HZ.start())..=i64::from(*RATE_RANGE_HZ.end())
}

impl BudgetArguments {
    /// Returns the rate of a run in real time (Hz); `None` for a free run.
    fn paced_rate_hz(&self) -> Option<u32> {
        self.rate_hz.or(self.paced.then_some(DEFAULT_RATE_HZ))
    }

    /// Returns the length of the run; `ticks` if no option sets it.
    fn length(&self, ticks: u64) -> Length {
        match (self.steps, self.duration_s) {
            (_, Some(duration_s)) => Length::Nanoseconds(duration_s * 1_000_000_000),
            (Some(steps), _) => Length::Ticks(steps),
            (None, None) => Length::Ticks(ticks),
        }
    }
}

/// Runs the budget and prints it.
///
/// # Errors
/// The damper is invalid, the system refuses a real-time option, a tick took longer than `--stop-above-ns`, or a
/// deadline was missed with `--fail-on-miss`.
pub fn run(arguments: &BudgetArguments) -> Outcome<()> {
    let is_paced = arguments.paced_rate_hz().is_some();
    arguments.limits.require_deadlines("--rate-hz", is_paced)?;
    if arguments.histogram.is_some() && !is_paced {
        return Err(Failure::wrong_use(
            "--histogram requires --paced or --rate-hz",
        ));
    }
    match arguments.scalar {
        Scalar::F32 => measure::<f32>(arguments),
        Scalar::F64 => measure::<f64>(arguments),
    }
}

fn measure<T: Compiled>(arguments: &BudgetArguments) -> Outcome<()> {
    let step_s = 1.0 / f64::from(arguments.paced_rate_hz().unwrap_or(DEFAULT_RATE_HZ));
    let damper: Damper<T> = T::compiled_build(&arguments.damper.load()?, step_s)?;
    let mut bench = Bench::new(damper, arguments.dampers, step_s);
    let options = arguments.realtime.options();
    // Read the load average before the run, so that it does not include the run itself.
    let machine = Machine::read(Path::new("/"), options.core, SystemTime::now());
    let clock = MonotonicClock::default();
    let clock_overhead_ns = overhead_ns(&clock);
    let limit_ns = arguments.limits.stop_above_ns;
    let (mode, run) = if let Some(rate) = arguments.paced_rate_hz() {
        let length = arguments.length(5 * u64::from(rate));
        let pacer = Pacer::new(step_s, &options)?;
        ("paced", paced(pacer, length, limit_ns, || bench.tick()))
    } else {
        options.apply()?;
        let length = arguments.length(1_000_000);
        let run = free(&clock, clock_overhead_ns, step_s, length, limit_ns, || {
            bench.tick();
        });
        ("free", run)
    };
    let setting = Setting {
        mode,
        damper: arguments.damper.damper.clone(),
        scalar: Scalar::of::<T>(),
        dampers: arguments.dampers,
        step_s,
        clock_overhead_ns,
        realtime: options,
        machine,
    };
    let report = Report::new(setting, &run);
    match &arguments.histogram {
        Some(file) => {
            output::write_bytes(file, histogram(&run).as_bytes())?;
            print_report_beside(file, arguments.format, &report, print)?;
        }
        None => print_report(arguments.format, &report, print)?,
    }
    Ok(run.verdict(arguments.limits.fail_on_miss)?)
}
