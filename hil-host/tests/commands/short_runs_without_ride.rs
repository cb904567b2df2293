//! Regression: a Sperling index of runs shorter than its window gave `completed`, an empty cell, an empty plot and exit
//! code 0.

use crate::common::{dashpot, error_of, json_of};
use crate::sweep::{STUDY, folder};

#[test]
fn a_study_of_ride_in_short_runs_is_refused_before_anything_runs() {
    for (index, duration, is_refused) in [
        ("sperling_vertical", "0.5", true),
        ("sperling_lateral_first", "4.9", true),
        ("mean_comfort", "0.5", true),
        ("sperling_vertical", "5", false),
        ("derailment_rms", "0.5", false),
    ] {
        let study = STUDY
            .replace("\"last_lateral_m\"", &format!("\"{index}\""))
            .replace("duration_s = 1.5", &format!("duration_s = {duration}"));
        let folder = folder(&study);
        let list = ["sweep", "study.toml", "--output", "out", "--list"];
        for line in [&list[..], &list[..4]] {
            if !is_refused {
                dashpot(&list, folder.path()).success();
                continue;
            }
            let error = error_of(&dashpot(line, folder.path()).code(1));
            let expected = format!(
                "study.toml:5: sweep clearance: observed `{index}`: the run takes {duration} s, but a ride index \
                 needs a whole window of 5 s"
            );
            assert!(error.contains(&expected), "{error}");
            assert!(!folder.path().join("out").exists());
        }
    }
    // If the duration varies, each of its values is checked.
    let varied = STUDY
        .replace("\"last_lateral_m\"", "\"sperling_vertical\"")
        .replace(
            "duration_s = 1.5\nvary = [\n",
            "vary = [\n  { parameter = \"duration_s\", values = [6, 2] },\n",
        )
        .replace("duration_s = 1.5", "duration_s = 5");
    let folder = folder(&varied);
    let error = error_of(&dashpot(&["sweep", "study.toml", "--list"], folder.path()).code(1));
    assert!(error.contains("the run takes 2 s"), "{error}");
}

#[test]
fn a_short_vehicle_run_reports_that_it_has_no_ride_indices() {
    let folder = tempfile::tempdir().unwrap();
    let line = [
        "vehicle",
        "--case",
        "straight-180",
        "--no-page",
        "--format",
        "json",
        "--output",
        "out",
    ];
    let short = dashpot(
        &[&line[..], &["--duration-s", "0.5"]].concat(),
        folder.path(),
    )
    .success();
    assert_eq!(
        error_of(&short),
        "note: the run takes 0.5 s, but a ride index needs a whole window of 5 s; the report will have no \
         Sperling's index and no mean comfort; use --duration-s for a longer run\n"
    );
    assert!(json_of(&short)["indices"]["ride"][0]["sperling_vertical"].is_null());
    let long = dashpot(&[&line[..], &["--duration-s", "5"]].concat(), folder.path()).success();
    assert_eq!(error_of(&long), "");
    assert!(json_of(&long)["indices"]["ride"][0]["sperling_vertical"].is_number());
}
