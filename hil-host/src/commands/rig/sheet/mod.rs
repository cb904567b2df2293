//! `dashpot rig --sheet`: runs the tests of a sheet and checks its limits.

mod figures;
mod page;
mod report;

use std::path::Path;

use report::Report;

use super::RigArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::{print_report_beside, streams};
use dashpot_files::output::write_bytes;
use dashpot_files::sheet::SheetParameters;
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
    let report = Report::new(arguments, &sheet, &tested);
    if let Some(path) = &arguments.page {
        let page = page::write(&report, &tested)?;
        write_bytes(path, page.as_bytes())?;
    }
    let data = arguments.page.as_deref().unwrap_or(Path::new(""));
    print_report_beside(data, arguments.format, &report, Report::print)?;
    match report.limits_not_kept {
        0 => Ok(()),
        _ => Err(Failure::new(report.verdict())),
    }
}
