//! Reads any text as a row of a study with the required digests. Either it is refused, or the row is the same after
//! writing and reading it again.
#![no_main]

use std::sync::LazyLock;

use dashpot_files::study::StudyParameters;
use dashpot_study::sweep::{PHYSICS, Study, digest_of_cells};
use libfuzzer_sys::fuzz_target;

static STUDY: LazyLock<Study> = LazyLock::new(|| {
    let parameters = StudyParameters::load("hunting").expect("a shipped study");
    Study::new(parameters).expect("a shipped study")
});

fuzz_target!(|text: &str| {
    let _ = STUDY.row(text.split(','));
    let mut cells: Vec<&str> = text.split(',').collect();
    cells.push(PHYSICS);
    let digest = digest_of_cells(cells.iter().copied());
    cells.push(&digest);
    let Ok(row) = STUDY.row(cells.into_iter()) else {
        return;
    };
    let case = STUDY.case(row.case).expect("a case of the study");
    let written = STUDY.record(&case, &row);
    let again = STUDY.row(written.iter().map(String::as_str));
    assert_eq!(again.as_ref(), Ok(&row));
});
