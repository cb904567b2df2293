//! Reads any text as a study file. Either it is refused, or each sweep has values at every point and each figure shows
//! sweeps of the study.
#![no_main]

use dashpot_files::study::StudyParameters;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(study) = StudyParameters::parse("fuzz.toml", text) else {
        return;
    };
    for sweep in &study.sweeps {
        assert!(sweep.axes.iter().all(|axis| !axis.values.is_empty()));
        let last = sweep.points() - 1;
        assert_eq!(sweep.values(last).len(), sweep.axes.len());
        let _ = sweep.options(&sweep.values(last));
    }
    for figure in &study.figures {
        assert!(
            figure
                .content
                .sweeps()
                .iter()
                .all(|name| study.sweep(name).is_some())
        );
    }
});
