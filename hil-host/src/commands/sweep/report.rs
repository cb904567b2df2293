//! Report of a study.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::Serialize;

use crate::commands::counted;
use dashpot_files::output;
use dashpot_report::verdict::Verdict;
use dashpot_study::sweep::extension::{self, Moved};
use dashpot_study::sweep::rows::Rows;
use dashpot_study::sweep::{Finished, PHYSICS, Study, VERSION, curves};

/// Maximum number of notes about curves that are listed.
const MAX_NOTES: usize = 8;

/// Report of a study.
#[derive(Serialize)]
pub(in crate::commands) struct Report {
    study: String,
    digest: String,
    version: &'static str,
    /// Digest of the physical behaviour of the model.
    pub(super) physics: &'static str,
    /// Total number of rows.
    rows: usize,
    /// Number of cases run by this command.
    run_now: usize,
    /// Number of simulations that this took; identical cases share one.
    pub(super) simulated: usize,
    /// Time of this command's runs, s.
    took_s: f64,
    /// Rows that were kept although the study has been extended.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extended: Option<Extended>,
    /// Cases that did not complete, by reason.
    not_completed: BTreeMap<String, Vec<u64>>,
    /// Cases that `merge --check` repeated with bit-identical results.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::commands) checked: Option<Checked>,
    /// Warnings: results of cases that the model does not stand behind.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(in crate::commands) warnings: Vec<String>,
    /// Curves of the page that could not be used, and cases that ran again for them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) notes: Vec<String>,
    pub(in crate::commands) files: Vec<PathBuf>,
}

/// Rows of an earlier study, or of another file.
#[derive(Serialize)]
pub(super) struct Extended {
    /// Number of rows.
    rows_kept: usize,
    /// Digests of the earlier studies.
    of_studies: Vec<String>,
    /// Number of rows without an index of the study, whose cases therefore ran again, by index.
    lacking: BTreeMap<String, usize>,
}

impl Extended {
    /// Returns `None` if all rows are the study's own.
    pub(super) fn of(moved: &Moved) -> Option<Self> {
        let extended = Self {
            rows_kept: moved.indices.len(),
            of_studies: moved.studies.clone(),
            lacking: moved
                .lacking
                .iter()
                .map(|(index, cases)| (index.clone(), cases.len()))
                .collect(),
        };
        (extended.rows_kept > 0 || !extended.lacking.is_empty()).then_some(extended)
    }

    fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let rows = counted(self.rows_kept as u64, "row");
        match self.of_studies.is_empty() {
            true => writeln!(out, "{rows} kept from another file")?,
            false => {
                let studies = self.of_studies.join(", ");
                writeln!(
                    out,
                    "{rows} kept from before the extension (study {studies})"
                )?;
            }
        }
        for (index, cases) in &self.lacking {
            let cases = counted(*cases as u64, "case");
            writeln!(
                out,
                "{cases} run again, because their runs did not compute {index}"
            )?;
        }
        Ok(())
    }
}

/// Rows that were checked by repeating their runs.
#[derive(Serialize)]
pub(in crate::commands) struct Checked {
    /// Case numbers.
    pub(in crate::commands) cases: Vec<u64>,
    /// Seed of the random selection.
    pub(in crate::commands) seed: u64,
}

impl Report {
    pub(crate) fn new(study: &Study, rows: &Rows, run_now: usize, took: Duration) -> Self {
        let mut not_completed: BTreeMap<String, Vec<u64>> = BTreeMap::new();
        for row in rows.values() {
            let reason = reason(&row.ending);
            if reason != "completed" {
                let cases = not_completed.entry(reason.to_owned()).or_default();
                cases.push(row.case);
            }
        }
        Self {
            study: study.parameters.name.clone(),
            digest: study.digest().to_owned(),
            version: VERSION,
            physics: PHYSICS,
            rows: rows.len(),
            run_now,
            simulated: run_now,
            took_s: took.as_secs_f64(),
            extended: None,
            not_completed,
            checked: None,
            warnings: Vec::new(),
            notes: Vec::new(),
            files: Vec::new(),
        }
    }

    /// Lists the file of rows at `path` and that of their curves, if there are any, with what was wrong with curves.
    pub(super) fn add_rows(&mut self, path: &Path, finished: &Finished) {
        self.files.push(path.to_owned());
        if !finished.curves.is_empty() {
            self.files.push(curves::path_of(path));
        }
        self.files.push(extension::path_of(path));
        let problems = &finished.problems;
        self.notes.extend(problems.iter().take(MAX_NOTES).cloned());
        let more = problems.len().saturating_sub(MAX_NOTES);
        if more > 0 {
            self.notes.push(format!(
                "... and {} of curves",
                counted(more as u64, "more note")
            ));
        }
    }

    /// Describes the cases that did not complete.
    pub(super) fn not_completed(&self) -> Option<String> {
        let lines = self.not_completed.iter().map(|(reason, cases)| {
            let count = counted(cases.len() as u64, "case");
            let first: Vec<String> = cases.iter().take(8).map(u64::to_string).collect();
            let more = if cases.len() > 8 { ", ..." } else { "" };
            let first = first.join(", ");
            format!("{count} did not complete ({reason}; no indices): {first}{more}")
        });
        let lines: Vec<String> = lines.collect();
        (!lines.is_empty()).then(|| lines.join("; "))
    }
}

/// Returns the reason for the end of a case, without the position, which is in the row.
fn reason(ending: &str) -> &str {
    const NUMERICAL: &str = "numerically diverged";
    const LEFT: &str = "left the tables of the contact";
    const BEYOND: &str = "beyond the model";
    for reason in [NUMERICAL, LEFT, BEYOND] {
        if ending.contains(reason) {
            return reason;
        }
    }
    ending.split([':', ' ']).next().unwrap_or_default()
}

pub(in crate::commands) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let Report {
        study,
        digest,
        version,
        physics,
        rows,
        run_now,
        simulated,
        took_s,
        extended,
        checked,
        warnings,
        notes,
        files,
        ..
    } = report;
    writeln!(
        out,
        "{study}\nstudy {digest}, version {version}, physics {physics}"
    )?;
    let rows = counted(*rows as u64, "case");
    match run_now {
        0 => writeln!(out, "{rows}, none run now")?,
        run_now => writeln!(out, "{rows}, {run_now} run now in {took_s:.1} s")?,
    }
    if simulated < run_now {
        let same = counted((run_now - simulated) as u64, "case");
        writeln!(out, "{same} identical to others, not simulated again")?;
    }
    if let Some(extended) = extended {
        extended.print(out)?;
    }
    if let Some(note) = report.not_completed() {
        writeln!(out, "{}", Verdict::Warning.mark(note))?;
    }
    for note in warnings.iter().chain(notes) {
        writeln!(out, "{}", Verdict::Warning.mark(note))?;
    }
    if let Some(Checked { cases, seed }) = checked {
        let count = counted(cases.len() as u64, "case");
        let numbers: Vec<String> = cases.iter().map(u64::to_string).collect();
        let numbers = numbers.join(", ");
        writeln!(
            out,
            "{count} repeated with {} (--check-seed {seed}): {numbers}",
            Verdict::Passed.mark("bit-identical results")
        )?;
    }
    writeln!(out)?;
    for file in files {
        writeln!(out, "wrote {}", output::name(file).display())?;
    }
    Ok(())
}
