//! `dashpot channels`: its list, and that the options it suggests work.

use crate::common::{dashpot, error_of, json_of, text_of};
use crate::forms::samples;

#[test]
fn channels_units_and_times_are_listed() {
    let report =
        json_of(&dashpot(&["channels", "groups.mf4", "--format", "json"], &samples()).success());
    let channels = report["channels"].as_array().unwrap();
    let names: Vec<_> = channels
        .iter()
        .map(|c| c["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["time", "Temperatur", "Weg", "time", "Weg", "Kraft"]);
    let weg = &channels[4];
    assert_eq!((&weg["unit"], &weg["group"]), (&"mm".into(), &2.into()));
    assert_eq!((&weg["rows"], &weg["invalid"]), (&60.into(), &0.into()));
    assert_eq!(
        (&weg["first"], &weg["min"]),
        (&(-250.0).into(), &(-250.0).into())
    );
    let time = &report["times"][1];
    assert_eq!(time["from_to_s"], serde_json::json!([0.0, 0.059_125]));
    // The time stamps are late by multiples of an eighth of a millisecond, up to half a millisecond.
    assert!((time["rate_hz"].as_f64().unwrap() - 59.0 / 0.059_125).abs() < 1e-6);
    assert!((time["largest_deviation_s"].as_f64().unwrap() - 5e-4).abs() < 1e-5);
    assert_eq!(time["gaps"]["count"], 0);
    let report =
        json_of(&dashpot(&["channels", "invalid.mf4", "--format", "json"], &samples()).success());
    assert_eq!(report["channels"][1]["invalid"], 1);
}

#[test]
fn jitter_gaps_and_repeated_times_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let text = "t [ms];x [mm];note\n0;0;a\n1;0;\n2;nan;b\n3;1,5;c\n3;0;d\n103;0;e\n104;0;f\n";
    std::fs::write(folder.path().join("run.csv"), text).unwrap();
    let ended = dashpot(&["channels", "run.csv"], folder.path()).success();
    let text = text_of(&ended);
    for expected in [
        "1  t     ms           number              7         0",
        "2  x     mm           number              7         1",
        "3  note               text                7         7",
        "time t: 0.104 s, from 0 s to 0.104 s; 1000 Hz, intervals deviate by 0 s rms",
        "warning: the time does not increase at 1 row; `replay` rejects this",
        "warning: 1 gap (over 5 times the median interval); the longest lasts 0.1 s from 0.003 s",
        "to replay: dashpot replay --input run.csv --time t --displacement x --output force.csv",
    ] {
        assert!(text.contains(expected), "{text} lacks {expected}");
    }
}

#[test]
fn suggested_options_work() {
    let folder = tempfile::tempdir().unwrap();
    for (file, line) in [
        ("plain.mf4", "--displacement Weg"),
        ("stamps_ns.parquet", "--time zeit --displacement Weg"),
        ("german.csv.gz", "--time Zeit --displacement Weg"),
        ("expected.csv", ""),
    ] {
        let path = samples().join(file);
        let path = path.to_str().unwrap();
        let report =
            json_of(&dashpot(&["channels", path, "--format", "json"], folder.path()).success());
        let expected = format!("dashpot replay --input {path} {line} --output force.csv");
        let expected = expected.replace("  ", " ");
        assert_eq!(report["replay"], expected);
        let words: Vec<&str> = expected.split(' ').skip(1).collect();
        dashpot(&words, folder.path()).success();
    }
}

#[test]
fn files_that_are_no_recordings_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("empty.csv"), "").unwrap();
    std::fs::write(folder.path().join("header.csv"), "time_s,displacement_m\n").unwrap();
    std::fs::write(folder.path().join("book.xlsx"), b"PK\x03\x04\x14\0\x06\0").unwrap();
    for (file, expected) in [
        ("empty.csv", "empty.csv: the file is empty"),
        ("header.csv", "header.csv: no row after the header"),
        (
            "book.xlsx",
            "book.xlsx: the file is a zip archive or an Excel workbook",
        ),
        ("none.csv", "none.csv: cannot read"),
    ] {
        let ended = dashpot(&["channels", file], folder.path());
        assert!(error_of(&ended).contains(expected), "{}", error_of(&ended));
        ended.code(1);
    }
}
