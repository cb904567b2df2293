//! Results that are derived from the rows of a study.

use std::path::Path;

use super::report::Report;
use super::{curves, page};
use crate::commands::arguments::Format;
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::output::write_bytes;
#[cfg(feature = "parquet")]
use dashpot_recording::columns;
#[cfg(feature = "parquet")]
use dashpot_study::sweep::ROW_DIGEST;
use dashpot_study::sweep::{Finished, Shared, Study};

/// Options for results derived from the rows.
#[derive(Debug, Clone, clap::Args)]
pub struct ResultArguments {
    /// Do not write the page.
    #[arg(long)]
    no_page: bool,
    /// Also write rows.parquet. Needs a build with the feature `parquet`.
    #[arg(long)]
    parquet: bool,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

impl ResultArguments {
    /// Rejects options that this build does not support.
    pub(in crate::commands) fn check(&self) -> Outcome<()> {
        if self.parquet && !cfg!(feature = "parquet") {
            return Err(Failure::wrong_use(
                "--parquet is not available in this build; build dashpot-hil with the feature `parquet`",
            ));
        }
        Ok(())
    }

    /// Returns the output format.
    pub(in crate::commands) fn format(&self) -> Format {
        self.format
    }

    /// Checks that the figures can be drawn; keeps what it builds in `shared`.
    pub(in crate::commands) fn check_figures(&self, study: &Study, shared: &Shared) -> Outcome<()> {
        if self.no_page {
            Ok(())
        } else {
            page::check(study, shared)
        }
    }

    /// Writes the results derived from all rows, which are in the file at `path`, and lists the files in the report.
    pub(in crate::commands) fn write(
        &self,
        study: &Study,
        mut finished: Finished,
        (path, threads): (&Path, usize),
        shared: &Shared,
        report: &mut Report,
    ) -> Outcome<()> {
        let Finished { rows, curves, .. } = &mut finished;
        let ran_again = match self.no_page {
            true => None,
            false => curves::complete(study, rows, curves, (path, threads), shared)?,
        };
        report.add_rows(path, &finished);
        report.notes.extend(ran_again);
        let folder = path.parent().unwrap_or(path);
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
            let page = page::write(study, &finished, report, threads)?;
            write_bytes(&path, page.as_bytes())?;
            report.files.push(path);
        }
        Ok(())
    }
}
