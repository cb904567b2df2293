//! `dashpot replay`: force over a recorded motion.

use std::io::{self, Write};
use std::path::PathBuf;

use dashpot_core::{DamperParameters, Real, Status};
use serde::Serialize;

use super::{DamperArguments, Format, RealtimeArguments, Scalar, print_report, progress, step_s};
use crate::failure::{Failure, Outcome};
use crate::output::write_whole;
use crate::pacing::Pacer;
use crate::recording::Recording;
use crate::replay::{Summary, Ticks, replay};
use crate::timing::{Figures, optional_span, span};

/// Force of a damper over a recorded motion.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot replay --damper paper --input data/excitations/ride_made.csv --output force.csv
  dashpot replay --damper my.toml --set mount.clearance_m=1e-3 --input run7.csv --output f.csv
  dashpot replay --input run7.csv --output f.csv --realtime --fifo 80 --lock-memory --core 1

Input columns: time_s,displacement_m in any order; uneven times are allowed, other columns passed over.
Output columns: time_s,displacement_m,force_n at ticks from the first sample on, the displacement linear between samples.")]
pub struct ReplayArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Recorded motion, CSV.
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
    /// Force over time, CSV; written whole or not at all.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// Step, us.
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=20_000), value_name = "US")]
    step_us: u32,
    /// Floating-point type of the step.
    #[arg(long, value_enum, default_value_t = Scalar::F32)]
    scalar: Scalar,
    /// Replay in real ticks and report lateness and missed deadlines.
    #[arg(long)]
    realtime: bool,
    #[command(flatten)]
    options: RealtimeArguments,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Report {
    ticks: u64,
    step_s: f64,
    force_rms_n: f64,
    max_extension_force_n: f64,
    max_compression_force_n: f64,
    energy_j: f64,
    rejected_inputs: u16,
    input_held: bool,
    input_limited: bool,
    saturated: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    realtime: Option<Realtime>,
}

#[derive(Serialize)]
struct Realtime {
    missed_deadlines: u64,
    lateness: Figures,
    work: Figures,
}

/// Runs the command.
///
/// # Errors
/// A damper, recording or output file that cannot be used.
pub fn run(arguments: &ReplayArguments) -> Outcome<()> {
    let parameters = arguments.damper.load()?;
    if same_file(&arguments.input, &arguments.output) {
        return Err(Failure::in_file(
            &arguments.output,
            "is the input too; give another output file",
        ));
    }
    let options = arguments.options.options();
    if !arguments.realtime && options != Default::default() {
        return Err(Failure::new(
            "--fifo, --lock-memory and --core go with --realtime",
        ));
    }
    let mut pacer = if arguments.realtime {
        Some(Pacer::new(step_s(arguments.step_us), &options)?)
    } else {
        None
    };
    let summary = match arguments.scalar {
        Scalar::F32 => write::<f32>(&parameters, arguments, pacer.as_mut())?,
        Scalar::F64 => write::<f64>(&parameters, arguments, pacer.as_mut())?,
    };
    let report = Report {
        ticks: summary.ticks,
        step_s: step_s(arguments.step_us),
        force_rms_n: summary.force_rms_n,
        max_extension_force_n: summary.max_extension_force_n,
        max_compression_force_n: summary.max_compression_force_n,
        energy_j: summary.energy_j,
        rejected_inputs: summary.rejected_inputs,
        input_held: summary.status.contains(Status::INPUT_HELD),
        input_limited: summary.status.contains(Status::INPUT_LIMITED),
        saturated: summary.status.contains(Status::SATURATED),
        realtime: pacer.as_ref().map(|pacer| Realtime {
            missed_deadlines: pacer.report().missed_deadlines,
            lateness: pacer.report().lateness.figures(),
            work: pacer.report().work.figures(),
        }),
    };
    print_report(arguments.format, &report, |out, report| {
        print(out, report, arguments)
    })
}

fn same_file(a: &std::path::Path, b: &std::path::Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

fn write<T: Real + Serialize>(
    parameters: &DamperParameters,
    arguments: &ReplayArguments,
    pacer: Option<&mut Pacer>,
) -> Outcome<Summary> {
    let damper = parameters.build::<T>(step_s(arguments.step_us))?;
    let length = std::fs::metadata(&arguments.input).map_or(0, |data| data.len());
    let bar = progress::bar(length, "replay");
    let mut ticks = Ticks::new(
        Recording::open(&arguments.input)?,
        step_s(arguments.step_us),
    )?;
    let mut summary = None;
    write_whole(&arguments.output, |file| {
        let failed = |error: csv::Error| {
            Failure::in_file(&arguments.output, format!("cannot write: {error}"))
        };
        let mut rows = csv::Writer::from_writer(file);
        rows.write_record(["time_s", "displacement_m", "force_n"])
            .map_err(failed)?;
        let mut number = 0_u32;
        summary = Some(replay(&damper, &mut ticks, pacer, |tick, force, ticks| {
            number = number.wrapping_add(1);
            if number.is_multiple_of(65_536) {
                bar.set_position(ticks.position());
            }
            rows.serialize((whole_us(tick.time_s), tick.displacement_m, force))
                .map_err(failed)
        })?);
        rows.flush().map_err(|error| failed(error.into()))
    })?;
    bar.finish_and_clear();
    summary.ok_or_else(|| Failure::new("nothing was replayed"))
}

/// The nearest whole microsecond (s), free of the rounding of sums.
fn whole_us(time_s: f64) -> f64 {
    (time_s * 1e6).round() / 1e6
}

fn print(out: &mut dyn Write, report: &Report, arguments: &ReplayArguments) -> io::Result<()> {
    writeln!(
        out,
        "{} ticks of {} us through damper {}",
        report.ticks, arguments.step_us, arguments.damper.damper
    )?;
    for (name, value, unit) in [
        ("force rms", report.force_rms_n, "N"),
        ("largest in extension", report.max_extension_force_n, "N"),
        (
            "largest in compression",
            report.max_compression_force_n,
            "N",
        ),
        ("energy dissipated", report.energy_j, "J"),
    ] {
        writeln!(out, "{name:<22} {value:>12.1} {unit}")?;
    }
    if report.input_limited {
        writeln!(
            out,
            "warning: {} ticks moved faster than limits.rate_m_per_s and were followed at that rate",
            report.rejected_inputs
        )?;
    }
    if report.saturated {
        writeln!(
            out,
            "note: the damper reached its saturation force or force limit"
        )?;
    }
    if let Some(realtime) = &report.realtime {
        writeln!(
            out,
            "real ticks: {} deadlines missed; late by {} at most, {} at the 99th percentile; step {} at most",
            realtime.missed_deadlines,
            span(realtime.lateness.worst_ns),
            optional_span(realtime.lateness.p99_ns),
            span(realtime.work.worst_ns)
        )?;
    }
    writeln!(out, "wrote {}", arguments.output.display())
}
