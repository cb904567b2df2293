//! `dashpot sweep --list`: the cases of a study, those that are done, and the time that the others take.

use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::commands::arguments::Format;
use crate::commands::failure::Outcome;
use crate::commands::{counted, print_answer};
use dashpot_study::sweep::{Plan, Shared, Study, TimeEstimate, VERSION, rows_done};

/// List of the cases of a study.
#[derive(Serialize)]
struct List {
    study: String,
    digest: String,
    version: &'static str,
    cases: u64,
    /// Cases whose rows are in the output folder.
    done: usize,
    /// Cases that the command would run.
    missing: usize,
    /// Simulations of the missing cases; identical ones share one.
    simulations: usize,
    /// Why the rows in the output folder cannot be used.
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
    /// `None` if nothing is missing.
    estimate: Option<TimeEstimate>,
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

/// Prints the list of cases of a study, whose rows are or will be in the file at `rows`.
pub(super) fn list(
    study: &Study,
    shared: &Shared,
    (rows, threads): (&Path, usize),
    format: Format,
) -> Outcome<()> {
    let started = Instant::now();
    let list = listed(study, shared, (rows, threads), &|| started.elapsed())?;
    print_answer(format, &list, print)
}

fn listed(
    study: &Study,
    shared: &Shared,
    (rows, threads): (&Path, usize),
    clock: &(dyn Fn() -> Duration + Sync),
) -> Outcome<List> {
    let (done, refused) = match rows_done(study, rows) {
        Ok(done) => (done, None),
        Err(error) => (Default::default(), Some(error.to_string())),
    };
    let all = study.part(None);
    let missing: Vec<u64> = all.filter(|case| !done.contains_key(case)).collect();
    let plan = Plan::new(study, &missing, threads)?;
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
    Ok(List {
        study: study.parameters.name.clone(),
        digest: study.digest().to_owned(),
        version: VERSION,
        cases: study.cases(),
        done: done.len(),
        missing: missing.len(),
        simulations: plan.simulations(),
        refused,
        estimate: plan.estimate(shared, clock)?,
        sweeps: sweeps.collect(),
    })
}

fn print(out: &mut dyn Write, list: &List) -> io::Result<()> {
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
    if let Some(reason) = &list.refused {
        writeln!(out, "\nwarning: existing rows cannot be used: {reason}")?;
    }
    let simulations = counted(list.simulations as u64, "simulation");
    writeln!(
        out,
        "\n{} done, {} to run ({simulations})",
        list.done, list.missing
    )?;
    match &list.estimate {
        None => Ok(()),
        Some(estimate) => writeln!(
            out,
            "about {} on this machine, with {}: estimated from case {}, of which they simulated {:.1} s in {:.2} s; \
             without the page",
            rounded(estimate.takes_s),
            counted(estimate.threads as u64, "thread"),
            estimate.probe_case,
            estimate.probe_simulated_s,
            estimate.probe_took_s
        ),
    }
}

/// A time with the two digits that an estimate has.
fn rounded(seconds: f64) -> String {
    match seconds {
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::time::Duration;

    use super::{listed, print, rounded};
    use dashpot_files::study::StudyParameters;
    use dashpot_study::sweep::{Shared, Study};

    #[test]
    fn the_text_says_what_the_estimate_is_based_on() {
        let text = r#"
            name = "short"
            observed = ["derailment_rms"]
            [[sweep]]
            name = "short"
            track = "straight"
            speed_km_h = 120
            duration_s = 1.5"#;
        let study = Study::new(StudyParameters::parse("study", text).unwrap()).unwrap();
        let looks = AtomicU64::new(0);
        let clock = || Duration::from_millis(500 * looks.fetch_add(1, Ordering::Relaxed));
        let to = (Path::new("no-such-folder/rows.csv"), 1);
        let list = listed(&study, &Shared::default(), to, &clock).unwrap();
        let mut text = Vec::new();
        print(&mut text, &list).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains("0 done, 1 to run (1 simulation)\n"), "{text}");
        let estimate = "about 1.5 s on this machine, with 1 thread: estimated from case 0, of which they simulated \
                        1.0 s in 1.00 s";
        assert!(text.contains(estimate), "{text}");
    }

    #[test]
    fn times_have_the_unit_of_their_size() {
        let times = [3.21, 99.6, 600.0, 36_000.0].map(rounded);
        assert_eq!(times, ["3.2 s", "100 s", "10 min", "10.0 h"]);
    }
}
