//! `dashpot verify`: compares the fixed step with the reference solver, on a recording or over a fixed set of motions.

mod probed;
mod recorded;

use std::path::PathBuf;

use super::recording::MotionArguments;
use super::step_size::{self, StepSize};
use super::{DamperArguments, Format};
use crate::commands::failure::{Failure, Outcome};

/// Measure the accuracy of the fixed step against the adaptive reference solver for each step size.
///
/// With --input, the motion is a recording. Without it, the command prints the largest errors of this damper over a
/// fixed set of motions.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot verify --damper in-service
  dashpot verify --damper mine.toml --rate-hz 2000 --format json
  dashpot verify --damper paper --input data/excitations/ride_made.csv
  dashpot verify --damper in-service --input run7.csv --step-us 1000 --step-us 62.5 --format json

Without --input, the damper follows about a hundred motions scaled by its clearance, friction, springs and force limit:
sawtooth, move and stop, crossing of the clearance, changing speed, random ride, speed ramp, hold for a minute. For
every motion of the class defined in docs/numerics.md, each error is guaranteed to be at most three times its printed
value.

With --input, two errors are printed. The NRMSE on ticks is the error of the step alone: the reference follows the same
displacements at the ticks, interpolated linearly. The NRMSE on the recording also includes the effect of resampling:
the reference follows the recording's own samples, interpolated linearly, and is compared at the ticks.")]
pub struct VerifyArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Recorded motion: text (CSV), MDF4 or Parquet; `-` for standard input. Without it, a fixed set of motions is
    /// used.
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    #[command(flatten)]
    recording: MotionArguments,
    /// Steps, us.
    #[arg(
        help = step_size::help(
            "Step to verify",
            "; may be repeated [default: 1000, 500 and 100 with --input, otherwise 1000 and 100]"
        ),
        long,
        value_name = "US",
        allow_negative_numbers = true
    )]
    step_us: Vec<StepSize>,
    /// Rate to verify, Hz: the step is its inverse. May be repeated and combined with --step-us.
    #[arg(long, value_name = "HZ", value_parser = rate, allow_negative_numbers = true)]
    rate_hz: Vec<StepSize>,
    /// Top speed of the motions without --input, m/s [default: 0.6, but at most the damper's limits.rate_m_per_s].
    #[arg(long, value_name = "V", value_parser = positive, allow_negative_numbers = true, conflicts_with = "input")]
    top_speed_m_per_s: Option<f64>,
    /// Fail if an NRMSE on ticks is above this value.
    #[arg(long, value_name = "NRMSE", value_parser = positive, allow_negative_numbers = true)]
    at_most: Option<f64>,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if number > 0.0 && f64::is_finite(number) => Ok(number),
        _ => Err("allowed: a number above 0".into()),
    }
}

fn rate(text: &str) -> Result<StepSize, String> {
    let hertz: Option<f64> = text.parse().ok();
    let step = hertz.and_then(|hertz| StepSize::from_us(1e6 / hertz));
    step.ok_or_else(|| "allowed: 50 to 1e6 Hz".into())
}

impl VerifyArguments {
    /// Returns the requested steps without duplicates; `default_us` (us) if there are none.
    fn steps(&self, default_us: &[f64]) -> Vec<StepSize> {
        let mut steps = self.step_us.clone();
        if steps.is_empty() {
            steps.extend(default_us.iter().filter_map(|us| StepSize::from_us(*us)));
        }
        for rate in &self.rate_hz {
            if !steps.contains(rate) {
                steps.push(*rate);
            }
        }
        steps
    }

    /// Fails if `worst`, described by `what`, is above `--at-most`.
    fn judge(&self, what: &str, worst: f64) -> Outcome<()> {
        match self.at_most {
            Some(limit) if worst.is_nan() || worst > limit => Err(Failure::new(format!(
                "{what} {worst:.2e} is above --at-most {limit:.2e}"
            ))),
            _ => Ok(()),
        }
    }
}

/// Runs the command.
///
/// # Errors
/// The damper or recording cannot be used, the reference fails, or an NRMSE is above `--at-most`.
pub fn run(arguments: &VerifyArguments) -> Outcome<()> {
    match &arguments.input {
        Some(input) => recorded::run(arguments, input),
        None if arguments.recording != MotionArguments::default() => Err(Failure::wrong_use(
            "options for reading a recording require --input FILE",
        )),
        None => probed::run(arguments),
    }
}
