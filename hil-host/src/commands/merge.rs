//! `dashpot merge`: the rows of a study's shards together.

use std::path::PathBuf;
use std::time::Duration;

use super::sweep::{self, Checked, Report, ResultArguments, StudyArguments};
use super::{interruption, print_report};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::output::create_folder;
use dashpot_study::sweep::rows::{self, Rows, RowsError};
use dashpot_study::sweep::{CheckError, MergeError, Study, check, choose, merge};

/// The rows of a study's shards together, checked against its list of cases, and its page.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot merge paper results/rows-*-of-8.csv --output results

  dashpot merge paper results/rows-*-of-8.csv --output results --check 5

Writes rows.csv and report.html, the same as `dashpot sweep` would have on one machine. What is missing or double is named, and nothing
is written then; exit code 1. --check runs random cases again before anything is written, and fails where a bit
differs.")]
pub struct MergeArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Files of rows, those of `dashpot sweep --shard`.
    #[arg(required = true, value_name = "ROWS")]
    files: Vec<PathBuf>,
    /// Folder that results are written to [default: dashpot- and the name of the study].
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Runs so many random cases again and compares their rows, bit for bit.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    check: Option<u32>,
    /// Seed of the choice of --check [default: a random one, which is printed].
    #[arg(long, value_name = "SEED", requires = "check")]
    check_seed: Option<u64>,
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
    let checked = match arguments.check {
        Some(count) => Some(check_again(&study, &rows, count, arguments.check_seed)?),
        None => None,
    };
    let folder = arguments.study.folder(arguments.output.as_ref());
    create_folder(&folder)?;
    let path = folder.join("rows.csv");
    rows::write(&study, &rows, &path)?;
    let mut report = Report::new(&study, &rows, 0, Duration::ZERO);
    report.checked = checked;
    report.files.push(path);
    results.write(&study, &rows, &folder, &mut report)?;
    print_report(results.format(), &report, sweep::print)
}

/// Runs random cases again.
fn check_again(study: &Study, rows: &Rows, count: u32, seed: Option<u64>) -> Outcome<Checked> {
    let seed = seed.unwrap_or_else(|| fastrand::u64(..));
    let cases = choose(rows, count as usize, seed);
    let _ends_gently = interruption::end_gently();
    check(
        study,
        rows,
        &cases,
        dashpot_workers::threads(),
        &interruption::is_wanted,
    )
    .map_err(|error| {
        let way_on = match &error {
            CheckError::Differs { .. } => "; run its shard again with --anew",
            CheckError::Arithmetic { .. } => {
                "; merge without --check, or on a processor of that kind"
            }
            _ => "",
        };
        Failure::new(format!("--check with --check-seed {seed}: {error}{way_on}"))
    })?;
    Ok(Checked { cases, seed })
}

impl From<MergeError> for Failure {
    fn from(error: MergeError) -> Self {
        match error {
            MergeError::Rows(RowsError::Damaged { line, source }) => Self::new(format!(
                "{source}; delete line {line} of this file, run the command of its shard again, and merge"
            )),
            MergeError::Rows(RowsError::Foreign(source)) => Self::new(format!(
                "{source}; run the command of its shard again with --anew"
            )),
            MergeError::Rows(error) => error.into(),
            MergeError::Gaps(gaps) => Self::new(gaps.to_string()),
        }
    }
}
