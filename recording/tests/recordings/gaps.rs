//! Gaps of a recording and its median interval.

use std::path::Path;
use std::rc::Rc;

use dashpot_recording::{Gap, Gaps, Recording, RowLocation, Sample};

/// Returns the gaps of a motion with these times (s).
fn gaps(times_s: impl IntoIterator<Item = f64>) -> Gaps {
    let sample = |time_s: f64| Sample {
        time_s,
        displacement_m: 0.0,
    };
    let samples = Rc::new(times_s.into_iter().map(sample).collect());
    let mut recording = Recording::from_samples(Path::new("motion"), samples);
    recording.read_all().expect("increasing times");
    recording.gaps()
}

#[test]
fn a_regular_recording_has_no_gap() {
    let found = gaps((0..100).map(|row| f64::from(row) / 1e3));
    assert_eq!(found.median_interval_s, Some(1e-3));
    assert_eq!((found.count, found.longest), (0, None));
    // Samples in memory have no lines.
    assert_eq!(found.unended_line, None);
    assert_eq!(gaps([1.0]).median_interval_s, None);
}

/// The median is counted in whole nanoseconds, to the nearest.
#[test]
fn the_median_of_fast_samples_is_exact() {
    for interval_ns in [1.0, 2.0, 3.0, 100.0, 125.0] {
        let found = gaps((0..50).map(|row| f64::from(row) * interval_ns / 1e9));
        assert_eq!(found.median_interval_s, Some(interval_ns / 1e9));
    }
}

/// Intervals (s): 1, 1, 6, 1, 6, 5, 1.
#[test]
fn the_longest_gap_is_the_first_of_equal_ones() {
    let found = gaps([0.0, 1.0, 2.0, 8.0, 9.0, 15.0, 20.0, 21.0]);
    assert_eq!(found.median_interval_s, Some(1.0));
    assert_eq!(found.count, 2);
    let expected = Gap {
        start_s: 2.0,
        duration_s: 6.0,
        location: RowLocation::Row(4),
    };
    assert_eq!(found.longest, Some(expected));
}

/// Intervals (s): 1, 1, 6, 6, 6, 1, 1. Equal intervals that follow one another are counted one by one.
#[test]
fn equal_gaps_in_a_row_are_all_counted() {
    let found = gaps([0.0, 1.0, 2.0, 8.0, 14.0, 20.0, 21.0, 22.0]);
    assert_eq!((found.median_interval_s, found.count), (Some(1.0), 3));
    let at_the_end = gaps([0.0, 1.0, 2.0, 3.0, 4.0, 10.0, 16.0]);
    assert_eq!(
        (at_the_end.median_interval_s, at_the_end.count),
        (Some(1.0), 2)
    );
}
