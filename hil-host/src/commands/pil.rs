//! `dashpot pil`: processor in the loop.

use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Duration;

use dashpot_core::Damper;
use serde::Serialize;

use super::gap_report::write_gaps;
use super::step_size::StepSize;
use super::{DamperArguments, Format, print_report, progress};
use crate::failure::{Failure, Outcome};
use crate::input;
use crate::pil::{
    Client, FaultCounts, FaultRates, FaultyLink, Link as _, LinkChoice, Patience, Report, Session,
};
use crate::recording::{Gaps, Recording};
use crate::replay::Ticks;
use crate::timing::{optional_span, span};

/// Drive a damper on a target and compare every force with this host's, bit for bit.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot pil --link qemu --damper in-service --input data/excitations/ride_made.csv
  dashpot pil --link serial:/dev/ttyACM0 --damper my.toml --input run7.csv --format json
  dashpot pil --link qemu --input run7.csv --faults drop=0.01,corrupt=0.01,reset=0.001 --seed 7

The damper is loaded into every place of the target's bank; place i runs i ticks behind the first. Faults are
probabilities per frame: drop, corrupt, delay, duplicate, reorder, reset. Exit code 1 when a force differs.")]
pub struct PilArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// The target: tcp:HOST:PORT, serial:DEVICE, qemu (an emulator of our own) or qemu:IMAGE.
    #[arg(long, value_name = "LINK")]
    link: LinkChoice,
    /// Recorded motion, CSV with columns time_s,displacement_m; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
    /// Ticks at most; the whole recording when not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    ticks: Option<u32>,
    /// Faults to make on the link: kind=probability, separated by commas.
    #[arg(long, value_name = "FAULTS")]
    faults: Option<FaultRates>,
    /// Seed of the faults.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Wait for an answer, ms.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=60_000), value_name = "MS")]
    timeout_ms: u64,
    /// Tries of a request before the target counts as silent.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=1000))]
    tries: u32,
    /// Rate of a serial device, bit/s.
    #[arg(long, default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    baud: u32,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Result {
    #[serde(flatten)]
    report: Report,
    gaps: Gaps,
    #[serde(skip_serializing_if = "Option::is_none")]
    injected_faults: Option<FaultCounts>,
}

/// Runs the command.
///
/// # Errors
/// A damper, recording or target that cannot be used, a target lost for good, or a force that differs.
pub fn run(arguments: &PilArguments) -> Outcome<()> {
    arguments.damper.refuse_same_input(&arguments.input)?;
    let parameters = arguments.damper.load()?;
    let recording = Recording::open(&arguments.input)?;
    let rates = arguments.faults.unwrap_or_default();
    let link = FaultyLink::new(arguments.link.open(arguments.baud)?, rates, arguments.seed)?;
    let patience = Patience {
        timeout: Duration::from_millis(arguments.timeout_ms),
        tries: arguments.tries,
    };
    let mut session = Session::open(Client::new(link, patience, fastrand::u16(..)))?;

    let step_s = session.target().step_s;
    let step = StepSize::from_target(step_s).ok_or_else(|| {
        Failure::new(format!(
            "the target steps {step_s} s; allowed: 1 us to 20 ms"
        ))
    })?;
    let step_s = step.seconds();
    let damper: Damper<f32> = parameters.build(step_s)?;
    let bar = progress::bar(input::length(&arguments.input), "pil");
    let mut ticks = Ticks::new(recording, step_s)?;
    let mut left = arguments.ticks.unwrap_or(u32::MAX);
    let motion = || {
        if left == 0 {
            return Ok(None);
        }
        left -= 1;
        if left.is_multiple_of(256) {
            bar.set_position(ticks.recording().position());
        }
        Ok(ticks.next_tick()?.map(|tick| tick.displacement_m as f32))
    };
    let report = session.run(&[damper], motion, &mut crate::pil::Pace::default(), |_| {
        Ok(())
    })?;
    bar.finish_and_clear();
    let result = Result {
        report,
        gaps: ticks.recording().gaps(),
        injected_faults: arguments.faults.map(|_| session.link().faults_made()),
    };
    print_report(arguments.format, &result, |out, result| {
        print(out, result, arguments, step)
    })?;
    let report = &result.report;
    if report.mismatches > 0 || report.state_mismatches > 0 {
        return Err(Failure::new(format!(
            "{} forces or status words and {} states differ from the host's",
            report.mismatches, report.state_mismatches
        )));
    }
    Ok(())
}

fn print(
    out: &mut dyn Write,
    result: &Result,
    arguments: &PilArguments,
    step: StepSize,
) -> io::Result<()> {
    let report = &result.report;
    let target = &report.target;
    let dampers = target.dampers as f64;
    writeln!(
        out,
        "{} ticks of {step} us through {} x {} on the target (dashpot-core {})",
        report.ticks, target.dampers, arguments.damper.damper, target.core_version
    )?;
    write_gaps(out, &result.gaps)?;
    match report.mismatches + report.state_mismatches as u64 {
        0 => writeln!(
            out,
            "mismatches            none: every force, status and state has the host's bits"
        )?,
        _ => writeln!(
            out,
            "mismatches            {} forces or status words, {} states",
            report.mismatches, report.state_mismatches
        )?,
    }
    if let Some(first) = report.first_mismatch {
        writeln!(
            out,
            "  first at tick {}, damper {}: target {} N status {:#x}, host {} N status {:#x}",
            first.tick,
            first.damper,
            first.target_force_n,
            first.target_status,
            first.host_force_n,
            first.host_status
        )?;
    }
    let trip = &report.round_trip;
    writeln!(
        out,
        "round trip            {} at the median, {} at 99 %, {} at 99.9 %, {} at most",
        optional_span(trip.p50_ns),
        optional_span(trip.p99_ns),
        optional_span(trip.p99_9_ns),
        span(trip.worst_ns)
    )?;
    let clock = &report.clock_ticks;
    writeln!(
        out,
        "step of the bank      {:.1} clock ticks of {:.0} MHz ({:.0} to {:.0})",
        clock.mean,
        f64::from(target.clock_hz) * 1e-6,
        clock.min,
        clock.max
    )?;
    if let Some(instructions) = &report.instructions {
        writeln!(
            out,
            "                      {:.0} instructions ({:.0} to {:.0}), {:.1} a damper",
            instructions.mean,
            instructions.min,
            instructions.max,
            instructions.mean / dampers
        )?;
    }
    let seen = &report.link_faults;
    writeln!(
        out,
        "link faults seen      {} timeouts, {} broken requests, {} broken answers, {} stale answers, {} lost \
         sessions",
        seen.timeouts,
        seen.corrupt_requests,
        seen.corrupt_answers,
        seen.stale_answers,
        seen.lost_sessions
    )?;
    writeln!(
        out,
        "  repaired by         {} repeated requests, {} restored states",
        seen.repeated_requests, report.recoveries
    )?;
    if let Some(made) = &result.injected_faults {
        writeln!(
            out,
            "link faults made      {} dropped, {} corrupted, {} delayed, {} duplicated, {} reordered, {} resets \
             (seed {})",
            made.dropped,
            made.corrupted,
            made.delayed,
            made.duplicated,
            made.reordered,
            made.resets,
            arguments.seed
        )?;
    }
    Ok(())
}
