//! `dashpot sweep`: the cases of a study, a row each, and their page.

mod page;
mod report;

use std::path::{Path, PathBuf};
use std::time::Instant;

pub(super) use report::{Checked, Report, print};

use super::{Format, interruption, print_report, progress};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::input::is_standard_stream;
use dashpot_files::output::{create_folder, write_bytes};
use dashpot_files::study::{STUDIES, StudyParameters};
#[cfg(feature = "parquet")]
use dashpot_recording::columns;
#[cfg(feature = "parquet")]
use dashpot_study::sweep::ROW_DIGEST;
use dashpot_study::sweep::rows::{Rows, RowsError};
use dashpot_study::sweep::{self, Journal, Row, RunError, Shard, Study};

/// A study: many cases of a vehicle on a track, one row of indices each, and a page.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot sweep paper
  dashpot sweep my_study.toml --output results
  dashpot sweep paper --shard 3 --shards 8 --output results --no-page
  dashpot merge paper results/rows-*-of-8.csv --output results

Written into the folder of --output: rows.csv, a row a case with its values, its seed, its indices, and what study and version it is of;
report.html, the page. Of a shard only rows-I-of-N.csv. The rows are the same, bit for bit, on any number of threads and shards. A case
that derails, overturns, leaves the tables or has a wheel load over 50 times that at standstill has that in its column `ending` and no
indices. Observe `wheel_load_over_static` and `wheel_lift_longest_s` to find rows that need a second look (docs/studies.md).

An interrupted command keeps its rows in a file .partial; the same command goes on with the cases that are missing.
Rows of another study, version or physics are refused, and with --anew overwritten. Each row carries a digest of its
cells: an altered row is refused.")]
pub struct SweepArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Folder that results are written to [default: dashpot- and the name of the study].
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Threads [default: one a core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Runs only one part of the cases, counted from 0; with --shards.
    #[arg(long, value_name = "I", requires = "shards")]
    shard: Option<u64>,
    /// How many parts there are; with --shard.
    #[arg(long, value_name = "N", requires = "shard", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    shards: Option<u64>,
    /// Begins anew, whatever rows there are; a file of rows keeps them as rows.csv.old.
    #[arg(long)]
    anew: bool,
    /// Tells the cases and runs none.
    #[arg(long, conflicts_with_all = ["shard", "anew"])]
    list: bool,
    #[command(flatten)]
    results: ResultArguments,
}

/// Which study, over how many seeds.
#[derive(Debug, Clone, clap::Args)]
pub struct StudyArguments {
    /// A study.
    #[arg(help = study_help(), value_name = "STUDY")]
    study: String,
    /// Seeds 1 to N in place of those of the study, where it has some.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seeds: Option<u64>,
}

/// What is made of the rows.
#[derive(Debug, Clone, clap::Args)]
pub struct ResultArguments {
    /// Writes no page.
    #[arg(long)]
    no_page: bool,
    /// Writes rows.parquet too; only in a build with the feature `parquet`.
    #[arg(long)]
    parquet: bool,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// The help of an argument that names a study.
fn study_help() -> String {
    let names = STUDIES.map(|(name, _)| name);
    format!(
        "Study: the name of one that ships ({}) or a TOML file",
        names.join(", ")
    )
}

impl StudyArguments {
    /// The study, read and checked.
    pub(super) fn read(&self) -> Outcome<Study> {
        let parameters = StudyParameters::load(&self.study)?;
        Ok(Study::new(match self.seeds {
            Some(seeds) => parameters.with_seeds(seeds),
            None => parameters,
        })?)
    }

    /// The folder of `output`, or that of the study's name.
    pub(super) fn folder(&self, output: Option<&PathBuf>) -> PathBuf {
        let of_name = || {
            let path = Path::new(&self.study);
            let stem = path.file_stem().filter(|_| !is_standard_stream(path));
            let stem = stem.map_or("study".into(), |stem| stem.to_string_lossy());
            PathBuf::from(format!("dashpot-{stem}"))
        };
        output.cloned().unwrap_or_else(of_name)
    }
}

/// Runs the command.
///
/// # Errors
/// A study that is refused; rows of another study; files that cannot be written; an interruption.
pub fn run(arguments: &SweepArguments) -> Outcome<()> {
    let results = &arguments.results;
    results.check()?;
    let shard = match (arguments.shard, arguments.shards) {
        (Some(number), Some(of)) if number < of => Some(Shard { number, count: of }),
        (Some(number), Some(of)) => {
            return Err(Failure::wrong_use(format!(
                "--shard {number}, allowed: 0 to {} with --shards {of}",
                of - 1
            )));
        }
        _ => None,
    };
    let study = arguments.study.read()?;
    if arguments.list {
        results.check_figures(&study)?;
        return report::list(&study, results.format);
    }
    if shard.is_none() {
        results.check_figures(&study)?;
    }
    let folder = arguments.study.folder(arguments.output.as_ref());
    create_folder(&folder)?;
    let name = match shard {
        Some(Shard { number, count: of }) => format!("rows-{number}-of-{of}.csv"),
        None => "rows.csv".into(),
    };
    let path = folder.join(name);
    let mut journal = Journal::open(&study, &path, shard, arguments.anew).map_err(refused)?;
    let known = journal.rows();
    let part: Vec<u64> = study.part(shard).collect();
    let missing: Vec<u64> = part
        .iter()
        .copied()
        .filter(|number| !known.contains_key(number))
        .collect();
    let started = Instant::now();
    let ran = run_missing(
        &study,
        &mut journal,
        &missing,
        part.len(),
        arguments.threads,
    );
    let took = started.elapsed();
    // Rows of files before and after a change would not be told apart.
    if !study.is_unchanged().unwrap_or(false) {
        journal.remove(&study, &missing)?;
        return Err(Failure::new(format!(
            "{}: the study's files were changed while it ran; the rows of this run are not kept",
            study.parameters.file
        )));
    }
    ran?;
    let done = journal.rows().len();
    if done < part.len() {
        let command = if arguments.anew {
            "the same command without --anew"
        } else {
            "the same command"
        };
        return Err(Failure::new(format!(
            "interrupted: {done} of {} cases are done; {command} goes on with the rest",
            part.len()
        )));
    }
    let rows = journal.finish(&study)?;
    let mut report = Report::new(&study, &rows, missing.len(), took);
    report.files.push(path.clone());
    if shard.is_none() {
        results.write(&study, &rows, &folder, &mut report)?;
    }
    print_report(results.format, &report, print)
}

/// Runs the cases that are missing and adds their rows, until all are there or the user wants it to end.
fn run_missing(
    study: &Study,
    journal: &mut Journal,
    missing: &[u64],
    all: usize,
    threads: Option<u16>,
) -> Outcome<()> {
    let threads = threads.map_or_else(dashpot_workers::threads, usize::from);
    let bar = progress::bar(all as u64, "cases");
    bar.set_position((all - missing.len()) as u64);
    bar.reset_eta();
    let _ends_gently = interruption::end_gently();
    let take = |row: Row| -> Outcome<()> {
        journal.add(study, row)?;
        bar.inc(1);
        Ok(())
    };
    let done = sweep::run(study, missing, threads, &interruption::is_wanted, take);
    bar.finish_and_clear();
    done
}

/// Rows that a study cannot go on with, and the way on.
fn refused(error: RowsError) -> Failure {
    let way_on = match &error {
        RowsError::File(_) => return error.into(),
        RowsError::Damaged { line, .. } => format!(
            "delete line {line} of this file, and the same command runs its case again; or start over with --anew"
        ),
        RowsError::Foreign(_) => {
            "start over with --anew, or keep these rows and write elsewhere with --output".into()
        }
        _ => return Failure::new(error.to_string()),
    };
    Failure::new(format!("{error}; {way_on}"))
}

impl From<RowsError> for Failure {
    fn from(error: RowsError) -> Self {
        match error {
            RowsError::File(error) => error.into(),
            other => Self::new(other.to_string()),
        }
    }
}

impl ResultArguments {
    /// Refuses what this build has not.
    pub(super) fn check(&self) -> Outcome<()> {
        if self.parquet && !cfg!(feature = "parquet") {
            return Err(Failure::wrong_use(
                "--parquet is left out of this build; build dashpot-hil with the feature `parquet`",
            ));
        }
        Ok(())
    }

    /// How results are printed.
    pub(super) fn format(&self) -> Format {
        self.format
    }

    /// Refuses figures that cannot be drawn.
    pub(super) fn check_figures(&self, study: &Study) -> Outcome<()> {
        if self.no_page {
            Ok(())
        } else {
            page::check(study)
        }
    }

    /// Writes what is made of all rows into the folder, and names it in the report.
    pub(super) fn write(
        &self,
        study: &Study,
        rows: &Rows,
        folder: &Path,
        report: &mut Report,
    ) -> Outcome<()> {
        #[cfg(feature = "parquet")]
        if self.parquet {
            let path = folder.join("rows.parquet");
            columns::write(
                &folder.join("rows.csv"),
                &path,
                &["study", "physics", ROW_DIGEST],
            )?;
            report.files.push(path);
        }
        if !self.no_page {
            let path = folder.join("report.html");
            write_bytes(&path, page::write(study, rows, report)?.as_bytes())?;
            report.files.push(path);
        }
        Ok(())
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Case(error) => (*error).into(),
            other => Self::new(other.to_string()),
        }
    }
}
