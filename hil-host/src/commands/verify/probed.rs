//! The largest errors of the fixed step for one damper over the fixed set of motions.

use std::io::{self, Write};

use dashpot_reference::probing::{LargestErrors, MIN_RMS_FORCE_RATIO, PROMISED_FACTOR, Worst};
use serde::Serialize;

use super::VerifyArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::step_size::StepSize;
use crate::commands::{print_report, progress};
use dashpot_files::Scalar;
use dashpot_testbench::step_errors::{SCALARS, StepErrors};

/// Default steps (us): 1 kHz and 10 kHz.
const STEPS_US: [f64; 2] = [1000.0, 100.0];

/// The largest errors at one step size in one scalar.
#[derive(Serialize)]
struct Row {
    scalar: Scalar,
    step_s: f64,
    #[serde(skip)]
    step: StepSize,
    nrmse: f64,
    nrmse_motion: Named,
    largest_error_n: f64,
    largest_error_over_limit: f64,
    largest_error_motion: Named,
    largest_wrong_sign_n: f64,
    promised_nrmse: f64,
    promised_error_n: f64,
}

/// A motion by what it does and how fast.
#[derive(Serialize)]
struct Named {
    kind: &'static str,
    speed_m_per_s: f64,
}

impl Named {
    fn of(worst: &Worst) -> Self {
        Self {
            kind: worst.kind.name(),
            speed_m_per_s: worst.speed_m_per_s,
        }
    }
}

#[derive(Serialize)]
struct Report {
    top_speed_m_per_s: f64,
    force_limit_n: f64,
    promised_factor: f64,
    errors: Vec<Row>,
}

/// Runs the command over the fixed set.
///
/// # Errors
/// A damper that cannot be used, a reference that fails, or an NRMSE above `--at-most`.
pub(super) fn run(arguments: &VerifyArguments) -> Outcome<()> {
    let parameters = arguments.damper.load()?;
    let rate_m_per_s = parameters.limits.rate_m_per_s;
    if let Some(speed) = arguments
        .top_speed_m_per_s
        .filter(|speed| *speed > rate_m_per_s)
    {
        return Err(Failure::wrong_use(format!(
            "--top-speed-m-per-s {speed}: allowed: up to the damper's limits.rate_m_per_s = {rate_m_per_s} m/s"
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
        let largest = errors.largest(dashpot_workers::threads())?;
        let promised = errors.promised(&largest);
        report.top_speed_m_per_s = errors.top_speed_m_per_s();
        report.force_limit_n = errors.force_limit_n();
        for ((scalar, largest), promised) in SCALARS.into_iter().zip(&largest).zip(promised) {
            let row = Row::new(scalar, step, largest, promised, report.force_limit_n);
            report.errors.push(row);
        }
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

impl Row {
    fn new(
        scalar: Scalar,
        step: StepSize,
        largest: &LargestErrors,
        (promised_error_n, promised_nrmse): (f64, f64),
        force_limit_n: f64,
    ) -> Self {
        Self {
            scalar,
            step_s: step.step_s(),
            step,
            nrmse: largest.nrmse.value,
            nrmse_motion: Named::of(&largest.nrmse),
            largest_error_n: largest.largest_n.value,
            largest_error_over_limit: largest.largest_n.value / force_limit_n,
            largest_error_motion: Named::of(&largest.largest_n),
            largest_wrong_sign_n: largest.wrong_sign_n.value,
            promised_nrmse,
            promised_error_n,
        }
    }
}

fn print(out: &mut dyn Write, report: &Report, damper: &str) -> io::Result<()> {
    writeln!(
        out,
        "damper {damper}, fixed step against the adaptive reference: the largest errors over a fixed set of motions\n\
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
        let motion = |named: &Named| format!("{} at {:.3} m/s", named.kind, named.speed_m_per_s);
        writeln!(
            out,
            "  {:>9}  {:<6}  {:>8.1e}  {:<36}  {:>9.2}  {:>8.1e}  {:<36}  {:>12.2}",
            row.step.step_us(),
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
        "\nNRMSE: rms error over rms force, or over {} % of the force limit where that is more, of the worst motion. \
         Largest: of one\ntick. Wrong sign: the largest force at a tick where the reference has one of the other sign, \
         or none.\nPromised for every motion of the class in docs/numerics.md: {} times NRMSE and largest.",
        100.0 * MIN_RMS_FORCE_RATIO,
        report.promised_factor
    )
}
