//! Curves of the page: those kept beside the rows, and those of cases that have to run again.

use std::path::Path;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::{counted, progress};
use dashpot_study::sweep::curves::{self, CurveKey, Curves, Needed};
use dashpot_study::sweep::rows::Rows;
use dashpot_study::sweep::{Computed, Plan, Shared, Study};

/// Adds the curves that the page needs and `curves` does not have: runs their cases again and writes all curves beside
/// the rows at `path`. Returns a note if cases ran.
///
/// # Errors
/// A case cannot be run, a signal cannot be drawn, or the file cannot be written.
pub(super) fn complete(
    study: &Study,
    rows: &Rows,
    curves: &mut Curves,
    (path, threads): (&Path, usize),
    shared: &Shared,
) -> Outcome<Option<String>> {
    let missing = missing(study, curves);
    if missing.is_empty() {
        return Ok(None);
    }
    let numbers: Vec<u64> = missing.keys().copied().collect();
    let plan = Plan::new(study, &numbers, threads)?;
    let bar = progress::bar(numbers.len() as u64, "cases of the page");
    let take = |computed: Computed| -> Outcome<()> {
        curves.extend(computed.curves);
        bar.inc(1);
        Ok(())
    };
    plan.run(shared, &missing, &|| false, take)?;
    bar.finish_and_clear();
    if !study.is_unchanged().unwrap_or(false) {
        return Err(Failure::new(format!(
            "{}: a file of the study was changed while cases of the page ran; repeat the command",
            study.parameters.file
        )));
    }
    if let Some((case, names)) = self::missing(study, curves).first_key_value() {
        let names = names
            .iter()
            .map(|(signal, kind)| format!("{} of {signal}", kind.name()));
        return Err(Failure::new(format!(
            "a figure cannot be drawn: case {case} has no {}",
            names.collect::<Vec<_>>().join(", ")
        )));
    }
    let path = curves::path_of(path);
    curves::write(study, rows, curves, &path)?;
    Ok(Some(format!(
        "{}: did not have the curves of {} for the page, which ran again",
        path.display(),
        counted(numbers.len() as u64, "case")
    )))
}

/// Needed curves that are missing.
fn missing(study: &Study, curves: &Curves) -> Needed {
    let mut needed = study.needed_curves();
    for (case, of_case) in &mut needed {
        of_case.retain(|(signal, kind)| {
            !curves.contains_key(&CurveKey {
                case: *case,
                signal: signal.clone(),
                kind: *kind,
            })
        });
    }
    needed.retain(|_, of_case| !of_case.is_empty());
    needed
}
