//! Regression: the Python package built its errors by replacing options in the texts of the command, so a header name
//! with a backtick left an option in them, and a column called `--force` was reported as `force`. The remedy is now
//! data. These tests check the command's wording and that its advice works; python/tests/test_recording.py checks the
//! package's wording.

use std::path::Path;

use crate::common::{dashpot, error_of};

/// Runs `replay` on the text of a recording, with options; returns its message.
fn replayed(text: &str, options: &[&str], folder: &Path) -> Result<(), String> {
    std::fs::write(folder.join("run.csv"), text).unwrap();
    let arguments = ["replay", "--input", "run.csv", "--output", "force.csv"];
    let ended = dashpot(&[&arguments[..], options].concat(), folder);
    match ended.get_output().status.code() {
        Some(0) => Ok(()),
        _ => Err(error_of(&ended)),
    }
}

/// A text, options, the reason, and options with which it can be read.
type Case = (
    &'static str,
    &'static [&'static str],
    &'static str,
    &'static [&'static str],
);

const CASES: [Case; 13] = [
    (
        "time_s,we`g,--force\n0,1,2\n1,2,3\n",
        &[],
        "run.csv: column displacement_m is missing; the file has `time_s`, `we`g`, `--force`; choose one with \
         --displacement NAME or its number\n",
        &["--displacement", "we`g", "--displacement-unit", "mm"],
    ),
    (
        "time_s,--force\n0,1\n1,2\n",
        &["--displacement=--force"],
        "run.csv: the file does not state the unit of --force; give it with --displacement-unit: m, cm, mm, um, in\n",
        &["--displacement=--force", "--displacement-unit", "m"],
    ),
    (
        "--time NAME,--force`\n0,1\n1,2\n",
        &["--displacement=--force`", "--displacement-unit", "m"],
        "run.csv: column time_s is missing; the file has `--time NAME`, `--force``; choose one with --time NAME or \
         its number\n",
        &[
            "--displacement=2",
            "--displacement-unit=m",
            "--time=1",
            "--time-unit=s",
        ],
    ),
    (
        "0.5,1\n1,2\n",
        &[],
        "run.csv: no header says which column is the time; choose one of 1 to 2 with --time, and its unit with \
         --time-unit\n",
        &[
            "--time=1",
            "--time-unit=s",
            "--displacement=2",
            "--displacement-unit=m",
        ],
    ),
    (
        "time_s,displacement [m],displacement [mm]\n0,0,0\n1,0,0\n",
        &[],
        "run.csv: displacement: several channels match: `displacement [m]`, `displacement [mm]`; choose one with \
         --displacement NAME or its number\n",
        &["--displacement", "displacement [mm]"],
    ),
    (
        "time_s,displacement [furlong]\n0,0\n1,0\n",
        &[],
        "run.csv: the file states the unknown unit `furlong` for displacement; known units of displacement: m, cm, \
         mm, um, in; --displacement-unit overrides it\n",
        &["--displacement-unit", "m"],
    ),
    (
        "time_s;displacement_m\ns;mm\n0;0\n1;0\n",
        &[],
        "run.csv: column displacement_m has the unit `mm`, but its name ends with another unit; give it with \
         --displacement-unit: m, cm, mm, um, in\n",
        &["--displacement-unit", "mm"],
    ),
    (
        "0,1\n1,2\n",
        &[
            "--time=#1",
            "--time-unit=s",
            "--displacement=#2",
            "--displacement-unit=m",
        ],
        "run.csv:1: `0 1` could be the header or the first row; use --header yes or --header no\n",
        &[
            "--header=no",
            "--time=#1",
            "--time-unit=s",
            "--displacement=#2",
            "--displacement-unit=m",
        ],
    ),
    (
        "time_s;displacement_m\n0,5;0.25\n1,5;0.5\n",
        &[],
        "run.csv:2: column displacement_m: `0.25` has a decimal point, unlike the numbers before it or the chosen \
         decimal mark; \
         use --decimal-mark point or --decimal-mark comma\n",
        &[],
    ),
    (
        "time_s,displacement_m\n0,0\n1,\n2,0\n",
        &[],
        "run.csv:3: column displacement_m: `` is not a finite number; use --skip-invalid to skip rows with a missing \
         value\n",
        &["--skip-invalid"],
    ),
    (
        "time_s,displacement_m\n0,0\n1,0\n",
        &["--time", "displacement_m", "--time-unit", "s"],
        "run.csv: time and displacement: both are column displacement_m; choose one with --displacement NAME or its \
         number\n",
        &[
            "--time",
            "displacement_m",
            "--time-unit",
            "s",
            "--displacement=1",
            "--displacement-unit=m",
        ],
    ),
    (
        "time_s,displacement_m\n0,0\n1,0\n",
        &["--group", "fast"],
        "run.csv: group `fast` is missing or ambiguous; groups (by number or name): none in this file; choose one \
         with --group\n",
        &[],
    ),
    (
        "time_s,2,x\n0,0,0\n1,0,0\n",
        &["--displacement", "2", "--displacement-unit", "m"],
        "",
        &["--displacement", "#3", "--displacement-unit", "m"],
    ),
];

#[test]
fn the_advice_of_the_command_works() {
    let folder = tempfile::tempdir().unwrap();
    for (text, options, expected, advised) in CASES {
        match replayed(text, options, folder.path()) {
            Ok(()) => assert_eq!(expected, "", "{text}"),
            Err(error) => assert!(
                !expected.is_empty() && error.ends_with(expected),
                "{error} instead of {expected}"
            ),
        }
        if advised.is_empty() {
            continue;
        }
        // A time that does not advance is a different case.
        match replayed(text, advised, folder.path()) {
            Ok(()) => {}
            Err(error) => assert!(error.contains("does not increase"), "{error}"),
        }
    }
}

#[test]
fn the_list_of_channels_gives_advice() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("run.csv"), "t`,--force\n0,1\n1,2\n").unwrap();
    let ended = dashpot(&["channels", "run.csv"], folder.path()).success();
    let text = crate::common::text_of(&ended);
    let expected = "no time: column time_s is missing; the file has `t``, `--force`; choose one with --time NAME or \
     its number";
    assert!(text.contains(expected), "{text}");
}
