//! Recorded force of a damper: its course and the period it must cover.

use std::io::Write;
use std::ops::RangeInclusive;

use dashpot_recording::ForceHistory;
use tempfile::NamedTempFile;

fn opened(rows: &str, needed_s: RangeInclusive<f64>) -> Result<ForceHistory, String> {
    let mut file = NamedTempFile::new().expect("a temporary file");
    write!(file, "time_s,force_n\n{rows}").expect("a writable file");
    ForceHistory::open(file.path(), needed_s).map_err(|error| error.to_string())
}

#[test]
fn the_force_is_linear_between_samples_and_constant_outside() {
    let history = opened("1,10\n2,30\n4,-10\n", 1.0..=4.0).expect("a valid file");
    for (time_s, force_n) in [
        (-1.0, 10.0),
        (1.0, 10.0),
        (1.25, 15.0),
        (1.75, 25.0),
        (2.0, 30.0),
        (2.5, 20.0),
        (3.5, 0.0),
        (4.0, -10.0),
        (9.0, -10.0),
    ] {
        assert_eq!(history.force_n(time_s), force_n, "at {time_s} s");
    }
    assert_eq!(history.unended_line(), None);
    let cut_off = opened("1,10\n2,3", 1.0..=2.0).expect("a valid file");
    assert_eq!(cut_off.unended_line(), Some(3));
}

/// Text files round times to the nanosecond, so that much may be missing at either end.
#[test]
fn the_force_must_cover_the_period_to_the_nanosecond() {
    for (rows, needed_s) in [
        ("1,0\n2,0\n", 1.0..=2.0),
        ("1,0\n2,0\n", 1.25..=1.5),
        ("1e-9,0\n1,0\n", 0.0..=1.0),
        ("1.0000000005,0\n2,0\n", 1.0..=2.0),
        ("-1,0\n-1e-9,0\n", -1.0..=0.0),
    ] {
        assert!(opened(rows, needed_s.clone()).is_ok(), "{rows}{needed_s:?}");
    }
    for (rows, needed_s) in [
        ("1.000000002,0\n2,0\n", 1.0..=2.0),
        ("1.5,0\n2,0\n", 1.0..=2.0),
        ("1,0\n1.999999998,0\n", 1.0..=2.0),
        ("1,0\n1.5,0\n", 1.0..=2.0),
    ] {
        let error = opened(rows, needed_s).expect_err("a short file");
        assert!(error.contains("but the run needs a force from 1 s to 2 s"));
    }
    let error = opened("1.25,0\n1.5,0\n", 1.0..=2.0).expect_err("a short file");
    let expected = "the recording covers 1.25 s to 1.5 s, but";
    assert!(error.contains(expected), "{error}");
}
