//! `dashpot replay`: computes the force over a recorded motion.

mod causes;
mod health;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use dashpot_core::CheckedParameters;
use dashpot_testbench::compiled::Compiled;
use serde::Serialize;

use super::gap_report::write_gaps;
use super::named_values;
use super::paced::Paced;
use super::recording::MeasurementArguments;
use super::step_size::{self, StepSize};
use super::{
    DamperArguments, Format, RealtimeArguments, counted, nearest_nanosecond, print_report_beside,
    progress, streams,
};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::Scalar;
use dashpot_files::input;
use dashpot_files::output::{self, cannot_write, write_whole, write_whole_if};
use dashpot_realtime::pacing::Pacer;
use dashpot_recording::tick_grid::TickGrid;
use dashpot_recording::writer::{Column, FileFormat, RowWriter};
use dashpot_recording::{Gaps, Recording};
use dashpot_testbench::replay::{Summary, replay};
use health::{HealthArguments, HealthReport};

/// Output columns.
const COLUMNS: [Column; 3] = [
    Column::new("time_s", "s"),
    Column::new("displacement_m", "m"),
    Column::new("force_n", "N"),
];

/// Compute the force of a damper over a recorded motion.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot replay --damper paper --input data/excitations/ride_made.csv --output force.csv
  dashpot replay --damper my.toml --set mount.clearance_m=1e-3 --input run7.csv --output f.csv
  dashpot replay --input run7.csv --output f.csv --realtime --fifo 80 --lock-memory --core 1
  dashpot replay --input run7.mf4 --group 2 --displacement Weg --output force.mf4
  dashpot replay --damper in-service --input run8.mf4 --output f.csv --health health.html
  dashpot replay --input messung.csv.gz --time Zeit --displacement Weg --displacement-unit mm --output - | head

`dashpot channels FILE` lists the channels and the matching options. Sampling may be uneven, and other channels are
ignored. Text may use any separator, decimal commas and a unit row; UTF-8, UTF-16, Windows-1252 and gzip compression
are detected.
With --health, the recording must also contain the measured force. Flow, stiffness and clearance of the recorded
damper are then estimated relative to --damper (docs/health.md).
Output columns: time_s,displacement_m,force_n at ticks from the first sample on. The displacement is interpolated
linearly between samples.")]
pub struct ReplayArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Recorded motion: text (CSV), MDF4 or Parquet; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
    #[command(flatten)]
    recording: MeasurementArguments,
    /// Force over time: CSV, or Parquet (.parquet) or MDF4 (.mf4) by extension; no partial file is left after an
    /// error; `-` writes CSV to standard output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// Step, us.
    #[arg(help = step_size::help("Step", ""), 
        long,
        default_value = "1000",
        value_name = "US",
        allow_negative_numbers = true
    )]
    step_us: StepSize,
    /// Floating-point type of the step.
    #[arg(long, value_parser = named_values::scalar(), default_value_t = Scalar::F32)]
    scalar: Scalar,
    /// Replay in real time and report lateness and missed deadlines; exit code 1 if more than one deadline in a
    /// thousand is missed.
    #[arg(long)]
    realtime: bool,
    #[command(flatten)]
    options: RealtimeArguments,
    #[command(flatten)]
    health: HealthArguments,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

impl ReplayArguments {
    /// Returns the input files.
    fn inputs(&self) -> impl Iterator<Item = &Path> {
        let damper = Path::new(&self.damper.damper);
        let inputs = [self.input.as_path(), damper].into_iter();
        inputs.chain(self.health.baseline())
    }
}

#[derive(Serialize)]
struct Report {
    ticks: u64,
    step_s: f64,
    force_rms_n: f64,
    max_extension_force_n: f64,
    max_compression_force_n: f64,
    energy_j: f64,
    rejected_inputs: u64,
    held_inputs: u64,
    limited_inputs: u64,
    restarts: u64,
    first_rejected_s: Option<f64>,
    saturated_ticks: u64,
    input_held: bool,
    input_limited: bool,
    saturated: bool,
    gaps: Gaps,
    #[serde(skip_serializing_if = "Option::is_none")]
    realtime: Option<Paced>,
    #[serde(skip_serializing_if = "Option::is_none")]
    health: Option<HealthReport>,
}

/// Runs the command.
///
/// # Errors
/// A damper, recording or output file cannot be used.
pub fn run(arguments: &ReplayArguments) -> Outcome<()> {
    arguments.damper.refuse_same_input(&arguments.input)?;
    if arguments.recording.has_force() && !arguments.health.is_wanted() {
        return Err(Failure::wrong_use(
            "--force, --force-unit and --reverse-force: only --health reads the measured force",
        ));
    }
    let parameters = arguments.damper.load()?;
    for input in arguments.inputs() {
        streams::refuse_input("--output", &arguments.output, input)?;
    }
    let options = arguments
        .options
        .options_under("--realtime", arguments.realtime)?;
    let health = health::Watched::estimate(arguments, &parameters)?;
    let mut pacer = if arguments.realtime {
        Some(Pacer::new(arguments.step_us.step_s(), &options)?)
    } else {
        None
    };
    let page = health.as_ref().map(health::Watched::page);
    let (summary, gaps) = write_whole_if(page.map(|(path, _)| path), |to_page| {
        if let (Some((path, to_page)), Some((_, text))) = (to_page, page) {
            let written = to_page.write_all(text.as_bytes());
            written.map_err(|error| cannot_write(path, error))?;
        }
        match arguments.scalar {
            Scalar::F32 => write::<f32>(&parameters, arguments, pacer.as_mut()),
            Scalar::F64 => write::<f64>(&parameters, arguments, pacer.as_mut()),
        }
    })?;
    let report = Report {
        ticks: summary.ticks,
        step_s: arguments.step_us.step_s(),
        force_rms_n: summary.force_rms_n,
        max_extension_force_n: summary.max_extension_force_n,
        max_compression_force_n: summary.max_compression_force_n,
        energy_j: summary.energy_j,
        rejected_inputs: summary.held_inputs + summary.limited_inputs + summary.restarts,
        held_inputs: summary.held_inputs,
        limited_inputs: summary.limited_inputs,
        restarts: summary.restarts,
        first_rejected_s: summary.first_rejected_s,
        saturated_ticks: summary.saturated_ticks,
        input_held: summary.held_inputs > 0,
        input_limited: summary.limited_inputs > 0,
        saturated: summary.saturated_ticks > 0,
        gaps,
        realtime: pacer.as_ref().map(|pacer| Paced::from(pacer.report())),
        health: health.map(health::Watched::report),
    };
    print_report_beside(
        &arguments.output,
        arguments.format,
        &report,
        |out, report| print(out, report, arguments, parameters.limits.rate_m_per_s),
    )?;
    pacer.map_or(Ok(()), |pacer| Ok(pacer.report().verdict()?))
}

fn write<T: Compiled + Serialize>(
    parameters: &CheckedParameters,
    arguments: &ReplayArguments,
    pacer: Option<&mut Pacer>,
) -> Outcome<(Summary, Gaps)> {
    let step_s = arguments.step_us.step_s();
    let damper = T::compiled_build(parameters, step_s)?;
    let bar = progress::bar(input::length(&arguments.input), "replay");
    let mut ticks = TickGrid::new(
        Recording::open_with(&arguments.input, &arguments.recording.channels())?,
        step_s,
    )?;
    let form = FileFormat::from_path(&arguments.output).map_err(Failure::wrong_use)?;
    let summary = write_whole::<_, Failure>(&arguments.output, |file| {
        let mut rows = RowWriter::new(&arguments.output, file, form, &COLUMNS)?;
        let mut number = 0_u32;
        let summary = replay(&damper, &mut ticks, pacer, |tick, force, ticks| {
            number = number.wrapping_add(1);
            if number.is_multiple_of(65_536) {
                bar.set_position(ticks.recording().position());
            }
            let time_s = nearest_nanosecond(tick.time_s);
            rows.row(
                &[time_s, tick.displacement_m, force.to_f64()],
                (time_s, tick.displacement_m, force),
            )
        })?;
        rows.finish()?;
        Ok(summary)
    })?;
    bar.finish_and_clear();
    Ok((summary, ticks.recording().gaps()))
}

fn print(
    out: &mut dyn Write,
    report: &Report,
    arguments: &ReplayArguments,
    rate_m_per_s: f64,
) -> io::Result<()> {
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
    if report.input_held {
        writeln!(
            out,
            "warning: input held at {}: not finite in single precision, farther from zero than \
             limits.displacement_m, or too large a jump to catch up with",
            counted(report.held_inputs, "tick")
        )?;
    }
    if report.input_limited {
        writeln!(
            out,
            "warning: input rate-limited at {}: faster than limits.rate_m_per_s = {rate_m_per_s}",
            counted(report.limited_inputs, "tick")
        )?;
    }
    if report.restarts > 0 {
        writeln!(
            out,
            "warning: the damper restarted at rest at {}: the displacement jump was too large to catch up with",
            counted(report.restarts, "tick")
        )?;
    }
    if let Some(first_s) = report.first_rejected_s {
        writeln!(
            out,
            "  first at {} s; forces and energy are those of the motion that the damper actually followed",
            nearest_nanosecond(first_s)
        )?;
    }
    write_gaps(out, &report.gaps)?;
    if report.saturated {
        writeln!(
            out,
            "note: the damper was at its saturation force or force limit at {}",
            counted(report.saturated_ticks, "tick")
        )?;
    }
    if let Some(realtime) = &report.realtime {
        realtime.write(out, "step, reading and writing of a tick")?;
    }
    if let Some(health) = &report.health {
        health.print(out)?;
    }
    writeln!(out, "wrote {}", output::name(&arguments.output).display())
}
