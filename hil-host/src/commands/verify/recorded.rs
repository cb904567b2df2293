//! Comparison of the fixed step with the reference solver on a recorded motion.

use std::io::{self, Write};
use std::path::Path;
use std::rc::Rc;

use serde::Serialize;

use super::VerifyArguments;
use crate::commands::failure::Outcome;
use crate::commands::gap_report::write_gaps;
use crate::commands::{counted, print_report, progress};
use dashpot_files::input;
use dashpot_recording::{Gaps, Recording};
use dashpot_report::rounded::microseconds;
use dashpot_testbench::verification::{RecordedError, on_recording};

#[derive(Serialize)]
struct Report {
    deviations: Vec<RecordedError>,
    gaps: Gaps,
}

/// Default steps (us).
const STEPS_US: [f64; 3] = [1000.0, 500.0, 100.0];

/// Runs the command on the recording `input`.
///
/// # Errors
/// The damper or recording cannot be used, the reference fails, or an NRMSE is above `--at-most`.
pub(super) fn run(arguments: &VerifyArguments, input: &Path) -> Outcome<()> {
    arguments.damper.refuse_same_input(input)?;
    let parameters = arguments.damper.load()?;
    let mut recording = Recording::open_with(input, &arguments.recording.channels())?;
    let samples = Rc::new(recording.read_all()?);
    let path = input::name(input);
    let gaps = recording.gaps();
    let steps = arguments.steps(&STEPS_US);
    let bar = progress::bar(steps.len() as u64, "verify");
    let mut rows = Vec::new();
    for step in steps {
        let step_s = step.step_s();
        let recording = Recording::from_samples(&path, Rc::clone(&samples));
        rows.extend(on_recording(&parameters, recording, &samples, step_s)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let report = Report {
        deviations: rows,
        gaps,
    };
    print_report(arguments.format, &report, |out, report| {
        print(out, report, &arguments.damper.damper, &path)
    })?;
    let worst = report
        .deviations
        .iter()
        .map(|row| row.deviation.nrmse)
        .max_by(f64::total_cmp)
        .unwrap_or(0.0);
    arguments.judge("NRMSE on ticks", worst)
}

fn print(out: &mut dyn Write, report: &Report, damper: &str, path: &Path) -> io::Result<()> {
    writeln!(
        out,
        "damper {} on {}, fixed step against the adaptive reference\n\n  \
         {:>9}  {:<6}  {:>14}  {:>18}  {:>12}  {:>9}  {:>6}",
        damper,
        path.display(),
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
            microseconds(deviation.step_s),
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
        "\nOn ticks: both follow the displacements at the ticks. On recording: the reference follows the \
         recording's own\nsamples, so the error also includes the effect of resampling."
    )?;
    let rejected = report.deviations.iter().map(|row| row.rejected_inputs);
    if let Some(max) = rejected.max().filter(|max| *max > 0) {
        writeln!(
            out,
            "warning: input held or rate-limited at up to {}; at these ticks the step and the reference followed \
             different motions",
            counted(max.into(), "tick")
        )?;
    }
    write_gaps(out, &report.gaps)
}
