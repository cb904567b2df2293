//! Parquet and MDF4 files written by `replay`, read back.

use std::path::Path;

use dashpot_recording::{Channels, MeasuredSample};

use crate::common::{dashpot, error_of, files_in};
use crate::forms::{rows, samples};

/// Replays a sample into `folder` under each file name.
pub fn replay(folder: &Path, outputs: &[&str]) {
    let input = samples().join("plain.mf4");
    for output in outputs {
        let mut arguments = vec!["replay", "--input", input.to_str().unwrap()];
        arguments.extend([
            "--displacement",
            "Weg",
            "--step-us",
            "10",
            "--scalar",
            "f64",
        ]);
        arguments.extend(["--output", output]);
        dashpot(&arguments, folder).success();
    }
}

#[test]
fn all_forms_have_the_rows_of_the_csv() {
    let folder = tempfile::tempdir().unwrap();
    replay(folder.path(), &["force.csv", "force.parquet", "force.mf4"]);
    let read = |file: &str| rows(&folder.path().join(file), &Channels::default()).unwrap();
    let expected: Vec<MeasuredSample> = read("force.csv");
    assert_eq!(expected.len(), 5913);
    assert!(expected.iter().any(|row| row.force_n != 0.0));
    assert_eq!(read("force.parquet"), expected);
    assert_eq!(read("force.mf4"), expected);
}

#[test]
fn a_failed_replay_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let text = "time_s,displacement_m\n0,0\n1,0\n0.5,0\n";
    std::fs::write(folder.path().join("in.csv"), text).unwrap();
    for output in ["force.parquet", "force.mf4"] {
        let arguments = ["replay", "--input", "in.csv", "--output", output];
        let ended = dashpot(&arguments, folder.path());
        assert!(error_of(&ended).contains("in.csv:4: column time_s: time 0.5 s does not increase"));
        ended.code(1);
        assert_eq!(files_in(folder.path()), ["in.csv"]);
    }
}
