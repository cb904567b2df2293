//! `dashpot` without a command: the demonstration.

use std::io::Write;
use std::path::PathBuf;

use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::Format;
use crate::demonstration::{self, Accuracy, Demonstration, WORK};
use crate::failure::{Failure, Outcome};
use crate::output::write_whole;

/// The demonstration: two presets on the shipped ride, accuracy, cost, and a page that shows them.
#[derive(Debug, Clone, clap::Args)]
pub struct DemonstrateArguments {
    /// The page, one self-contained HTML file.
    #[arg(long, default_value = "dashpot-report.html", value_name = "FILE")]
    pub output: PathBuf,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

#[derive(Serialize)]
struct Report<'a> {
    accuracy: &'a [Accuracy],
    page: String,
}

/// Runs the demonstration, prints its figures and writes its page.
///
/// # Errors
/// The reference does not reach its tolerance, or the page cannot be written.
pub fn run(arguments: &DemonstrateArguments) -> Outcome<()> {
    // Drawn on a terminal only.
    let bar = ProgressBar::new(WORK + 1);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len}  {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    let mut begun = false;
    let shown = demonstration::run(|work| {
        if std::mem::replace(&mut begun, true) {
            bar.inc(1);
        }
        bar.set_message(work);
    })?;
    bar.inc(1);
    bar.set_message("page");
    let page = demonstration::page(&shown)?;
    let path = &arguments.output;
    write_whole(path, |file| {
        file.write_all(page.as_bytes())
            .map_err(|error| Failure::in_file(path, format!("cannot write: {error}")))
    })?;
    bar.finish_and_clear();
    let mut out = std::io::stdout().lock();
    let printed = match arguments.format {
        Format::Text => print(&mut out, &shown, &path.display().to_string()),
        Format::Json => {
            let report = Report {
                accuracy: &shown.accuracy,
                page: path.display().to_string(),
            };
            serde_json::to_writer_pretty(&mut out, &report)
                .map_err(std::io::Error::from)
                .and_then(|()| writeln!(out))
        }
    };
    printed.map_err(|error| Failure::new(format!("cannot print: {error}")))
}

fn print(out: &mut impl Write, shown: &Demonstration, page: &str) -> std::io::Result<()> {
    writeln!(
        out,
        "locomotive damper on a made ride, fixed step against reference\n\n  {:<12}{:>10}{:>11}{:>23}{:>10}{:>22}{:>16}",
        "damper",
        "rate, kHz",
        "precision",
        "rms error / rms force",
        "limit",
        "largest error / peak",
        "median ns/step"
    )?;
    for row in &shown.accuracy {
        writeln!(
            out,
            "  {:<12}{:>10.0}{:>11}{:>23.2e}{:>10.0e}{:>22.2e}{:>16.0}{}",
            row.damper,
            1e-3 / row.step_s,
            row.scalar,
            row.nrmse,
            row.nrmse_limit,
            row.largest_error_over_peak,
            row.median_ns_per_step,
            if row.over_limit() { "  over" } else { "" }
        )?;
    }
    writeln!(out, "\npage: {page}")
}
