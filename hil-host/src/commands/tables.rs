//! `dashpot tables`: computes contact tables ahead, for many processes that read them from one folder.

use std::io::{self, Write};
use std::path::PathBuf;

use serde::Serialize;

use super::arguments::Format;
use super::failure::{Failure, Outcome};
use super::print_report;
use super::sweep::StudyArguments;
use dashpot_files::case::Case;
use dashpot_files::output::create_folder;
use dashpot_study::sweep::{ContactTables, ContactTablesError};
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::{ContactSetup, WheelOnRail};

/// Compute the contact tables of a study or a case ahead, once for all processes of a cluster.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot tables paper --output tables
  dashpot sweep paper --shard 3 --shards 8 --no-page --contact-tables tables
  dashpot tables --case straight-180 --output tables
  dashpot vehicle --case straight-180 --contact-tables tables

Without this command, the first run of each pair of wheel and rail computes its tables, which takes two to three seconds
of processor time, and keeps them in the user's cache folder. On a cluster whose tasks have no common cache folder, each
task would do this. A file is named after the digest of the profiles and distances, and has a checksum and a version:
with --contact-tables, missing and invalid files are errors. Results are the same bits with and without.")]
pub struct TablesArguments {
    #[command(flatten)]
    study: Option<StudyArguments>,
    /// Case instead of a study: built-in name or TOML file.
    #[arg(long, value_name = "CASE", conflicts_with_all = ["study", "seeds"], required_unless_present = "study")]
    case: Option<String>,
    /// Folder for the tables; tables of other pairs stay there.
    #[arg(long, value_name = "FOLDER")]
    output: PathBuf,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Files of the tables.
#[derive(Serialize)]
struct Report {
    files: Vec<Written>,
}

#[derive(Serialize)]
struct Written {
    file: PathBuf,
    bytes: usize,
    /// False if the folder had the file.
    computed: bool,
}

/// Runs the command.
///
/// # Errors
/// The study or case is invalid, or the folder cannot be written.
pub fn run(arguments: &TablesArguments) -> Outcome<()> {
    let pairs = match (&arguments.study, &arguments.case) {
        (Some(study), _) => study.read()?.pairs()?,
        (None, Some(case)) => pairs_of(&Case::load(case)?)?,
        (None, None) => return Err(Failure::wrong_use("give a study or --case")),
    };
    create_folder(&arguments.output)?;
    let tables = ContactTables::new(&arguments.output);
    let files = dashpot_workers::map(&pairs, |pair| tables.compute(pair))?;
    let files = files.into_iter().map(|file| Written {
        file: file.path,
        bytes: file.bytes,
        computed: file.is_new,
    });
    let report = Report {
        files: files.collect(),
    };
    print_report(arguments.format, &report, print)
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    for Written {
        file,
        bytes,
        computed,
    } in &report.files
    {
        let what = match computed {
            true => "wrote",
            false => "kept",
        };
        let megabytes = *bytes as f64 * 1e-6;
        writeln!(out, "{what} {} ({megabytes:.1} MB)", file.display())?;
    }
    Ok(())
}

fn pairs_of(case: &Case) -> Result<Vec<WheelOnRail>, VehicleRunError> {
    Ok(ContactSetup::of_case(case)?.pairs().to_vec())
}

impl From<ContactTablesError> for Failure {
    fn from(error: ContactTablesError) -> Self {
        match error {
            ContactTablesError::File(error) => error.into(),
            ContactTablesError::Missing { .. } | ContactTablesError::Invalid { .. } => {
                Self::new(format!(
                    "--contact-tables: {error}; compute them with `dashpot tables`, whose --output is this folder"
                ))
            }
            ContactTablesError::Contact(error) => error.into(),
        }
    }
}
