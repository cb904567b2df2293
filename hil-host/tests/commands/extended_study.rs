//! Studies that are extended: rows stay, only missing cases run, and the files are those of a run from nothing.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::common::{dashpot, error_of, json_of, text_of};
use crate::sweep::{altered, folder, read, with_its_digest};

/// Study with these seeds, clearances, observed indices and further sweeps.
fn study(seeds: &str, clearances: &str, observed: &str, more: &str) -> String {
    format!(
        r#"name = "extended"
seeds = [{seeds}]
observed = [{observed}]

[[sweep]]
name = "clearance"
track = "straight"
speed_km_h = 120
duration_s = 1.5
vary = [
  {{ parameter = "vertical.mount.clearance_m", values = [{clearances}] }},
  {{ parameter = "speed_km_h", values = [100, 140] }},
]
{more}
[[figure]]
title = "Forces"
dampers = {{ sweep = "clearance", dampers = ["front vertical damper 1"] }}
"#
    )
}

const OBSERVED: &str = "\"body_vertical_rms_m_per_s2\"";
const MORE: &str = r#"
[[sweep]]
name = "nominal"
track = "straight"
speed_km_h = 120
duration_s = 1.5
"#;

/// The files that must be those of a run from nothing.
const FILES: [&str; 4] = ["rows.csv", "rows.study", "rows.curves", "report.html"];

const SWEEP: [&str; 6] = ["sweep", "study.toml", "--output", "one", "--format", "json"];

/// Folder in which the study of four cases has run, into `one`.
fn studied() -> TempDir {
    let folder = folder(&study("1, 2", "5e-3", OBSERVED, ""));
    dashpot(&SWEEP, folder.path()).success();
    folder
}

/// Replaces the study and runs it, and runs it from nothing too. Returns the numbers of rows that were kept and of
/// cases that ran.
fn extended(folder: &Path, text: &str) -> [Option<u64>; 2] {
    fs::write(folder.join("study.toml"), text).unwrap();
    let report = json_of(&dashpot(&SWEEP, folder).success());
    is_that_of_a_run_from_nothing(folder);
    let kept = report["extended"]["rows_kept"].as_u64();
    [kept, report["run_now"].as_u64()]
}

fn is_that_of_a_run_from_nothing(folder: &Path) {
    let from_nothing = ["sweep", "study.toml", "--output", "new"];
    dashpot(&from_nothing, folder).success();
    for name in FILES {
        let [one, new] = ["one", "new"].map(|part| read(folder, &format!("{part}/{name}")));
        assert!(one == new, "{name} differs");
    }
    fs::remove_dir_all(folder.join("new")).unwrap();
}

#[test]
fn rows_stay_when_a_study_gets_seeds_values_sweeps_and_indices() {
    let folder = studied();
    let more_seeds = study("2, 1, 3", "5e-3", OBSERVED, "");
    assert_eq!(extended(folder.path(), &more_seeds), [Some(4), Some(2)]);
    let more_values = study("2, 1, 3", "0, 5e-3", OBSERVED, MORE);
    assert_eq!(extended(folder.path(), &more_values), [Some(6), Some(9)]);
    // The runs computed all indices but wear.
    let more_indices = format!("\"last_lateral_m\", {OBSERVED}, \"wheel_load_greatest_n\"");
    let more_indices = study("2, 1, 3", "0, 5e-3", &more_indices, MORE);
    assert_eq!(extended(folder.path(), &more_indices), [Some(15), Some(0)]);
    let fewer_indices = study("2, 1, 3", "0, 5e-3", "\"last_lateral_m\"", MORE);
    assert_eq!(extended(folder.path(), &fewer_indices), [Some(15), Some(0)]);
}

#[test]
fn an_index_that_no_run_computed_runs_the_cases_again_and_says_so() {
    let folder = studied();
    let wear = "\"max_wear_depth_um_per_1000km\"";
    fs::write(
        folder.path().join("study.toml"),
        study("1, 2", "5e-3", &format!("{OBSERVED}, {wear}"), ""),
    )
    .unwrap();
    let report = json_of(&dashpot(&SWEEP, folder.path()).success());
    assert_eq!(report["run_now"], 4, "{report}");
    let lacking = &report["extended"]["lacking"];
    assert_eq!(lacking["max_wear_depth_um_per_1000km"], 4, "{report}");
    is_that_of_a_run_from_nothing(folder.path());
    // Now it is known.
    let only_wear = study("1, 2", "5e-3", wear, "");
    assert_eq!(extended(folder.path(), &only_wear), [Some(4), Some(0)]);
}

#[test]
fn a_study_that_differs_in_anything_else_is_refused_by_name() {
    let folder = studied();
    let before = FILES.map(|name| read(folder.path(), &format!("one/{name}")));
    let base = study("1, 2, 3", "5e-3", OBSERVED, "");
    let overridden = "dampers = { vertical = \"in-service\" }\nduration_s = 1.5";
    let moved = "track = \"straight\"\nstart_m = 3";
    for (from, to, reason) in [
        (
            "duration_s = 1.5",
            "duration_s = 2",
            "duration_s was 1.5, is now 2.0",
        ),
        (
            "duration_s = 1.5",
            overridden,
            "sweep clearance: vehicle differs",
        ),
        (
            "track = \"straight\"",
            moved,
            "start_m was -15.0, is now 3.0",
        ),
        (
            "seeds = [1, 2, 3]",
            "seeds = [1, 3]",
            "seed 2 is not in the study now",
        ),
        ("seeds = [1, 2, 3]", "", "the rows have seeds of the study"),
        (
            "5e-3",
            "4e-3",
            "value 0.005 of vertical.mount.clearance_m is not in the study now",
        ),
        (
            "vertical.mount.clearance_m",
            "lateral.mount.clearance_m",
            "the study now varies lateral",
        ),
        (
            "\"clearance\"",
            "\"other\"",
            "sweep clearance is not in the study now",
        ),
    ] {
        fs::write(folder.path().join("study.toml"), base.replace(from, to)).unwrap();
        let error = error_of(&dashpot(&SWEEP, folder.path()).failure().code(1));
        assert!(error.contains(reason), "{to}: {error}");
        assert!(
            error.contains("differs in more than additional seeds"),
            "{to}: {error}"
        );
        assert!(error.contains("--anew"), "{to}: {error}");
    }
    let after = FILES[..1]
        .iter()
        .map(|name| read(folder.path(), &format!("one/{name}")));
    assert!(after.eq(before[..1].iter().cloned()));
}

#[test]
fn rows_of_another_model_are_refused_when_the_study_is_extended() {
    let folder = studied();
    let rows = read(folder.path(), "one/rows.csv");
    let (header, first) = (rows.lines().next().unwrap(), rows.lines().nth(1).unwrap());
    let foreign = with_its_digest(&altered(first, "physics", header, "0123456789abcdef"));
    let text = rows.replace(first, &foreign);
    fs::write(folder.path().join("one/rows.csv"), text).unwrap();
    let more = study("1, 2, 3", "5e-3", OBSERVED, "");
    fs::write(folder.path().join("study.toml"), more).unwrap();
    let error = error_of(&dashpot(&SWEEP, folder.path()).failure().code(1));
    assert!(
        error.contains("rows of different physics cannot be mixed"),
        "{error}"
    );
}

#[test]
fn a_study_interrupted_before_and_after_its_extension_resumes_from_both_parts() {
    let folder = studied();
    let earlier = ["one/rows.csv", "one/rows.study"].map(|name| read(folder.path(), name));
    let more = study("1, 2, 3", "5e-3", OBSERVED, "");
    assert_eq!(extended(folder.path(), &more), [Some(4), Some(2)]);
    let later = ["one/rows.csv", "one/rows.study"].map(|name| read(folder.path(), name));
    let first_lines =
        |text: &str, count: usize| -> String { text.split_inclusive('\n').take(count).collect() };
    // Two rows of the earlier study, one of the extended one, and half a row.
    let partial = first_lines(&earlier[0], 3) + &first_lines(&later[0], 2) + "5,clear";
    for name in FILES {
        fs::remove_file(folder.path().join("one").join(name)).unwrap();
    }
    fs::write(folder.path().join("one/rows.csv.partial"), partial).unwrap();
    let outlines = format!("{}{}", earlier[1], later[1]);
    fs::write(folder.path().join("one/rows.study"), outlines).unwrap();
    // The first row is in both parts.
    assert_eq!(extended(folder.path(), &more), [Some(2), Some(4)]);
}

#[test]
fn shards_take_the_rows_of_the_earlier_study_from_a_merged_file() {
    let folder = folder(&study("1, 2", "5e-3", OBSERVED, ""));
    let sweep = ["sweep", "study.toml", "--no-page", "--shards", "2"];
    let run = |shard: &str, more: &[&str]| {
        let of_shard = [&sweep[..], &["--shard", shard], more].concat();
        dashpot(&of_shard, folder.path())
    };
    let merge = |rows: &str, to: &str| {
        let [first, second] = ["0", "1"].map(|shard| format!("{rows}/rows-{shard}-of-2.csv"));
        let merge = ["merge", "study.toml", &first, &second, "--output", to];
        dashpot(&merge, folder.path()).success();
    };
    for shard in ["0", "1"] {
        run(shard, &["--output", "parts"]).success();
    }
    merge("parts", "earlier");
    let more = study("1, 2, 3", "5e-3", OBSERVED, "");
    fs::write(folder.path().join("study.toml"), more).unwrap();
    let error = error_of(&run("0", &["--output", "parts"]).failure().code(1));
    assert!(error.contains("--reuse"), "{error}");
    let reuse = [
        "--reuse",
        "earlier/rows.csv",
        "--output",
        "more",
        "--format",
        "json",
    ];
    let reports = ["0", "1"].map(|shard| json_of(&run(shard, &reuse).success()));
    let counts = |key: fn(&serde_json::Value) -> &serde_json::Value| -> u64 {
        reports
            .iter()
            .filter_map(|report| key(report).as_u64())
            .sum()
    };
    assert_eq!(counts(|report| &report["extended"]["rows_kept"]), 4);
    assert_eq!(counts(|report| &report["run_now"]), 2);
    merge("more", "one");
    is_that_of_a_run_from_nothing(folder.path());
}

#[test]
fn the_list_counts_rows_that_are_done_and_estimates_the_others() {
    let folder = studied();
    let list = ["sweep", "study.toml", "--list", "--output", "one"];
    let json = [&list[..], &["--format", "json"]].concat();
    let counts = |list: &serde_json::Value| ["done", "missing"].map(|key| list[key].as_u64());
    let whole = json_of(&dashpot(&json, folder.path()).success());
    assert_eq!(counts(&whole), [Some(4), Some(0)], "{whole}");
    assert!(whole["estimate"].is_null(), "{whole}");
    let more = study("1, 2, 3", "5e-3", OBSERVED, "");
    fs::write(folder.path().join("study.toml"), &more).unwrap();
    let extended = json_of(&dashpot(&json, folder.path()).success());
    assert_eq!(counts(&extended), [Some(4), Some(2)], "{extended}");
    assert!(
        extended["estimate"]["takes_s"].as_f64() > Some(0.0),
        "{extended}"
    );
    // Rows that the study cannot use are not done; the list says why.
    let other = more.replace("duration_s = 1.5", "duration_s = 2");
    fs::write(folder.path().join("study.toml"), other).unwrap();
    let text = text_of(&dashpot(&list, folder.path()).success());
    assert!(text.contains("duration_s was 1.5, is now 2.0"), "{text}");
    assert!(text.contains("0 done, 6 to run (6 simulations)"), "{text}");
    assert!(text.contains("s on this machine, with "), "{text}");
}
