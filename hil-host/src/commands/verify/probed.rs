//! Largest errors of the fixed step for one damper over the fixed set of motions.

use std::io::{self, Write};

use dashpot_reference::probing::{MIN_RMS_FORCE_RATIO, PROMISED_FACTOR};
use serde::Serialize;

use super::VerifyArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::{print_report, progress};
use dashpot_report::rounded::microseconds;
use dashpot_testbench::step_errors::{NamedMotion, StepErrorRow, StepErrors};

/// Default steps (us): 1 kHz and 10 kHz.
const STEPS_US: [f64; 2] = [1000.0, 100.0];

#[derive(Serialize)]
struct Report {
    top_speed_m_per_s: f64,
    force_limit_n: f64,
    promised_factor: f64,
    errors: Vec<StepErrorRow>,
}

/// Runs the command over the fixed set.
///
/// # Errors
/// The damper cannot be used, the reference fails, or an NRMSE is above `--at-most`.
pub(super) fn run(arguments: &VerifyArguments) -> Outcome<()> {
    let parameters = arguments.damper.load()?;
    let rate_m_per_s = parameters.limits.rate_m_per_s;
    if let Some(speed) = arguments
        .top_speed_m_per_s
        .filter(|speed| *speed > rate_m_per_s)
    {
        return Err(Failure::wrong_use(format!(
            "--top-speed-m-per-s {speed}: allowed: up to limits.rate_m_per_s = {rate_m_per_s} m/s of the damper"
        )));
    }
    let steps = arguments.steps(&STEPS_US);
    let bar = progress::bar(steps.len() as u64, "verify");
    let mut report = Report {
        top_speed_m_per_s: 0.0,
        force_limit_n: 0.0,
        promised_factor: PROMISED_FACTOR,
        errors: Vec::new(),
    };
    for step in steps {
        let errors = StepErrors::new(&parameters, step.step_s(), arguments.top_speed_m_per_s)?;
        report
            .errors
            .extend(errors.rows(dashpot_workers::threads())?);
        report.top_speed_m_per_s = errors.top_speed_m_per_s();
        report.force_limit_n = errors.force_limit_n();
        bar.inc(1);
    }
    bar.finish_and_clear();
    print_report(arguments.format, &report, |out, report| {
        print(out, report, &arguments.damper.damper)
    })?;
    let rows = report.errors.iter();
    let worst = rows.map(|row| row.nrmse).max_by(f64::total_cmp);
    arguments.judge("NRMSE", worst.unwrap_or(0.0))
}

fn print(out: &mut dyn Write, report: &Report, damper: &str) -> io::Result<()> {
    writeln!(
        out,
        "damper {damper}, fixed step against the adaptive reference: largest errors over a fixed set of motions\n\
         up to {:.3} m/s; force limit {:.0} N\n\n  \
         {:>9}  {:<6}  {:>8}  {:<36}  {:>9}  {:>8}  {:<36}  {:>12}",
        report.top_speed_m_per_s,
        report.force_limit_n,
        "step us",
        "scalar",
        "NRMSE",
        "in",
        "largest N",
        "of limit",
        "in",
        "wrong sign N"
    )?;
    for row in &report.errors {
        let motion =
            |named: &NamedMotion| format!("{} at {:.3} m/s", named.kind, named.speed_m_per_s);
        writeln!(
            out,
            "  {:>9}  {:<6}  {:>8.1e}  {:<36}  {:>9.2}  {:>8.1e}  {:<36}  {:>12.2}",
            microseconds(row.step_s),
            row.scalar,
            row.nrmse,
            motion(&row.nrmse_motion),
            row.largest_error_n,
            row.largest_error_over_limit,
            motion(&row.largest_error_motion),
            row.largest_wrong_sign_n
        )?;
    }
    writeln!(
        out,
        "\nNRMSE: rms error of the worst motion over the rms force, or over {} % of the force limit if that is \
         larger.\nLargest: largest error at a tick. Wrong sign: largest force at a tick where the reference force has \
         the opposite\nsign or is zero. Guaranteed for every motion of the class in docs/numerics.md: {} times NRMSE \
         and largest.",
        100.0 * MIN_RMS_FORCE_RATIO,
        report.promised_factor
    )
}
