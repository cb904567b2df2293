//! `dashpot merge`: merges the rows of a study's shards.

use std::path::PathBuf;
use std::time::Duration;

use super::sweep::{self, Checked, Report, ResultArguments, StudyArguments};
use super::{interruption, print_report};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::output::create_folder;
use dashpot_study::sweep::curves::{self, Curves};
use dashpot_study::sweep::extension;
use dashpot_study::sweep::rows::{self, Rows, RowsError};
use dashpot_study::sweep::{
    CheckError, Finished, MergeError, Shared, Study, check, choose, even_track, merge,
};

/// Merge the rows of a study's shards, check them against the list of cases, and write the page.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot merge paper results/rows-*-of-8.csv --output results

  dashpot merge paper results/rows-*-of-8.csv --output results --check 5

Writes rows.csv, rows.study, rows.curves and report.html, identical to those of `dashpot sweep` on one machine. The curves of the
page are read beside each file of rows (rows-I-of-N.curves); cases whose curves are missing run again. Missing or duplicate cases are
listed; then nothing is written and the exit code is 1. --check repeats random cases before anything is written, and
fails if a bit differs.")]
pub struct MergeArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Row files written by `dashpot sweep --shard`.
    #[arg(required = true, value_name = "ROWS")]
    files: Vec<PathBuf>,
    /// Output folder [default: dashpot- and the name of the study].
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Repeat this number of random cases and compare their rows bit for bit.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    check: Option<u32>,
    /// Seed for the selection of --check [default: a random seed, which is printed].
    #[arg(long, value_name = "SEED", requires = "check")]
    check_seed: Option<u64>,
    #[command(flatten)]
    results: ResultArguments,
}

/// Runs the command.
///
/// # Errors
/// The study or its rows are invalid, cases are missing or duplicate, or a file cannot be written.
pub fn run(arguments: &MergeArguments) -> Outcome<()> {
    let results = &arguments.results;
    results.check()?;
    let study = arguments.study.read()?;
    let shared = Shared::default();
    results.check_figures(&study, &shared)?;
    let rows = merge(&study, &arguments.files)?;
    let checked = match arguments.check {
        Some(count) => Some(check_again(&study, &rows, count, arguments.check_seed)?),
        None => None,
    };
    let finished = with_curves(&study, rows, &arguments.files);
    let folder = arguments.study.folder(arguments.output.as_ref());
    create_folder(&folder)?;
    let path = folder.join("rows.csv");
    rows::write(&study, &finished.rows, &path)?;
    if !finished.curves.is_empty() {
        let path = curves::path_of(&path);
        curves::write(&study, &finished.rows, &finished.curves, &path)?;
    }
    extension::write_merged(&study, &finished.rows, &arguments.files, &path)?;
    let mut report = Report::new(&study, &finished.rows, 0, Duration::ZERO);
    report.checked = checked;
    report.warnings = even_track(&study, &shared)?;
    let to = (path.as_path(), dashpot_workers::threads());
    results.write(&study, finished, to, &shared, &mut report)?;
    print_report(results.format(), &report, sweep::print)
}

/// Reads the curves beside the files of rows.
fn with_curves(study: &Study, rows: Rows, files: &[PathBuf]) -> Finished {
    let (mut curves, mut problems) = (Curves::new(), Vec::new());
    for file in files {
        let kept = curves::read(study, &rows, &curves::path_of(file));
        curves.extend(kept.curves);
        problems.extend(kept.problems);
    }
    Finished {
        rows,
        curves,
        problems,
    }
}

/// Runs random cases again and compares their rows.
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
        let remedy = match &error {
            CheckError::Differs { .. } => "; run its shard again with --anew",
            _ => "",
        };
        Failure::new(format!("--check with --check-seed {seed}: {error}{remedy}"))
    })?;
    Ok(Checked { cases, seed })
}

impl From<MergeError> for Failure {
    fn from(error: MergeError) -> Self {
        match error {
            MergeError::Rows(RowsError::Damaged { line, source }) => Self::new(format!(
                "{source}; delete line {line} of this file, run the command of its shard again, then merge"
            )),
            MergeError::Rows(RowsError::Foreign(source)) => Self::new(format!(
                "{source}; run the command of its shard again with --anew"
            )),
            MergeError::Rows(error) => error.into(),
            MergeError::Gaps(gaps) => Self::new(gaps.to_string()),
        }
    }
}
