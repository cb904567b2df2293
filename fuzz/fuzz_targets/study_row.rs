//! Any text as a row of a study: refused, or one that is written as it was read.
#![no_main]

use std::sync::LazyLock;

use dashpot_hil::files::study::StudyParameters;
use dashpot_hil::study::sweep::Study;
use libfuzzer_sys::fuzz_target;

static STUDY: LazyLock<Study> = LazyLock::new(|| {
    let parameters = StudyParameters::load("hunting").expect("a shipped study");
    Study::new(parameters).expect("a shipped study")
});

fuzz_target!(|text: &str| {
    let Ok(row) = STUDY.row(text.split(',')) else {
        return;
    };
    let case = STUDY.case(row.case).expect("a case of the study");
    let written = STUDY.record(&case, &row);
    let again = STUDY.row(written.iter().map(String::as_str));
    assert_eq!(again.as_ref(), Ok(&row));
});
