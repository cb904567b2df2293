//! `dashpot merge`: the rows of a study's shards together.

use std::path::PathBuf;
use std::time::Duration;

use super::print_report;
use super::sweep::{self, Report, ResultArguments, StudyArguments};
use crate::commands::failure::{Failure, Outcome};
use crate::files::output::create_folder;
use crate::study::sweep::{MergeError, merge, rows};

/// The rows of a study's shards together, checked against its list of cases, and its page.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:
  dashpot merge paper results/rows-*-of-8.csv --output results

Writes rows.csv and report.html, the same as `dashpot sweep` would have on one machine. What is missing or double is named, and nothing
is written then; exit code 1.")]
pub struct MergeArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Files of rows, those of `dashpot sweep --shard`.
    #[arg(required = true, value_name = "ROWS")]
    files: Vec<PathBuf>,
    /// Folder that results are written to [default: dashpot- and the name of the study].
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    #[command(flatten)]
    results: ResultArguments,
}

/// Runs the command.
///
/// # Errors
/// A study or rows that are refused; cases missing or double; files that cannot be written.
pub fn run(arguments: &MergeArguments) -> Outcome<()> {
    let results = &arguments.results;
    results.check()?;
    let study = arguments.study.read()?;
    results.check_figures(&study)?;
    let rows = merge(&study, &arguments.files)?;
    let folder = arguments.study.folder(arguments.output.as_ref());
    create_folder(&folder)?;
    let path = folder.join("rows.csv");
    rows::write(&study, &rows, &path)?;
    let mut report = Report::new(&study, &rows, 0, Duration::ZERO);
    report.files.push(path);
    results.write(&study, &rows, &folder, &mut report)?;
    print_report(results.format(), &report, sweep::print)
}

impl From<MergeError> for Failure {
    fn from(error: MergeError) -> Self {
        match error {
            MergeError::File(error) => error.into(),
            MergeError::Gaps(gaps) => Self::new(gaps.to_string()),
        }
    }
}
