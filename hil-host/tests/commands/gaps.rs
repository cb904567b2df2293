//! Gaps in a recording, counted while it is read and reported by the commands.

use std::io::Cursor;
use std::path::Path;

use dashpot_recording::{Gaps, Recording, RowLocation};

use crate::common::{dashpot, json_of, text_of};

fn gaps_at(times_s: &[f64]) -> Gaps {
    let mut text = String::from("time_s,displacement_m\n");
    for time_s in times_s {
        text.push_str(&format!("{time_s},0\n"));
    }
    let source = Box::new(Cursor::new(text.into_bytes()));
    let mut recording = Recording::read(Path::new("run7.csv"), source).unwrap();
    while recording.next_sample().unwrap().is_some() {}
    recording.gaps()
}

/// Sample times (s) from `count` intervals of `interval_s` (s) each.
fn times(intervals: &[(usize, f64)]) -> Vec<f64> {
    let mut time_s = 0.0;
    let mut times_s = vec![time_s];
    for &(count, interval_s) in intervals {
        for _ in 0..count {
            time_s += interval_s;
            times_s.push(time_s);
        }
    }
    times_s
}

#[test]
fn intervals_over_five_medians_are_gaps() {
    // An interval of 4.9 medians is no gap; 5.1 and 20 medians are. The longest gap starts after 22 intervals.
    let found = gaps_at(&times(&[
        (10, 0.01),
        (1, 0.049),
        (10, 0.01),
        (1, 0.051),
        (1, 0.2),
        (10, 0.01),
    ]));
    assert_eq!(found.count, 2);
    assert_eq!(found.median_interval_s, Some(0.01));
    let longest = found.longest.unwrap();
    assert_eq!(
        (longest.duration_s, longest.location),
        (0.2, RowLocation::Line(25))
    );
    assert!((longest.start_s - 0.3).abs() < 1e-12);
}

#[test]
fn an_even_or_jittering_recording_has_none() {
    for interval_s in [1e-6, 1e-3, 3600.0] {
        assert_eq!(gaps_at(&times(&[(100, interval_s)])).count, 0);
    }
    let jitter = times(&[(1, 1e-3), (1, 3e-3)].repeat(50));
    assert_eq!(gaps_at(&jitter).longest, None);
    let (first, second) = (gaps_at(&[5.0]), gaps_at(&[5.0, 1e9]));
    assert_eq!((first.count, first.median_interval_s), (0, None));
    assert_eq!((second.count, second.median_interval_s), (0, Some(1e9)));
}

/// The shipped recording has one gap of about 40 ms after 2 s, as its header says.
#[test]
fn the_commands_report_gaps() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let ride = "data/excitations/ride_made.csv";
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.csv");
    for command in [
        &["replay", "--output", out.to_str().unwrap()][..],
        &["verify", "--step-us", "1000"],
    ] {
        let arguments = [command, &["--input", ride]].concat();
        let output = dashpot(&arguments, &root).success();
        let text = text_of(&output);
        let expected = "warning: 1 gap in the recording (intervals over 5 times the median of 0.002 s); \
                        the longest lasts 0.0422 s and begins at 1.9979 s (before line 1009)";
        assert!(text.contains(expected), "{text}");
        let output = dashpot(&[&arguments[..], &["--format", "json"]].concat(), &root);
        let gaps = &json_of(&output)["gaps"];
        assert_eq!(gaps["count"], 1);
        assert_eq!(gaps["longest"]["duration_s"], 0.0422);
    }
}
