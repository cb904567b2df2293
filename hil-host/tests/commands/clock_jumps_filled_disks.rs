//! Regression: `replay` filled a jump of the logger's clock with up to 864 million interpolated ticks before it
//! rejected the recording.

use std::path::Path;

use crate::common::{dashpot, error_of, text_of};

/// Runs `replay` on rows at these times (s); returns standard output, standard error and the exit code.
fn replayed(folder: &Path, times_s: &[f64]) -> (usize, String, i32) {
    let rows: String = times_s
        .iter()
        .map(|time_s| format!("{time_s},0\n"))
        .collect();
    std::fs::write(
        folder.join("run.csv"),
        format!("time_s,displacement_m\n{rows}"),
    )
    .unwrap();
    let arguments = ["replay", "--input", "run.csv", "--output", "-"];
    let ended = dashpot(&arguments, folder);
    let code = ended.get_output().status.code().unwrap();
    (text_of(&ended).lines().count(), error_of(&ended), code)
}

#[test]
fn a_jump_is_refused_before_it_is_filled() {
    let folder = tempfile::tempdir().unwrap();
    let regular: Vec<f64> = (0..10).map(|row| f64::from(row) / 1e3).collect();
    // Only a header and the ticks before the jump are written.
    let before = 11;
    for (times_s, expected) in [
        // A jump forth and back: 9 million ticks at 1 ms.
        (
            &[9000.0, 0.011][..],
            "run.csv:13: column time_s: time 0.011 s does not increase; the previous row has 9000 s",
        ),
        // Two jumps forth, and a jump for a few samples.
        (
            &[4000.0, 9000.0, 0.012],
            "run.csv:14: column time_s: time 0.012 s does not increase; the previous row has 9000 s",
        ),
        (
            &[9000.0, 9000.001, 9000.002, 0.013],
            "run.csv:15: column time_s: time 0.013 s does not increase; the previous row has 9000.002 s",
        ),
        // A single jump when the clock is set to the time of day: 100 million ticks.
        (
            &[1e5, 1e5 + 1e-3],
            "run.csv:12: column time_s: time jumps from 0.009 s to 100000 s: 99999991 ticks without a sample, \
             allowed: 10000000",
        ),
        (
            &[1.7e9, 1.7e9 + 1e-3],
            "run.csv:12: column time_s: 1700000000 s is more than 864000000 ticks after the first sample",
        ),
    ] {
        let (lines, error, code) = replayed(folder.path(), &[&regular, times_s].concat());
        assert!(error.contains(expected), "{error}");
        assert_eq!(code, 1);
        assert!(lines <= before, "{lines}: {error}");
    }
}

#[test]
fn a_gap_is_filled() {
    let folder = tempfile::tempdir().unwrap();
    let times_s = [0.0, 0.001, 20.0, 20.001, 45.0];
    let (lines, error, code) = replayed(folder.path(), &times_s);
    assert_eq!((lines, code), (45_002, 0), "{error}");
    let (lines, ..) = replayed(folder.path(), &[0.0, 0.001, 2.0]);
    assert_eq!(lines, 2_002);
}
