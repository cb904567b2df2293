//! Overview of the times of a file.

use std::io::Write;

use dashpot_recording::{Channels, TimeOverview, overview};
use tempfile::NamedTempFile;

/// Returns the overview of the time channel of a text with these times (s).
fn times(times_s: &[f64]) -> TimeOverview {
    let mut file = NamedTempFile::new().expect("a temporary file");
    writeln!(file, "time_s,displacement_m").expect("a writable file");
    for time_s in times_s {
        writeln!(file, "{time_s},0").expect("a writable file");
    }
    let overview = overview(file.path(), &Channels::default()).expect("a valid file");
    let [times] = <[TimeOverview; 1]>::try_from(overview.times).expect("one time channel");
    times
}

/// Intervals of 1, 1, 1 and 2 s: their mean is 1.25 s and their variance 0.1875 s2. Intervals of 2, 2, 2 and 1 s lie as
/// far below their mean.
#[test]
fn rate_and_jitter_are_those_of_the_intervals() {
    for (times_s, rate_hz) in [
        ([0.0, 1.0, 2.0, 3.0, 5.0], 1.0 / 1.25),
        ([0.0, 2.0, 4.0, 6.0, 7.0], 1.0 / 1.75),
    ] {
        let found = times(&times_s);
        assert_eq!(found.rate_hz, Some(rate_hz));
        let jitter_s = found.jitter_s.expect("intervals");
        assert!((jitter_s - 0.1875_f64.sqrt()).abs() < 1e-15, "{jitter_s} s");
        assert_eq!(found.largest_deviation_s, Some(0.75));
    }
}

#[test]
fn an_interval_of_five_means_still_counts_for_the_rate() {
    let regular = times(&[0.0, 1.0, 6.0]);
    assert_eq!(regular.rate_hz, Some(1.0 / 3.0));
    let longer = times(&[0.0, 1.0, 6.5]);
    assert_eq!(longer.rate_hz, Some(1.0));
}

#[test]
fn a_single_row_has_a_time_but_no_rate() {
    let found = times(&[1.5]);
    assert_eq!(found.from_to_s, Some([1.5, 1.5]));
    assert_eq!(
        (found.rate_hz, found.jitter_s, found.largest_deviation_s),
        (None, None, None)
    );
}
