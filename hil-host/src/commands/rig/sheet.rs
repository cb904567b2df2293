//! `dashpot rig --sheet`: runs the tests of a sheet and checks its limits.

use std::path::Path;

use super::RigArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::{Format, print_report_beside, streams};
use dashpot_files::output::{self, write_bytes};
use dashpot_files::sheet::SheetParameters;
use dashpot_report::sheet::SheetReport;
use dashpot_testbench::bench_sheet;

/// Runs the sheet called `name`, prints it and writes its page.
///
/// # Errors
/// The sheet, the damper or a file is invalid, or a limit is violated.
pub(super) fn run(arguments: &RigArguments, name: &str) -> Outcome<()> {
    let damper_name = &arguments.damper.damper;
    let read = [
        ("--damper", Path::new(damper_name)),
        ("--sheet", Path::new(name)),
    ];
    streams::refuse_second_standard_input(&read)?;
    if let Some(page) = &arguments.page {
        for (_, path) in read {
            streams::refuse_input("--page", page, path)?;
        }
    }
    let sheet = SheetParameters::load(name)?;
    let damper = arguments.damper.load()?;
    let tested = bench_sheet::run(&sheet, damper_name, &damper, arguments.step_us.step_s())?;
    let overrides = &arguments.damper.overrides;
    let mut report = SheetReport::computed(&sheet, damper_name, overrides, &tested);
    publish(&mut report, arguments.page.as_deref(), arguments.format)
}

/// Writes the page of a report, and prints the report.
///
/// # Errors
/// The page or the report cannot be written, or the verdict is not good.
pub(in crate::commands) fn publish(
    report: &mut SheetReport,
    page: Option<&Path>,
    format: Format,
) -> Outcome<()> {
    if let Some(path) = page {
        write_bytes(path, report.to_html()?.as_bytes())?;
        report.page = Some(output::name(path).display().to_string());
    }
    let data = page.unwrap_or(Path::new(""));
    print_report_beside(data, format, report, |out, report| {
        SheetReport::print(out, report)
    })?;
    match report.verdict.is_good() {
        true => Ok(()),
        false => Err(Failure::new(report.summary())),
    }
}
