//! `dashpot sweep`: runs the cases of a study and writes one row per case and a page.

mod curves;
mod list;
mod page;
mod report;
mod results;

use std::path::{Path, PathBuf};
use std::time::Instant;

use report::Extended;
pub(super) use report::{Checked, Report, print};
pub(super) use results::ResultArguments;

use super::{interruption, print_report, progress};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::input::is_standard_stream;
use dashpot_files::output::create_folder;
use dashpot_files::study::{STUDIES, StudyParameters};
use dashpot_study::sweep::rows::RowsError;
use dashpot_study::sweep::{
    Computed, ContactTables, Journal, Plan, RunError, Shard, Shared, Start, Study, even_track,
};

/// Run a study: many cases of a vehicle on a track, with one row of indices per case and a page.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot sweep paper
  dashpot sweep my_study.toml --output results
  dashpot sweep paper --shard 3 --shards 8 --output results --no-page
  dashpot merge paper results/rows-*-of-8.csv --output results

Writes rows.csv to --output: one row per case with parameter values, seed, indices, study ID and version; and
report.html, the page. Curves that the page draws are kept in rows.curves, so that it is written without running cases
again. A shard writes only rows-I-of-N.csv, .curves and .study. The rows are bit-identical for any number of threads
and shards; identical cases are simulated once. A case that derails, overturns, leaves the contact tables or has a wheel load above 50 times the static load
has no indices; its column `ending` gives the reason. Observe `wheel_load_over_static` and `wheel_lift_longest_s` to
find rows that need a second look (docs/studies.md).

An interrupted command keeps its rows in a .partial file; the same command resumes with the missing cases. If the study
has more seeds, values, sweeps or indices than the existing rows, they are kept and only the missing cases run: the
files are those of a run from nothing. rows.study has what this needs. Shards take the rows of the earlier study, merged,
with --reuse. Rows from a study that differs in anything else, or from another version or physics, are an error, unless
--anew overwrites them. Each row has a digest of its cells, so an altered row is detected.")]
pub struct SweepArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Output folder [default: dashpot- and the name of the study].
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Number of threads [default: one per core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Run only one shard of the cases, counted from 0; needs --shards.
    #[arg(long, value_name = "I", requires = "shards")]
    shard: Option<u64>,
    /// Total number of shards; needs --shard.
    #[arg(long, value_name = "N", requires = "shard", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    shards: Option<u64>,
    /// Start over; existing results are kept as rows.csv.old, rows.curves.old and rows.study.old.
    #[arg(long)]
    anew: bool,
    /// Keep the rows of this file, of this study or of one with fewer seeds, values, sweeps or indices.
    #[arg(long, value_name = "ROWS")]
    reuse: Option<PathBuf>,
    /// Folder of contact tables that `dashpot tables` computed; others are an error [default: the user's cache
    /// folder].
    #[arg(long, value_name = "FOLDER")]
    contact_tables: Option<PathBuf>,
    /// List the cases and those that are done, and estimate the time of the others from a short run of one.
    #[arg(long, conflicts_with_all = ["shard", "anew"])]
    list: bool,
    #[command(flatten)]
    results: ResultArguments,
}

/// A study and its number of seeds.
#[derive(Debug, Clone, clap::Args)]
pub struct StudyArguments {
    /// Study.
    #[arg(help = study_help(), value_name = "STUDY")]
    study: String,
    /// Use seeds 1 to N instead of the seeds of the study, for sweeps that have seeds.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seeds: Option<u64>,
}

/// Returns the help text of the study argument.
fn study_help() -> String {
    let names = STUDIES.map(|(name, _)| name);
    format!("Study: built-in name ({}) or TOML file", names.join(", "))
}

impl StudyArguments {
    /// Reads and checks the study.
    pub(super) fn read(&self) -> Outcome<Study> {
        let parameters = StudyParameters::load(&self.study)?;
        Ok(Study::new(match self.seeds {
            Some(seeds) => parameters.with_seeds(seeds),
            None => parameters,
        })?)
    }

    /// Returns `output`, or the default folder, which is named after the study.
    pub(super) fn folder(&self, output: Option<&PathBuf>) -> PathBuf {
        let default_folder = || {
            let path = Path::new(&self.study);
            let stem = path.file_stem().filter(|_| !is_standard_stream(path));
            let stem = stem.map_or("study".into(), |stem| stem.to_string_lossy());
            PathBuf::from(format!("dashpot-{stem}"))
        };
        output.cloned().unwrap_or_else(default_folder)
    }
}

/// Runs the command.
///
/// # Errors
/// The study is invalid, existing rows belong to another study, a file cannot be written, or the user interrupts.
pub fn run(arguments: &SweepArguments) -> Outcome<()> {
    let results = &arguments.results;
    results.check()?;
    let shard = match (arguments.shard, arguments.shards) {
        (Some(number), Some(of)) if number < of => Some(Shard { number, count: of }),
        (Some(number), Some(of)) => {
            return Err(Failure::wrong_use(format!(
                "--shard {number}: allowed with --shards {of}: 0 to {}",
                of - 1
            )));
        }
        _ => None,
    };
    let study = arguments.study.read()?;
    let shared = match &arguments.contact_tables {
        Some(folder) => Shared::with_tables(ContactTables::new(folder), &study.pairs()?)?,
        None => Shared::default(),
    };
    let folder = arguments.study.folder(arguments.output.as_ref());
    let threads = arguments
        .threads
        .map_or_else(dashpot_workers::threads, usize::from);
    if shard.is_none() {
        results.check_figures(&study, &shared)?;
    }
    if arguments.list {
        let rows = folder.join("rows.csv");
        return list::list(&study, &shared, (&rows, threads), results.format());
    }
    create_folder(&folder)?;
    let name = match shard {
        Some(Shard { number, count: of }) => format!("rows-{number}-of-{of}.csv"),
        None => "rows.csv".into(),
    };
    let path = folder.join(name);
    let start = Start {
        shard,
        restart: arguments.anew,
        reuse: arguments.reuse.as_deref(),
    };
    let mut journal = Journal::open(&study, &path, start).map_err(refused)?;
    let known = journal.rows();
    let part: Vec<u64> = study.part(shard).collect();
    let missing: Vec<u64> = part
        .iter()
        .copied()
        .filter(|number| !known.contains_key(number))
        .collect();
    let started = Instant::now();
    let plan = Plan::new(&study, &missing, threads)?;
    let ran = run_missing(
        &plan,
        &shared,
        &study,
        &mut journal,
        [missing.len(), part.len()],
    );
    let took = started.elapsed();
    // Rows from before and after a change of the files could not be distinguished.
    if !study.is_unchanged().unwrap_or(false) {
        journal.remove(&study, &missing)?;
        return Err(Failure::new(format!(
            "{}: a file of the study was changed during the run; the rows of this run are discarded",
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
            "interrupted: {done} of {} cases are done; {command} resumes with the rest",
            part.len()
        )));
    }
    let extended = Extended::of(journal.moved());
    let finished = journal.finish(&study)?;
    let mut report = Report::new(&study, &finished.rows, missing.len(), took);
    report.extended = extended;
    report.warnings = even_track(&study, &shared)?;
    report.simulated = plan.simulations();
    match shard {
        None => results.write(
            &study,
            finished,
            (path.as_path(), threads),
            &shared,
            &mut report,
        )?,
        Some(_) => report.add_rows(&path, &finished),
    }
    print_report(results.format(), &report, print)
}

/// Runs the missing cases and adds their rows, until all are done or the user interrupts.
fn run_missing(
    plan: &Plan<'_>,
    shared: &Shared,
    study: &Study,
    journal: &mut Journal,
    [missing, all]: [usize; 2],
) -> Outcome<()> {
    let bar = progress::bar(all as u64, "cases");
    bar.set_position((all - missing) as u64);
    bar.reset_eta();
    let _ends_gently = interruption::end_gently();
    let take = |computed: Computed| -> Outcome<()> {
        let Computed {
            row,
            curves,
            indices,
        } = computed;
        journal.add(study, row, curves, indices)?;
        bar.inc(1);
        Ok(())
    };
    let needed = study.needed_curves();
    let done = plan.run(shared, &needed, &interruption::is_wanted, take);
    bar.finish_and_clear();
    done
}

/// Reports existing rows that the study cannot resume from, with a remedy.
fn refused(error: RowsError) -> Failure {
    let remedy = match &error {
        RowsError::File(_) => return error.into(),
        RowsError::Damaged { line, .. } => format!(
            "delete line {line} of this file and repeat the command to run its case again, or start over with --anew"
        ),
        RowsError::Foreign(_) => {
            "start over with --anew, or keep these rows and write to another folder with --output"
                .into()
        }
        _ => return Failure::new(error.to_string()),
    };
    Failure::new(format!("{error}; {remedy}"))
}

impl From<RowsError> for Failure {
    fn from(error: RowsError) -> Self {
        match error {
            RowsError::File(error) => error.into(),
            other => Self::new(other.to_string()),
        }
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
