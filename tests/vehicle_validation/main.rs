//! Comparison of the paper's vehicle studies with ours, and limits at which a damper should be taken out of service.
//!
//! The tests compare the documents with the kept rows, and the kept rows with new runs.

mod claim;
mod document;
mod out_of_service;
mod physics;
mod rows;
mod trends;

use dashpot::document as kept;
use dashpot_study::sweep::{Row, RunError, run};
use rows::Kept;

/// Studies with kept rows.
const STUDIES: [&str; 4] = ["paper", "curve-r600", "stand-ins", "out-of-service"];

#[test]
fn the_validation_document_agrees_with_the_rows() {
    let [paper, wide, stand_ins] = ["paper", "curve-r600", "stand-ins"].map(Kept::load);
    kept::compare(
        "docs/vehicle-validation.md",
        &document::text(&paper, &wide, &stand_ins),
    );
}

#[test]
fn the_out_of_service_document_agrees_with_the_rows() {
    let rows = Kept::load("out-of-service");
    kept::compare("docs/out-of-service.md", &out_of_service::text(&rows));
}

#[test]
fn rows_agree_with_new_runs() {
    for name in STUDIES {
        let kept = Kept::load(name);
        assert_eq!(first_difference(&kept), None, "{name}");
    }
}

/// Runs every 397th case again; describes the first kept row whose bits differ.
fn first_difference(kept: &Kept) -> Option<String> {
    let mut difference = None;
    run_some(kept, |row, old| {
        if row != old && difference.is_none() {
            difference = Some(format!("case {}: {row:?}, kept: {old:?}", row.case));
        }
    });
    difference
}

/// Runs every 397th case, which includes some of every sweep, and passes each with its kept row to `compare`.
fn run_some(Kept { study, rows }: &Kept, mut compare: impl FnMut(&Row, &Row)) {
    let numbers: Vec<u64> = (0..study.cases()).step_by(397).collect();
    let mut found = 0;
    let take = |row: Row| {
        found += 1;
        compare(&row, &rows[&row.case]);
        Ok::<(), RunError>(())
    };
    run(study, &numbers, dashpot_workers::threads(), &|| false, take).expect("runs");
    assert_eq!(found, numbers.len());
}
