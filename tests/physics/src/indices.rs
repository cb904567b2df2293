//! Indices of the runs of a study.

use dashpot_study::sweep::{Shared, Study, row};

use crate::bits;

/// Every index of every run.
pub(super) fn of_runs(study: &Study) -> Vec<Vec<String>> {
    let shared = Shared::default();
    (0..study.cases())
        .map(|number| of_run(study, number, &shared))
        .collect()
}

fn of_run(study: &Study, number: u64, shared: &Shared) -> Vec<String> {
    let row = row(study, number, shared, &|| false)
        .expect("a run")
        .expect("a case");
    assert_eq!(row.ending, "completed", "case {number}");
    let observed = study.observed.iter().zip(&row.observed);
    observed
        .map(|(index, value)| {
            let value = value.unwrap_or_else(|| panic!("case {number}: no {}", index.name));
            bits(value)
        })
        .collect()
}
