//! `dashpot verify`: the fixed step against the reference solver on a recorded motion.

use std::io::{self, Write};
use std::path::PathBuf;

use serde::Serialize;

use super::{DamperArguments, Format, print_report, progress, step_s};
use crate::failure::{Failure, Outcome};
use crate::recording::Recording;
use crate::replay::Ticks;
use crate::verification::{Deviation, deviation, fixed_step_forces, reference_forces};

/// Accuracy of the fixed step against the adaptive reference solver, per step size.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot verify --damper paper --input data/excitations/ride_made.csv
  dashpot verify --damper in-service --input run7.csv --step-us 1000 --step-us 250 --format json")]
pub struct VerifyArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Recorded motion, CSV with columns time_s,displacement_m.
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
    /// Step to verify, us; may be given several times.
    #[arg(long, default_values_t = [1000, 500, 100],
        value_parser = clap::value_parser!(u32).range(1..=20_000))]
    step_us: Vec<u32>,
    /// Fail when an NRMSE is above this.
    #[arg(long, value_name = "NRMSE")]
    at_most: Option<f64>,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Row {
    scalar: &'static str,
    #[serde(flatten)]
    deviation: Deviation,
}

#[derive(Serialize)]
struct Report {
    deviations: Vec<Row>,
}

/// Runs the command.
///
/// # Errors
/// A damper or recording that cannot be used, a reference that fails, or an NRMSE above `--at-most`.
pub fn run(arguments: &VerifyArguments) -> Outcome<()> {
    let parameters = arguments.damper.load()?;
    let bar = progress::bar(arguments.step_us.len() as u64, "verify");
    let mut rows = Vec::new();
    for &step_us in &arguments.step_us {
        let step_s = step_s(step_us);
        let ticks = Ticks::new(Recording::open(&arguments.input)?, step_s)?;
        let displacements_m = ticks.displacements_m()?;
        let reference = reference_forces(&parameters, step_s, &displacements_m)?;
        for (scalar, forces) in [
            (
                "f32",
                fixed_step_forces::<f32>(&parameters, step_s, &displacements_m)?,
            ),
            (
                "f64",
                fixed_step_forces::<f64>(&parameters, step_s, &displacements_m)?,
            ),
        ] {
            rows.push(Row {
                scalar,
                deviation: deviation(step_s, &forces, &reference)?,
            });
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let report = Report { deviations: rows };
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
            "NRMSE {worst:.2e} is above --at-most {limit:.2e}"
        ))),
        _ => Ok(()),
    }
}

fn print(out: &mut dyn Write, report: &Report, arguments: &VerifyArguments) -> io::Result<()> {
    writeln!(
        out,
        "damper {} on {}, fixed step against the adaptive reference\n  \
         step us  scalar      NRMSE  largest/peak  largest N   rms N",
        arguments.damper.damper,
        arguments.input.display()
    )?;
    for Row { scalar, deviation } in &report.deviations {
        writeln!(
            out,
            "{:>9.0}  {scalar:<6}  {:>9.2e}  {:>12.2e}  {:>9.2}  {:>6.0}",
            deviation.step_s * 1e6,
            deviation.nrmse,
            deviation.largest_error_over_peak,
            deviation.largest_error_n,
            deviation.reference_rms_n
        )?;
    }
    Ok(())
}
