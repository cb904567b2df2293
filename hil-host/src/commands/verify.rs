//! `dashpot verify`: the fixed step against the reference solver on a recorded motion.

use std::io::{self, Write};
use std::path::PathBuf;
use std::rc::Rc;

use serde::Serialize;

use super::gap_report::write_gaps;
use super::recording::MotionArguments;
use super::step_size::{self, StepSize};
use super::{DamperArguments, Format, counted, print_report, progress};
use crate::commands::failure::{Failure, Outcome};
use crate::files::input;
use crate::files::recording::{Gaps, Recording};
use crate::study::Scalar;
use crate::study::tick_grid::TickGrid;
use crate::study::verification::{
    Deviation, deviation, fixed_step_forces, reference_forces, reference_forces_on_recording,
};

/// Accuracy of the fixed step against the adaptive reference solver, per step size.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot verify --damper paper --input data/excitations/ride_made.csv
  dashpot verify --damper in-service --input run7.csv --step-us 1000 --step-us 62.5 --format json

The NRMSE on ticks is the error of the step: the reference follows the same displacements at the ticks, linear between
them. The NRMSE on the recording holds what taking ticks from the recording leaves out, too: the reference follows the
recording's own samples, linear between them, and is compared at the ticks.")]
pub struct VerifyArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Recorded motion: text (CSV), MDF4 or Parquet; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
    #[command(flatten)]
    recording: MotionArguments,
    /// Steps, us.
    #[arg(help = step_size::help("Step to verify", "; may be given several times"), long, default_values = ["1000", "500", "100"], value_name = "US", allow_negative_numbers = true)]
    step_us: Vec<StepSize>,
    /// Fail when an NRMSE on ticks is above this.
    #[arg(long, value_name = "NRMSE", value_parser = positive, allow_negative_numbers = true)]
    at_most: Option<f64>,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Row {
    scalar: Scalar,
    #[serde(skip)]
    step: StepSize,
    /// On ticks.
    #[serde(flatten)]
    deviation: Deviation,
    nrmse_on_recording: f64,
    rejected_inputs: u16,
}

#[derive(Serialize)]
struct Report {
    deviations: Vec<Row>,
    gaps: Gaps,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if number > 0.0 && f64::is_finite(number) => Ok(number),
        _ => Err("allowed: a number above 0".into()),
    }
}

/// Runs the command.
///
/// # Errors
/// A damper or recording that cannot be used, a reference that fails, or an NRMSE above `--at-most`.
pub fn run(arguments: &VerifyArguments) -> Outcome<()> {
    arguments.damper.refuse_same_input(&arguments.input)?;
    let parameters = arguments.damper.load()?;
    let mut recording = Recording::open_with(&arguments.input, &arguments.recording.channels())?;
    let samples = Rc::new(recording.read_all()?);
    let path = input::name(&arguments.input);
    let gaps = recording.gaps();
    let bar = progress::bar(arguments.step_us.len() as u64, "verify");
    let mut rows = Vec::new();
    for &step in &arguments.step_us {
        let step_s = step.step_s();
        let ticks =
            TickGrid::new(Recording::again(&path, Rc::clone(&samples)), step_s)?.read_all()?;
        let displacements_m: Vec<f64> = ticks.iter().map(|tick| tick.displacement_m).collect();
        let on_ticks = reference_forces(&parameters, step_s, &displacements_m)?;
        let on_recording = reference_forces_on_recording(&parameters, step_s, &samples, &ticks)?;
        for (scalar, fixed) in [
            (
                Scalar::F32,
                fixed_step_forces::<f32>(&parameters, step_s, &displacements_m)?,
            ),
            (
                Scalar::F64,
                fixed_step_forces::<f64>(&parameters, step_s, &displacements_m)?,
            ),
        ] {
            rows.push(Row {
                scalar,
                step,
                deviation: deviation(step_s, &fixed.forces_n, &on_ticks)?,
                nrmse_on_recording: deviation(step_s, &fixed.forces_n, &on_recording)?.nrmse,
                rejected_inputs: fixed.rejected_inputs,
            });
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let report = Report {
        deviations: rows,
        gaps,
    };
    print_report(arguments.format, &report, |out, report| {
        print(out, report, arguments)
    })?;
    let worst = report
        .deviations
        .iter()
        .map(|row| row.deviation.nrmse)
        .fold(0.0, f64::max);
    match arguments.at_most {
        Some(limit) if worst > limit => Err(Failure::new(format!(
            "NRMSE on ticks {worst:.2e} is above --at-most {limit:.2e}"
        ))),
        _ => Ok(()),
    }
}

fn print(out: &mut dyn Write, report: &Report, arguments: &VerifyArguments) -> io::Result<()> {
    writeln!(
        out,
        "damper {} on {}, fixed step against the adaptive reference\n\n  \
         {:>9}  {:<6}  {:>14}  {:>18}  {:>12}  {:>9}  {:>6}",
        arguments.damper.damper,
        input::name(&arguments.input).display(),
        "step us",
        "scalar",
        "NRMSE on ticks",
        "NRMSE on recording",
        "largest/peak",
        "largest N",
        "rms N"
    )?;
    for row in &report.deviations {
        let deviation = &row.deviation;
        writeln!(
            out,
            "  {:>9}  {:<6}  {:>14.2e}  {:>18.2e}  {:>12.2e}  {:>9.2}  {:>6.0}",
            row.step.step_us(),
            row.scalar,
            deviation.nrmse,
            row.nrmse_on_recording,
            deviation.largest_error_over_peak,
            deviation.largest_error_n,
            deviation.reference_rms_n
        )?;
    }
    writeln!(
        out,
        "\non ticks: both follow the displacements at the ticks. On recording: the reference follows the \
         recording's own\nsamples, so that what the ticks leave out of the motion counts too."
    )?;
    let rejected = report.deviations.iter().map(|row| row.rejected_inputs);
    if let Some(most) = rejected.max().filter(|most| *most > 0) {
        writeln!(
            out,
            "warning: input held or limited at up to {}; there the step followed another motion than the \
             reference",
            counted(most.into(), "tick")
        )?;
    }
    write_gaps(out, &report.gaps)
}
