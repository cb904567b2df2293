//! Report of a study.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::Serialize;

use crate::commands::arguments::Format;
use crate::commands::failure::Outcome;
use crate::commands::{counted, print_report};
use dashpot_files::output;
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
    /// Cases that did not complete, by reason.
    not_completed: BTreeMap<String, Vec<u64>>,
    /// Cases that `merge --check` repeated with bit-identical results.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(in crate::commands) checked: Option<Checked>,
    /// Curves of the page that could not be used, and cases that ran again for them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) notes: Vec<String>,
    pub(in crate::commands) files: Vec<PathBuf>,
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
            not_completed,
            checked: None,
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
        checked,
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
    if let Some(note) = report.not_completed() {
        writeln!(out, "{note}")?;
    }
    for note in notes {
        writeln!(out, "{note}")?;
    }
    if let Some(Checked { cases, seed }) = checked {
        let count = counted(cases.len() as u64, "case");
        let numbers: Vec<String> = cases.iter().map(u64::to_string).collect();
        let numbers = numbers.join(", ");
        writeln!(
            out,
            "{count} repeated with bit-identical results (--check-seed {seed}): {numbers}"
        )?;
    }
    writeln!(out)?;
    for file in files {
        writeln!(out, "wrote {}", output::name(file).display())?;
    }
    Ok(())
}

/// List of the cases of a study.
#[derive(Serialize)]
struct List {
    study: String,
    digest: String,
    version: &'static str,
    cases: u64,
    sweeps: Vec<Listed>,
}

#[derive(Serialize)]
struct Listed {
    sweep: String,
    first_case: u64,
    cases: u64,
    parameters: Vec<String>,
    seeds: usize,
}

/// Prints the list of cases of a study.
pub(super) fn list(study: &Study, format: Format) -> Outcome<()> {
    let sweeps = study.parameters.sweeps.iter().map(|sweep| {
        let first = study.numbers(sweep, 0).start;
        Listed {
            sweep: sweep.name.clone(),
            first_case: first,
            cases: study.numbers(sweep, sweep.points() - 1).end - first,
            parameters: sweep
                .axes
                .iter()
                .map(|axis| axis.parameter.clone())
                .collect(),
            seeds: sweep.seeds.len(),
        }
    });
    let list = List {
        study: study.parameters.name.clone(),
        digest: study.digest().to_owned(),
        version: VERSION,
        cases: study.cases(),
        sweeps: sweeps.collect(),
    };
    print_report(format, &list, |out, list| {
        writeln!(out, "{}: {}", list.study, counted(list.cases, "case"))?;
        writeln!(out, "study {}, version {}\n", list.digest, list.version)?;
        for sweep in &list.sweeps {
            let last = sweep.first_case + sweep.cases - 1;
            writeln!(
                out,
                "{:<16} {:>7} - {last:<7} {} x {}",
                sweep.sweep,
                sweep.first_case,
                if sweep.parameters.is_empty() {
                    "one case".into()
                } else {
                    sweep.parameters.join(" x ")
                },
                match sweep.seeds {
                    0 => "the seed of the track".into(),
                    seeds => counted(seeds as u64, "seed"),
                }
            )?;
        }
        Ok(())
    })
}
