//! The paper's vehicle studies beside ours, and when a damper should be taken out of service: documents from kept rows, and the rows from runs.

mod claim;
mod document;
mod out_of_service;
mod rows;
mod trends;

use dashpot::document as kept;
use dashpot_hil::study::sweep::{Arithmetic, Row, RunError, run};
use dashpot_hil::study::workers;
use rows::Kept;

/// Studies whose rows are kept.
const STUDIES: [&str; 4] = ["paper", "curve-r600", "stand-ins", "out-of-service"];

#[test]
fn the_validation_is_that_of_the_rows() {
    let [paper, wide, stand_ins] = ["paper", "curve-r600", "stand-ins"].map(Kept::load);
    kept::compare(
        "docs/vehicle-validation.md",
        &document::text(&paper, &wide, &stand_ins),
    );
}

#[test]
fn the_limits_of_service_are_those_of_the_rows() {
    let rows = Kept::load("out-of-service");
    kept::compare("docs/out-of-service.md", &out_of_service::text(&rows));
}

/// Every 397th case: some of every sweep.
#[test]
fn rows_are_those_of_new_runs() {
    for name in STUDIES {
        let Kept { study, rows } = Kept::load(name);
        let numbers: Vec<u64> = (0..study.cases()).step_by(397).collect();
        let mut found = 0;
        let take = |row: Row| {
            let kept = &rows[&row.case];
            found += 1;
            if kept.arithmetic == Arithmetic::here() {
                assert_eq!(row, *kept, "{name}");
                return Ok::<(), RunError>(());
            }
            // Last digits differ then, and grow where flanges strike.
            assert_eq!(row.ending, kept.ending, "{name}, case {}", row.case);
            for (new, old) in row.observed.iter().zip(&kept.observed) {
                let (Some(new), Some(old)) = (new, old) else {
                    assert_eq!(new, old, "{name}, case {}", row.case);
                    continue;
                };
                let apart = (new - old).abs() / old.abs().max(1e-3);
                assert!(apart < 0.2, "{name}, case {}: {new} for {old}", row.case);
            }
            Ok(())
        };
        let threads = workers::threads();
        run(&study, &numbers, threads, &|| false, take).expect("runs");
        assert_eq!(found, numbers.len(), "{name}");
    }
}
