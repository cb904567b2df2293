//! `dashpot` without a command: runs the demo.

mod cost;
mod description;
mod figures;
mod live;
mod page;
mod recording;
mod results;

use std::io::{self, Write};
use std::path::PathBuf;

use results::Accuracy;
use serde::Serialize;

use super::{Format, print_report_beside, progress};
use crate::commands::failure::Outcome;
use dashpot_files::output::{self, write_bytes};

/// The demo: two presets on a synthetic ride, with accuracy, cost and a page.
#[derive(Debug, Clone, clap::Args)]
pub struct DemonstrateArguments {
    /// Page, a self-contained HTML file; `-` for standard output.
    #[arg(long, default_value = "dashpot-report.html", value_name = "FILE")]
    pub output: PathBuf,
    /// Output format of the results.
    // Not `format`: `dashpot link` has an option of that name for all its actions, which would count as this one.
    #[arg(id = "demonstration_format", long = "format", value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

#[derive(Serialize)]
struct Report {
    accuracy: Vec<Accuracy>,
    page: String,
}

/// Runs the demo, prints its results and writes its page.
///
/// # Errors
/// The reference does not reach its tolerance, or the page cannot be written.
pub fn run(arguments: &DemonstrateArguments) -> Outcome<()> {
    let bar = progress::bar(results::WORK, "");
    let shown = results::run(|work, done| {
        bar.set_position(done);
        bar.set_message(work);
    })?;
    let page = page::write(&shown)?;
    let path = &arguments.output;
    write_bytes(path, page.as_bytes())?;
    bar.finish_and_clear();
    let report = Report {
        accuracy: shown.accuracy,
        page: output::name(path).display().to_string(),
    };
    print_report_beside(path, arguments.format, &report, print)
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "locomotive damper on a synthetic ride, fixed step compared with reference\n\n  \
         {:<12}{:>10}{:>11}{:>23}{:>10}{:>22}{:>16}",
        "damper",
        "rate, kHz",
        "precision",
        "rms error / rms force",
        "limit",
        "max error / peak",
        "median ns/step"
    )?;
    for row in &report.accuracy {
        writeln!(
            out,
            "  {:<12}{:>10.0}{:>11}{:>23.2e}{:>10}{:>22.2e}{:>16.0}{}",
            row.damper,
            1e-3 / row.step_s,
            row.scalar,
            row.nrmse,
            row.nrmse_limit
                .map_or_else(|| "-".into(), |limit| format!("{limit:.0e}")),
            row.largest_error_over_peak,
            row.median_ns_per_step,
            if row.over_limit() { "  over" } else { "" }
        )?;
    }
    writeln!(out, "\npage: {}", report.page)
}
